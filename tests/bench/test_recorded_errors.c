/* SPDX-License-Identifier: MIT
 *
 * test_recorded_errors FILE.tsv [SCENES] [--record]: RMSE, grain and specks (structure.h) of each horizon level, as
 * shipped, against ray-traced truth on small pictures of a few scenes, compared with the figures recorded in the file.
 * Worse by more than the tolerance fails; much better fails too, and asks for a new record, so that the gain is held.
 * --record writes the file instead. Scenes that are not there (SCENES is the folder of the glTF ones) are left out with
 * a message, and can't be recorded.
 */
#include "effects.h"
#include "views.h"

#include <glssao/glssao.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 240, HEIGHT = 135, RAYS = 64, LEVELS = GLSSAO_ULTRA + 1, ERROR_LENGTH = 1024, MAX_ROWS = 64 };

/* Larger than the rounding of other drivers and compilers, smaller than the effect of a change to the shader. */
static const double WORSE = 0.01, BETTER = 0.03;

typedef enum measure_kind { RMSE, GRAIN, SPECKS, MEASURES } measure_kind;
static const char *const measure_names[] = {"rmse", "grain", "specks"};
static const double floors[] = {0.0002, 0.00004, 3.0};

/* Words of their names; "cornell" stands for cornell-box too. */
static const char picked[] = "columns,cornell,steps,plane,zdm2,garage,cycloidal,dutch,hermes,ivy,truck-town";

typedef struct row {
    char scene[64];
    double of[MEASURES][LEVELS];
} row;

typedef struct record {
    row rows[MAX_ROWS];
    int count;
} record;

static bool read_record(const char *path, record *r)
{
    FILE *f = fopen(path, "r");
    if (!f) {
        perror(path);
        return false;
    }
    char line[512];
    bool good = true;
    while (good && fgets(line, sizeof line, f)) {
        if (line[0] == '#')
            continue;
        row *at = &r->rows[r->count];
        int length = 0, figure = 0;
        good = r->count < MAX_ROWS && sscanf(line, "%63s%n", at->scene, &length) == 1;
        for (int more, from = length; good && figure < MEASURES * LEVELS; figure++, from += more)
            good = sscanf(line + from, "%lf%n", &at->of[figure / LEVELS][figure % LEVELS], &more) == 1;
        r->count += good;
    }
    fclose(f);
    if (!good)
        fprintf(stderr, "%s: not a record: %s\n", path, line);
    return good;
}

static bool write_record(const char *path, const record *r)
{
    FILE *f = fopen(path, "w");
    if (!f) {
        perror(path);
        return false;
    }
    fprintf(
        f,
        "# SPDX-License-Identifier: MIT\n"
        "# Errors of horizon against %d rays a pixel at %dx%d; written by `test_recorded_errors --record`.\n"
        "# scene\trmse: low\tmedium\thigh\tultra\tgrain: low\tmedium\thigh\tultra\tspecks: low\tmedium\thigh\tultra\n",
        RAYS, WIDTH, HEIGHT);
    for (int i = 0; i < r->count; i++) {
        fprintf(f, "%s", r->rows[i].scene);
        for (int k = 0; k < MEASURES * LEVELS; k++)
            fprintf(f, k / LEVELS == SPECKS ? "\t%.0f" : "\t%.5f", r->rows[i].of[k / LEVELS][k % LEVELS]);
        fputc('\n', f);
    }
    const bool written = fclose(f) == 0;
    if (written)
        printf("%s is written, %d scenes\n", path, r->count);
    return written;
}

static bool measure_view(effects *e, map_reader *m, bench_view *v, float *picture, row *out, failure *fault)
{
    memcpy(out->scene, v->name, sizeof out->scene);
    for (int level = 0; level < LEVELS; level++) {
        const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, (glssao_quality)level);
        const effect_job job = {.gbuffer = &v->gbuffer, .settings = &settings, .radius = v->radius};
        if (!effects_run(e, m, &job, picture, fault))
            return false;
        const error_measure found = measure_error(picture, v->truth.accessibility, v->classes, (size_t)WIDTH * HEIGHT);
        if (found.nonfinite_share > 0)
            return false;
        out->of[RMSE][level] = found.rmse;
        out->of[GRAIN][level] = grain_measure(&v->grain, picture);
        out->of[SPECKS][level] = count_specks(picture, v->truth.accessibility, v->classes, WIDTH, HEIGHT);
    }
    return true;
}

