/* SPDX-License-Identifier: MIT
 *
 * glssao-tune: searches the horizon technique's constants against ray-traced truth. With --fold 0 or 1 it searches on
 * one half of the scenes and reports the error on the other half. With --fold 2 it searches on all, for the constants
 * that ship. Scenes for judging are never used. It changes no file: its result is copied into
 * glsl/shared/tuned.glsl by hand.
 */
#include "effects.h"
#include "progress.h"
#include "tool.h"
#include "tuned.glsl"
#include "views.h"

#include <glssao/glssao.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LEVELS = GLSSAO_ULTRA + 1, ERROR_LENGTH = 4096, SOURCE_ROOM = 4096 };

/* A constant of glsl/shared/tuned.glsl, whose value is where the search begins. `levels`: a bit for each quality level
 * that uses it. */
typedef struct tuned {
    const char *name;
    unsigned levels;
    double value, step, least, most;
    bool found; /* in a shader */
} tuned;

#define LEVEL(level) (1u << (level))
#define EVERY_LEVEL (LEVEL(LEVELS) - 1)
/* The shaders' names are macros here too. */
#define TUNED(name, levels, step, least, most)                                                                         \
    {                                                                                                                  \
#name, levels, name, step, least, most, false                                                                  \
    }

static tuned table[] = {
    TUNED(JUMP, EVERY_LEVEL, 0.08, 0.05, 2.0),
    TUNED(ALIKE, EVERY_LEVEL, 0.10, 0.0, 2.0),
    TUNED(OPEN_END, EVERY_LEVEL, 0.10, 1.0, 2.0),
    TUNED(RUN_WIDTH, EVERY_LEVEL, 0.15, 0.3, 2.0),
    TUNED(VEIL_ONE_LAYER, EVERY_LEVEL, 0.03, 0.0, 0.6),
    TUNED(VEIL_WIDTH, EVERY_LEVEL, 0.08, 0.0, 1.0),
    TUNED(CALIBRATION_6, LEVEL(GLSSAO_LOW), 0.06, 0.8, 1.5),
    TUNED(CALIBRATION_8, LEVEL(GLSSAO_MEDIUM), 0.06, 0.8, 1.5),
    TUNED(CALIBRATION_12, LEVEL(GLSSAO_HIGH) | LEVEL(GLSSAO_ULTRA), 0.06, 0.8, 1.5),
};
enum { TABLE_LENGTH = sizeof table / sizeof table[0] };

typedef struct tuner {
    options options;
    context *context;
    map_reader reader;
    bench_view views[BENCH_SCENES_MAX];
    bench_scene scenes[BENCH_SCENES_MAX];
    int view_count;
    float *picture;
    double classic[BENCH_SCENES_MAX]; /* mean square error of classic with the exponent that fits best */
    double square[LEVELS][BENCH_SCENES_MAX];
    int level; /* being compiled */
    char error[ERROR_LENGTH];
} tuner;

static tuner t;
static void (*shader_source)(GLuint shader, GLsizei count, const GLchar *const *strings, const GLint *lengths);

static bool applies(const tuned *c, int level)
{
    return c->levels & LEVEL(level);
}

/* Replaces the value where the source defines the constant. */
static void substitute(char *source, tuned *c)
{
    char defined[64];
    snprintf(defined, sizeof defined, "#define %s ", c->name);
    char *value = strstr(source, defined);
    if (!value)
        return;
    c->found = true;
    value += strlen(defined);
    char *end = value + strcspn(value, " \n");
    char written[32];
    const int length = snprintf(written, sizeof written, "%.6f", c->value);
    memmove(value + length, end, strlen(end) + 1);
    memcpy(value, written, (size_t)length);
}

