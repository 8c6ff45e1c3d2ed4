/* SPDX-License-Identifier: MIT
 *
 * What view.sh sees with: screenshots of a window of the X server, and pictures compared.
 *   eyes shot WINDOW FILE.png [BEFORE.png]   once it differs from BEFORE, if that is given, and then stands still
 *   eyes differ ONE.png OTHER.png [X,Y,WxH]  prints how many pixels differ; X,Y from the upper left
 *   eyes rms ONE.png OTHER.png               prints the RMS difference of their values from 0 to 1
 *   eyes colors FILE.png                     prints how many colours it has
 */
#define _POSIX_C_SOURCE 200809L
#include "picture.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct image {
    int width, height;
    uint8_t *rgb; /* bottom to top, as picture.h has it */
} image;

static void rest(long ms)
{
    nanosleep(&(struct timespec){ms / 1000, ms % 1000 * 1000000}, NULL);
}

static image look(Display *display, Window window)
{
    XWindowAttributes a;
    image out = {0};
    if (!XGetWindowAttributes(display, window, &a))
        return out;
    XImage *seen = XGetImage(display, window, 0, 0, (unsigned)a.width, (unsigned)a.height, AllPlanes, ZPixmap);
    if (!seen)
        return out;
    out = (image){a.width, a.height, malloc((size_t)a.width * (size_t)a.height * 3)};
    for (int y = 0; y < a.height; y++)
        for (int x = 0; x < a.width; x++) {
            const unsigned long pixel = XGetPixel(seen, x, y); /* 0xRRGGBB at depth 24 */
            uint8_t *to = out.rgb + 3 * ((size_t)(a.height - 1 - y) * (size_t)a.width + (size_t)x);
            for (int c = 0; c < 3; c++)
                to[c] = (uint8_t)(pixel >> (16 - 8 * c));
        }
    XDestroyImage(seen);
    return out;
}

static image read_file(const char *path)
{
    char error[512];
    image out = {0};
    uint8_t *rgba = picture_read_png(path, &out.width, &out.height, FAULT(error));
    if (!rgba) {
        fprintf(stderr, "%s\n", error);
        exit(2);
    }
    const size_t count = (size_t)out.width * (size_t)out.height;
    for (size_t i = 0; i < count; i++)
        memmove(rgba + 3 * i, rgba + 4 * i, 3);
    out.rgb = rgba;
    return out;
}

static bool is_same(const image *a, const image *b)
{
    return a->width == b->width && a->height == b->height &&
           !memcmp(a->rgb, b->rgb, (size_t)a->width * (size_t)a->height * 3);
}

static int shot(unsigned long window, const char *path, const char *before_path)
{
    enum { STEP_MS = 60, MOST_STEPS = 100 };
    char error[512];
    Display *display = XOpenDisplay(NULL);
    if (!display)
        return 2;
    image before = {0};
    if (before_path)
        before = read_file(before_path);
    image now = look(display, window);
    for (int i = 0; before_path && i < MOST_STEPS && now.rgb && is_same(&now, &before); i++) {
        rest(STEP_MS);
        free(now.rgb);
        now = look(display, window);
    }
    for (int i = 0; i < MOST_STEPS && now.rgb; i++) {
        rest(STEP_MS);
        image next = look(display, window);
        const bool still = next.rgb && is_same(&now, &next);
        free(now.rgb);
        now = next;
        if (still)
            break;
    }
    XCloseDisplay(display);
    const bool written = now.rgb && picture_write_png(path, now.width, now.height, 3, now.rgb, FAULT(error));
    free(now.rgb);
    free(before.rgb);
    return written ? 0 : 2;
}

static int differ(const char *one_path, const char *other_path, const char *region)
{
    image one = read_file(one_path), other = read_file(other_path);
    int x0 = 0, y0 = 0, width = one.width, height = one.height, count = 0;
    if (one.width != other.width || one.height != other.height) {
        printf("sizes: %dx%d and %dx%d\n", one.width, one.height, other.width, other.height);
        return 1;
    }
    if (region && (sscanf(region, "%d,%d,%dx%d", &x0, &y0, &width, &height) != 4 || x0 < 0 || y0 < 0 ||
                   x0 + width > one.width || y0 + height > one.height))
        return 2;
    for (int y = y0; y < y0 + height; y++)
        for (int x = x0; x < x0 + width; x++) {
            const size_t at = 3 * ((size_t)(one.height - 1 - y) * (size_t)one.width + (size_t)x);
            count += memcmp(one.rgb + at, other.rgb + at, 3) != 0;
        }
    printf("%d\n", count);
    free(one.rgb);
    free(other.rgb);
    return 0;
}

static int rms(const char *one_path, const char *other_path)
{
    image one = read_file(one_path), other = read_file(other_path);
    const size_t count = 3 * (size_t)one.width * (size_t)one.height;
    double sum = 0;
    if (one.width != other.width || one.height != other.height)
        return 1;
    for (size_t i = 0; i < count; i++)
        sum += (one.rgb[i] - other.rgb[i]) * (one.rgb[i] - other.rgb[i]) / (255.0 * 255.0);
    printf("%.6f\n", sqrt(sum / (double)count));
    free(one.rgb);
    free(other.rgb);
    return 0;
}

static int colors(const char *path)
{
    image i = read_file(path);
    uint8_t *seen = calloc(1 << 24, 1);
    int count = 0;
    for (size_t p = 0; seen && p < (size_t)i.width * (size_t)i.height; p++) {
        const size_t color = (size_t)i.rgb[3 * p] << 16 | (size_t)i.rgb[3 * p + 1] << 8 | i.rgb[3 * p + 2];
        count += !seen[color];
        seen[color] = 1;
    }
    printf("%d\n", count);
    free(seen);
    free(i.rgb);
    return 0;
}

int main(int argc, char **argv)
{
    if (argc >= 4 && !strcmp(argv[1], "shot"))
        return shot(strtoul(argv[2], NULL, 0), argv[3], argc > 4 ? argv[4] : NULL);
    if (argc >= 4 && !strcmp(argv[1], "differ"))
        return differ(argv[2], argv[3], argc > 4 ? argv[4] : NULL);
    if (argc == 4 && !strcmp(argv[1], "rms"))
        return rms(argv[2], argv[3]);
    if (argc == 3 && !strcmp(argv[1], "colors"))
        return colors(argv[2]);
    return 2;
}
