/* SPDX-License-Identifier: MIT
 *
 * Panels side by side, each at half the measuring size, above a scale of the error's colours.
 */
#include "strips.h"

#include "error_color.h"
#include "errors.h"
#include "picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PLACE_WIDTH = 160, PLACE_HEIGHT = 90, PLACE_BLOCKS = 2 };
enum { COLUMNS = 3, GAP = 4, BAR_HEIGHT = 12, FOOT = 40, GLYPH_SCALE = 2 };
static const double error_range = 0.5; /* where the colours end */

typedef struct canvas {
    int width, height;
    uint8_t *rgb; /* bottom to top */
} canvas;

static uint8_t to_byte(double v)
{
    return (uint8_t)lrint(255 * fmin(fmax(v, 0), 1));
}

static void put(canvas *c, int x, int y, const double rgb[3])
{
    if (x < 0 || y < 0 || x >= c->width || y >= c->height)
        return;
    for (int k = 0; k < 3; k++)
        c->rgb[3 * ((size_t)y * (size_t)c->width + (size_t)x) + (size_t)k] = to_byte(rgb[k]);
}

/* 3 x 5 cells, the top row first, its left cell the highest bit. */
static void draw_text(canvas *c, int x, int y, const char *text)
{
    static const struct {
        char letter;
        uint16_t cells;
    } glyphs[] = {{'0', 075557}, {'1', 026227}, {'2', 071747}, {'3', 071717}, {'4', 055711},
                  {'5', 074717}, {'6', 074757}, {'7', 071111}, {'8', 075757}, {'9', 075717},
                  {'-', 000700}, {'+', 002720}, {'.', 000002}};
    const double ink[3] = {0.2, 0.2, 0.2};
    for (; *text; text++, x += 4 * GLYPH_SCALE) {
        uint16_t cells = 0;
        for (size_t i = 0; i < sizeof glyphs / sizeof glyphs[0]; i++)
            cells = glyphs[i].letter == *text ? glyphs[i].cells : cells;
        for (int i = 0; i < 15 * GLYPH_SCALE * GLYPH_SCALE; i++) {
            const int cx = i % (3 * GLYPH_SCALE), cy = i / (3 * GLYPH_SCALE);
            if (cells >> (14 - (cy / GLYPH_SCALE * 3 + cx / GLYPH_SCALE)) & 1)
                put(c, x + cx, y - cy, ink);
        }
    }
}

static void draw_scale(canvas *c, int left, int width)
{
    for (int x = 0; x < width; x++) {
        double rgb[3];
        error_color((2.0 * x / (width - 1) - 1) * error_range, error_range, rgb);
        for (int y = 0; y < BAR_HEIGHT; y++)
            put(c, left + x, FOOT - GAP - 2 - y, rgb);
    }
    for (int k = 0; k <= 4; k += width < 300 ? 2 : 1) { /* a small scale has no room for all */
        char text[16];
        const double value = (k / 2.0 - 1) * error_range;
        snprintf(text, sizeof text, k == 2 ? "0" : "%+.2f", value);
        const int at = left + k * (width - 1) / 4, wide = (int)strlen(text) * 4 * GLYPH_SCALE;
        draw_text(c, k == 0 ? at : k == 4 ? at - wide : at - wide / 2, FOOT - GAP - BAR_HEIGHT - 7, text);
    }
}

typedef struct panel {
    const float *picture; /* result or truth */
    double exponent;
    bool error; /* against the truth, instead of the picture itself */
    int column, row;
} panel;

static void pixel_color(const bench_view *v, const panel *p, size_t i, double rgb[3])
{
    static const double sky[3] = {0.82, 0.88, 0.95};
    if (v->classes[i] == PIXEL_NONE) {
        memcpy(rgb, sky, sizeof sky);
        return;
    }
    const double value = pow((double)p->picture[i], p->exponent);
    for (int k = 0; k < 3; k++)
        rgb[k] = value;
    if (p->error)
        error_color(value - (double)v->truth.accessibility[i], error_range, rgb);
}

/* Each pixel of the panel is the mean of 2 x 2. */
static void draw_panel(canvas *c, const bench_view *v, const panel *p, int left, int bottom)
{
    const int w = v->gbuffer.view.width, h = v->gbuffer.view.height;
    for (int y = 0; y < h / 2; y++)
        for (int x = 0; x < w / 2; x++) {
            double sum[3] = {0, 0, 0};
            for (int k = 0; k < 4; k++) {
                double rgb[3];
                pixel_color(v, p, (size_t)(2 * y + k / 2) * (size_t)w + (size_t)(2 * x + k % 2), rgb);
                for (int n = 0; n < 3; n++)
                    sum[n] += rgb[n] / 4;
            }
            put(c, left + x, bottom + y, sum);
        }
}

static bool draw_strip(const bench_view *v, const config_result *c, const float *as_is, const float *plain,
                       const char *path, failure *fault)
{
    const panel panels[] = {
        {v->truth.accessibility, 1, false, 0, 0}, {as_is, 1, false, 1, 0},           {as_is, 1, true, 2, 0},
        {v->truth.accessibility, 1, false, 0, 1}, {plain, c->exponent, false, 1, 1}, {plain, c->exponent, true, 2, 1}};
    const int rows = bench_has_contrast(&c->config) ? 2 : 1, count = rows * COLUMNS;
    const int wide = v->gbuffer.view.width / 2, high = v->gbuffer.view.height / 2;
    canvas image = {.width = COLUMNS * (wide + GAP) - GAP, .height = rows * (high + GAP) - GAP + FOOT};
    const size_t bytes = 3 * (size_t)image.width * (size_t)image.height;
    image.rgb = malloc(bytes);
    if (!image.rgb)
        return fault_set_memory(fault);
    memset(image.rgb, 255, bytes);
    for (int i = 0; i < count; i++)
        draw_panel(&image, v, &panels[i], panels[i].column * (wide + GAP),
                   FOOT + (rows - 1 - panels[i].row) * (high + GAP));
    draw_scale(&image, 2 * (wide + GAP), wide);
    const bool written = picture_write_png(path, image.width, image.height, 3, image.rgb, fault);
    free(image.rgb);
    return written;
}