/* Replaces glShaderSource for the library. */
static void take_source(GLuint shader, GLsizei count, const GLchar *const *strings, const GLint *lengths)
{
    (void)lengths; /* the library's strings end in 0 */
    size_t size = SOURCE_ROOM;
    for (int i = 0; i < count; i++)
        size += strlen(strings[i]);
    char *whole = calloc(1, size);
    if (!whole)
        return;
    for (int i = 0; i < count; i++)
        strcat(whole, strings[i]);
    for (int i = 0; i < TABLE_LENGTH; i++)
        if (applies(&table[i], t.level))
            substitute(whole, &table[i]);
    const GLchar *const one = whole;
    shader_source(shader, 1, &one, NULL);
    free(whole);
}

typedef union any_function {
    void *pointer;
    void (*source)(GLuint, GLsizei, const GLchar *const *, const GLint *);
} any_function;

static void *load(const char *name, void *user)
{
    any_function f = {.pointer = context_load(name, user)};
    if (strcmp(name, "glShaderSource") == 0) {
        shader_source = f.source;
        f.source = take_source;
    }
    return f.pointer;
}

static bool run(const glssao_settings *settings, fit_sum *fits)
{
    effects e = {.context = t.context, .width = t.options.size[0], .height = t.options.size[1], .load = load};
    const size_t count = (size_t)e.width * (size_t)e.height;
    bool ran = true;
    for (int v = 0; ran && v < t.view_count; v++) {
        memset(&fits[v], 0, sizeof fits[v]);
        const effect_job job = {.gbuffer = &t.views[v].gbuffer, .settings = settings, .radius = t.views[v].radius};
        ran = effects_run(&e, &t.reader, &job, t.picture, FAULT(t.error));
        if (ran)
            fit_add(&fits[v], t.picture, t.views[v].truth.accessibility, t.views[v].classes, count);
    }
    effects_destroy(&e);
    return ran;
}

/* As shipped: no exponent is fitted. */
static bool measure_level(int level, double square[BENCH_SCENES_MAX], fit_sum *fits)
{
    t.level = level;
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, (glssao_quality)level);
    if (!run(&settings, fits))
        return false;
    for (int v = 0; v < t.view_count; v++) {
        const double rmse = fit_rmse(&fits[v], 1);
        square[v] = rmse * rmse;
    }
    return true;
}

static bool measure_classic(fit_sum *fits)
{
    static fit_sum all;
    glssao_settings settings = glssao_default_settings(GLSSAO_CLASSIC, GLSSAO_HIGH);
    settings.power = 1;
    if (!run(&settings, fits))
        return false;
    for (int v = 0; v < t.view_count; v++)
        fit_merge(&all, &fits[v]);
    const double exponent = fit_exponent(&all);
    for (int v = 0; v < t.view_count; v++) {
        const double rmse = fit_rmse(&fits[v], exponent);
        t.classic[v] = rmse * rmse;
    }
    return true;
}

enum { ALL = 2 };

/* RMSE over the scenes of one parity, or ALL, as a ratio to classic's. */
static double ratio(const double square[BENCH_SCENES_MAX], int parity)
{
    double sum = 0, classic = 0;
    for (int v = 0; v < t.view_count; v++) {
        if (parity == ALL || v % 2 == parity) {
            sum += square[v];
            classic += t.classic[v];
        }
    }
    return sqrt(sum / classic);
}

/* Mean ratio of the levels on the scenes that are searched on. */
static double score(double square[LEVELS][BENCH_SCENES_MAX])
{
    double sum = 0;
    for (int level = 0; level < LEVELS; level++)
        sum += ratio(square[level], t.options.fold) / LEVELS;
    return sum;
}

static void print_ratios(const char *when)
{
    printf("%s\n", when);
    for (int level = 0; level < LEVELS; level++) {
        const int fold = t.options.fold;
        printf("  level %d: searched on %.4f, ", level, ratio(t.square[level], fold));
        if (fold != ALL)
            printf("held out %.4f, all %.4f", ratio(t.square[level], 1 - fold), ratio(t.square[level], ALL));
        putchar('\n');
    }
    fflush(stdout);
}

