/* SPDX-License-Identifier: MIT
 *
 * check_pictures [--alike] WITH.ppm WITHOUT.ppm [REFERENCE.ppm]: checks the dropin programs' scene with and without
 * occlusion. It must be darker where boxes meet the floor and each other, unchanged in the open and in the sky, nowhere
 * brighter, and close to the reference everywhere. With --alike, for other views of the scene, it must be darker in
 * some places, nowhere brighter, and close to the reference.
 *
 * check_pictures --nearest TRUTH.ppm A.ppm B.ppm...: each picture must be nearer to the truth than the next by a fifth
 * of the root mean square error at least.
 */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 640, HEIGHT = 480 };

static unsigned char *read_picture(const char *path)
{
    int width = 0, height = 0;
    unsigned char *rgb = malloc(WIDTH * HEIGHT * 3);
    FILE *file = fopen(path, "rb");
    bool ok = rgb && file && fscanf(file, "P6 %d %d 255", &width, &height) == 2 && fgetc(file) == '\n' &&
              width == WIDTH && height == HEIGHT && fread(rgb, WIDTH * HEIGHT * 3, 1, file) == 1;
    if (file)
        fclose(file);
    if (ok)
        return rgb;
    fprintf(stderr, "%s is no picture of %d x %d\n", path, WIDTH, HEIGHT);
    exit(1);
}

/* Sum of the three channels over 5 x 5 pixels; origin at the top left. */
static int patch(const unsigned char *rgb, int x, int y)
{
    int sum = 0;
    for (int j = y - 2; j <= y + 2; ++j)
        for (int i = x - 2; i <= x + 2; ++i)
            for (int k = 0; k < 3; ++k)
                sum += rgb[3 * (j * WIDTH + i) + k];
    return sum;
}

static double rmse(const unsigned char *a, const unsigned char *b)
{
    double sum = 0.0;
    for (int i = 0; i < WIDTH * HEIGHT * 3; ++i)
        sum += (double)((a[i] - b[i]) * (a[i] - b[i]));
    return sqrt(sum / (WIDTH * HEIGHT * 3)) / 255.0;
}

static int check_nearest(int count, char **paths)
{
    unsigned char *const truth = read_picture(paths[0]);
    double last = 0.0;
    int bad = 0;
    for (int i = 1; i < count; ++i) {
        unsigned char *const picture = read_picture(paths[i]);
        const double error = rmse(picture, truth);
        printf("%s: %.4f from the truth\n", paths[i], error);
        bad += error < 1.2 * last || error == 0.0;
        last = error;
        free(picture);
    }
    free(truth);
    if (bad)
        fprintf(stderr, "the order is another\n");
    return bad != 0;
}

int main(int argc, char **argv)
{
    if (argc > 3 && strcmp(argv[1], "--nearest") == 0)
        return check_nearest(argc - 2, argv + 2);
    static const struct {
        const char *name;
        int x, y;
        double least, most; /* picture with over picture without */
    } places[] = {
        {"floor at the orange box", 202, 297, 0.2, 0.75},
        {"floor at the blue box", 330, 348, 0.2, 0.75},
        {"wall behind the orange box", 348, 150, 0.1, 0.75},
        {"open floor", 150, 430, 0.98, 1.0},
        {"open wall", 470, 120, 0.98, 1.0},
        {"top of the orange box", 225, 118, 0.98, 1.0},
        {"sky", 60, 60, 1.0, 1.0},
    };
    const bool alike = argc == 5 && strcmp(argv[1], "--alike") == 0;
    if (alike) {
        --argc;
        ++argv;
    }
    if (argc < 3)
        return 2;
    const unsigned char *with = read_picture(argv[1]), *without = read_picture(argv[2]);
    int failures = 0;
    for (size_t i = 0; !alike && i < sizeof places / sizeof *places; ++i) {
        double ratio = patch(with, places[i].x, places[i].y) / (double)patch(without, places[i].x, places[i].y);
        if (!(ratio >= places[i].least && ratio <= places[i].most)) {
            fprintf(stderr, "%s: %s is %.3f of what it was, wanted %.2f to %.2f\n", argv[1], places[i].name, ratio,
                    places[i].least, places[i].most);
            ++failures;
        }
    }
    int brighter = 0, darker = 0;
    for (int i = 0; i < WIDTH * HEIGHT * 3; ++i) {
        brighter += with[i] > without[i];
        darker += with[i] + 20 < without[i];
    }
    if (darker < WIDTH * HEIGHT * 3 / 50) {
        fprintf(stderr, "%s: only %d values are much darker than without\n", argv[1], darker);
        ++failures;
    }
    if (brighter > 0) {
        fprintf(stderr, "%s: %d values are brighter than without\n", argv[1], brighter);
        ++failures;
    }
    if (argc > 3) {
        const unsigned char *reference = read_picture(argv[3]);
        double sum = 0.0;
        for (int i = 0; i < WIDTH * HEIGHT * 3; ++i)
            sum += abs(with[i] - reference[i]);
        sum /= WIDTH * HEIGHT * 3;
        if (sum > 1.0) {
            fprintf(stderr, "%s: %.2f levels from %s on average\n", argv[1], sum, argv[3]);
            ++failures;
        }
    }
    return failures > 0;
}