/* Measures every scene that is there. */
static bool measure(const options *o, context *c, record *out, failure *fault)
{
    static bench_scene scenes[BENCH_SCENES_MAX];
    effects e = {.context = c, .width = WIDTH, .height = HEIGHT};
    map_reader m;
    float *picture = malloc((size_t)WIDTH * HEIGHT * sizeof *picture);
    bool measured = map_reader_create(&m, WIDTH, HEIGHT, fault) && picture;
    const int count = bench_scenes_list(o, scenes);
    for (int i = 0; measured && i < count; i++) {
        bench_view v;
        measured = bench_view_create(&v, &scenes[i], o, fault) &&
                   measure_view(&e, &m, &v, picture, &out->rows[out->count++], fault);
        bench_view_destroy(&v);
    }
    effects_destroy(&e);
    map_reader_destroy(&m);
    free(picture);
    return measured;
}

static const row *find(const record *r, const char *name)
{
    for (int i = 0; i < r->count; i++)
        if (strcmp(r->rows[i].scene, name) == 0)
            return &r->rows[i];
    return NULL;
}

/* How many figures are off. */
static int compare(const record *recorded, const record *now)
{
    static const char *const names[LEVELS] = {"low", "medium", "high", "ultra"};
    int off = 0;
    for (int i = 0; i < recorded->count; i++)
        if (!find(now, recorded->rows[i].scene))
            printf("%s is skipped: its file is not there\n", recorded->rows[i].scene);
    for (int i = 0; i < now->count; i++) {
        const row *is = &now->rows[i], *was = find(recorded, is->scene);
        if (!was) {
            printf("%s is not recorded\n", is->scene);
            off++;
            continue;
        }
        for (int k = 0; k < MEASURES * LEVELS; k++) {
            const double before = was->of[k / LEVELS][k % LEVELS], value = is->of[k / LEVELS][k % LEVELS];
            const double floor = floors[k / LEVELS];
            const bool worse = !(value <= before * (1 + WORSE) + floor), better = value < before * (1 - BETTER) - floor;
            printf("%-18s %-6s %-6s %.5f, recorded %.5f%s\n", is->scene, names[k % LEVELS], measure_names[k / LEVELS],
                   value, before,
                   worse    ? ": WORSE"
                   : better ? ": BETTER, record anew with --record"
                            : "");
            off += worse || better;
        }
    }
    return off;
}

/* The built-in scenes at the least. */
static bool has_built_ins(const record *r)
{
    return find(r, "columns") && find(r, "cornell") && find(r, "steps") && find(r, "plane");
}

static int finish(const char *path, const record *now, bool write)
{
    static record recorded;
    const bool read = read_record(path, &recorded);
    if (!write)
        return read && compare(&recorded, now) == 0 ? 0 : 1;
    for (int i = 0; i < recorded.count; i++)
        if (!find(now, recorded.rows[i].scene)) {
            fprintf(stderr, "%s is recorded and not there: nothing is written\n", recorded.rows[i].scene);
            return 1;
        }
    return write_record(path, now) ? 0 : 1;
}

int main(int argc, char **argv)
{
    const char *path = NULL, *scenes = NULL;
    bool write = false;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--record") == 0)
            write = true;
        else if (!path)
            path = argv[i];
        else
            scenes = argv[i];
    }
    if (!path) {
        fprintf(stderr, "usage: test_recorded_errors FILE.tsv [SCENES] [--record]\n");
        return 2;
    }
    const options o = {.scenes = scenes, .pick = picked, .size = {WIDTH, HEIGHT}, .rays = RAYS};
    char error[ERROR_LENGTH] = "";
    static record now;
    context *c = context_create(&(context_options){.kind = CONTEXT_EGL}, error, sizeof error);
    bool measured = c && gl_load(context_load, c, error, sizeof error) && measure(&o, c, &now, FAULT(error));
    context_destroy(c);
    if (!measured || !has_built_ins(&now)) {
        fprintf(stderr, "test_recorded_errors: %s\n", error[0] ? error : "a built-in scene is missing");
        return 1;
    }
    return finish(path, &now, write);
}