/* Tries one constant a step up and down; keeps what lowers the score. */
static bool try_constant(tuned *c, fit_sum *fits, double *best, bool *improved)
{
    static double square[LEVELS][BENCH_SCENES_MAX];
    const double kept = c->value;
    for (int sign = -1; sign <= 1; sign += 2) {
        c->value = fmin(fmax(kept + sign * c->step, c->least), c->most);
        memcpy(square, t.square, sizeof square);
        for (int level = 0; level < LEVELS; level++)
            if (applies(c, level) && !measure_level(level, square[level], fits))
                return false;
        const double now = score(square);
        if (now < *best) {
            *best = now;
            memcpy(t.square, square, sizeof square);
            *improved = true;
            return true;
        }
    }
    c->value = kept;
    return true;
}

/* A constant that no shader defines would be searched in vain. */
static bool all_found(void)
{
    for (int i = 0; i < TABLE_LENGTH; i++) {
        if (!table[i].found) {
            snprintf(t.error, sizeof t.error, "no shader defines %s as glsl/shared/tuned.glsl does", table[i].name);
            return false;
        }
    }
    return true;
}

static bool search(fit_sum *fits, int rounds)
{
    double best = score(t.square);
    for (int round = 0; round < rounds; round++)
        for (int i = 0; i < TABLE_LENGTH; i++) {
            bool improved = false;
            if (!try_constant(&table[i], fits, &best, &improved))
                return false;
            if (!improved)
                table[i].step *= 0.5;
            progress_show("round %d/%d: %s %.4f, score %.5f", round + 1, rounds, table[i].name, table[i].value, best);
        }
    progress_clear();
    return true;
}

/* Drops the scenes for judging; -1, with the error set, where --pick asks for one of them. */
static int keep_tuning_scenes(int count)
{
    int kept = 0;
    for (int i = 0; i < count; i++) {
        if (t.scenes[i].judging && t.options.pick) {
            snprintf(t.error, sizeof t.error, "%s is kept for judging: nothing may be tuned on it", t.scenes[i].name);
            return -1;
        }
        if (!t.scenes[i].judging)
            t.scenes[kept++] = t.scenes[i];
    }
    if (kept == 0)
        snprintf(t.error, sizeof t.error, "no scene has that name");
    return kept;
}

static bool prepare(void)
{
    t.context = tool_open(&t.options, FAULT(t.error));
    if (!t.context || !map_reader_create(&t.reader, t.options.size[0], t.options.size[1], FAULT(t.error)))
        return false;
    const int count = keep_tuning_scenes(bench_scenes_list(&t.options, t.scenes));
    for (; count > 0 && t.view_count < count; t.view_count++)
        if (!bench_view_create(&t.views[t.view_count], &t.scenes[t.view_count], &t.options, FAULT(t.error)))
            return false;
    t.picture = malloc((size_t)t.options.size[0] * (size_t)t.options.size[1] * sizeof *t.picture);
    return count > 0 && t.picture != NULL;
}

static bool tune(void)
{
    fit_sum *fits = calloc(BENCH_SCENES_MAX, sizeof *fits);
    bool done = fits && prepare() && measure_classic(fits);
    for (int level = 0; done && level < LEVELS; level++)
        done = measure_level(level, t.square[level], fits);
    done = done && all_found();
    if (done)
        print_ratios("before, RMSE as a ratio to classic's with its best exponent:");
    done = done && search(fits, t.options.rounds);
    if (done)
        print_ratios("after:");
    for (int i = 0; done && i < TABLE_LENGTH; i++)
        printf("  %s %.4f\n", table[i].name, table[i].value);
    free(fits);
    return done;
}

int main(int argc, char **argv)
{
    const int code = tool_begin("glssao-tune", argc, argv, &t.options);
    if (code >= 0)
        return code;
    const bool done = tune();
    for (int v = 0; v < t.view_count; v++)
        bench_view_destroy(&t.views[v]);
    free(t.picture);
    map_reader_destroy(&t.reader);
    context_destroy(t.context);
    return tool_end("glssao-tune", done, t.error);
}