bool strips_write(const results *r, effects *e, map_reader *m, failure *fault)
{
    const size_t count = (size_t)m->width * (size_t)m->height;
    float *as_is = malloc(2 * count * sizeof *as_is);
    if (!as_is)
        return fault_set_memory(fault);
    float *plain = as_is + count;
    bool written = true;
    for (int k = 0; written && k < r->config_count; k++) {
        const config_result *c = &r->configs[k];
        const glssao_technique technique = c->config.settings.technique;
        const bool peer = c->config.kind == BENCH_PEER && !strchr(c->config.id, '@'); /* none of the grid */
        const bool level = c->config.kind == BENCH_EFFECT && c == results_level(r, technique, GLSSAO_HIGH);
        for (int i = 0; written && (peer || level) && i < r->view_count; i++) {
            char path[2048];
            snprintf(path, sizeof path, "%s/strip-%s-%s.png", r->options->out, r->views[i].name,
                     peer ? c->config.id : bench_technique_name(technique));
            written = errors_run(r, &c->config, i, false, e, m, as_is, fault) &&
                      errors_run(r, &c->config, i, true, e, m, plain, fault) &&
                      draw_strip(&r->views[i], c, as_is, plain, path, fault);
        }
    }
    free(as_is);
    return written;
}

/* The window of PLACE_WIDTH x PLACE_HEIGHT with the largest sum of squared errors, on a grid of a quarter of its sides.
 */
static void find_place(const bench_view *v, const float *picture, int *out_x, int *out_y)
{
    const int w = v->gbuffer.view.width, h = v->gbuffer.view.height;
    double most = -1;
    for (int top = 0; top + PLACE_HEIGHT <= h; top += PLACE_HEIGHT / 4)
        for (int left = 0; left + PLACE_WIDTH <= w; left += PLACE_WIDTH / 4) {
            double sum = 0;
            for (int y = top; y < top + PLACE_HEIGHT; y++)
                for (int x = left; x < left + PLACE_WIDTH; x++) {
                    const size_t i = (size_t)y * (size_t)w + (size_t)x;
                    const double e = (double)picture[i] - (double)v->truth.accessibility[i];
                    sum += v->classes[i] == PIXEL_NONE ? 0 : e * e;
                }
            if (sum > most) {
                most = sum;
                *out_x = left;
                *out_y = top;
            }
        }
}

static void draw_place(canvas *c, const bench_view *v, const float *picture, int left, int bottom)
{
    const panel panels[COLUMNS] = {
        {v->truth.accessibility, 1, false, 0, 0}, {picture, 1, false, 1, 0}, {picture, 1, true, 2, 0}};
    int from_x = 0, from_y = 0;
    find_place(v, picture, &from_x, &from_y);
    for (int p = 0; p < COLUMNS; p++)
        for (int i = 0; i < PLACE_WIDTH * PLACE_HEIGHT; i++) {
            const int x = i % PLACE_WIDTH, y = i / PLACE_WIDTH;
            double rgb[3];
            pixel_color(v, &panels[p], (size_t)(from_y + y) * (size_t)v->gbuffer.view.width + (size_t)(from_x + x),
                        rgb);
            put(c, left + p * (PLACE_WIDTH + GAP) + x, bottom + y, rgb);
        }
}

bool strips_write_worst(const results *r, effects *e, map_reader *m, failure *fault)
{
    const config_result *c = results_level(r, GLSSAO_HORIZON, GLSSAO_HIGH);
    if (!c || m->width < PLACE_WIDTH || m->height < PLACE_HEIGHT)
        return true;
    const int rows = (r->view_count + PLACE_BLOCKS - 1) / PLACE_BLOCKS, block = COLUMNS * (PLACE_WIDTH + GAP) + 3 * GAP;
    canvas image = {.width = PLACE_BLOCKS * block - 4 * GAP, .height = rows * (PLACE_HEIGHT + GAP) - GAP};
    const size_t bytes = 3 * (size_t)image.width * (size_t)image.height;
    float *picture = malloc((size_t)m->width * (size_t)m->height * sizeof *picture);
    image.rgb = malloc(bytes);
    bool made = picture && image.rgb;
    if (made)
        memset(image.rgb, 255, bytes);
    else
        fault_set_memory(fault);
    for (int i = 0; made && i < r->view_count; i++) {
        made = errors_run(r, &c->config, i, false, e, m, picture, fault);
        if (made)
            draw_place(&image, &r->views[i], picture, i / rows * block, (rows - 1 - i % rows) * (PLACE_HEIGHT + GAP));
    }
    char path[2048];
    snprintf(path, sizeof path, "%s/worst-horizon.png", r->options->out);
    made = made && picture_write_png(path, image.width, image.height, 3, image.rgb, fault);
    free(image.rgb);
    free(picture);
    return made;
}
