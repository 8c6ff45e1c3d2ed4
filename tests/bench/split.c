/* SPDX-License-Identifier: MIT
 *
 * Runs every seed once over all techniques and views. Sums are kept for the sampled pixels only, to save memory. The
 * converged estimate is the mean over the seeds, before the exponent.
 */
#include "split.h"

#include "oracle.h"
#include "progress.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Variants of one technique's estimate; all but the last have power 1. */
typedef enum variant { FULL = 0, HALF, BLURRED, SHIPPED, VARIANT_COUNT } variant;
enum { SINGLE_SEEDS = 4 }; /* seeds whose pictures are kept one by one */

typedef struct accumulator { /* of one technique on one view; a value a sampled pixel */
    double *sum[2];          /* FULL, HALF */
    float *single[SINGLE_SEEDS][VARIANT_COUNT];
} accumulator;

typedef struct splitter {
    results *results;
    map_reader *reader;
    float *picture;
    sampled_pixels *pixels; /* a view */
    float **truth;          /* a view, on the sampled pixels */
    float *(*oracle)[THICKNESS_COUNT];
    accumulator *accumulators; /* technique-major */
} splitter;

static const double thickness_of_radius[THICKNESS_COUNT] = {0.05, 0.1, 0.25, 0.5, 0.75, 1, 1.5, INFINITY};

static accumulator *accumulator_of(const splitter *s, int technique, int view)
{
    return &s->accumulators[technique * s->results->view_count + view];
}

/* The size that the technique itself works at. */
static variant own_size(const split_result *split)
{
    return split->of->config.settings.half_resolution ? HALF : FULL;
}

static glssao_settings variant_settings(const split_result *split, variant v)
{
    glssao_settings s = split->of->config.settings;
    if (v != SHIPPED)
        s.power = 1;
    if (v == FULL || v == HALF) {
        s.blur = GLSSAO_BLUR_NONE;
        s.blur_rounds = 0;
        s.half_resolution = v == HALF;
    }
    return s;
}

static bool allocate(splitter *s)
{
    results *r = s->results;
    const size_t views = (size_t)r->view_count;
    s->picture = malloc((size_t)s->reader->width * (size_t)s->reader->height * sizeof *s->picture);
    s->pixels = calloc(views, sizeof *s->pixels);
    s->truth = calloc(views, sizeof *s->truth);
    s->oracle = calloc(views, sizeof *s->oracle);
    s->accumulators = calloc(views * (size_t)r->split_count + 1, sizeof *s->accumulators);
    r->oracle.rmse = calloc(views, sizeof *r->oracle.rmse);
    bool ok = s->picture && s->pixels && s->truth && s->oracle && s->accumulators && r->oracle.rmse;
    for (int i = 0; i < r->split_count; i++) {
        r->splits[i].views = calloc(views, sizeof *r->splits[i].views);
        ok = ok && r->splits[i].views;
    }
    for (int v = 0; ok && v < r->view_count; v++) {
        s->pixels[v] = oracle_pixels(&r->views[v], r->options->oracle_step, r->options->seed);
        const size_t count = (size_t)s->pixels[v].count + 1; /* a view may show nothing */
        ok = s->pixels[v].index && (s->truth[v] = calloc(count, sizeof(float)));
        for (int k = 0; ok && k < THICKNESS_COUNT; k++)
            ok = (s->oracle[v][k] = calloc(count, sizeof(float))) != NULL;
        for (int i = 0; ok && i < r->split_count; i++) {
            accumulator *a = accumulator_of(s, i, v);
            for (int size = 0; ok && size < 2; size++)
                ok = (a->sum[size] = calloc(count, sizeof(double))) != NULL;
            for (int k = 0; ok && k < SINGLE_SEEDS * VARIANT_COUNT; k++)
                ok = (a->single[k / VARIANT_COUNT][k % VARIANT_COUNT] = calloc(count, sizeof(float))) != NULL;
        }
        for (int i = 0; ok && i < s->pixels[v].count; i++)
            s->truth[v][i] = r->views[v].truth.accessibility[s->pixels[v].index[i]];
    }
    return ok;
}

static void release(splitter *s)
{
    const results *r = s->results;
    for (int v = 0; v < r->view_count; v++) {
        if (s->pixels)
            free(s->pixels[v].index);
        if (s->truth)
            free(s->truth[v]);
        for (int k = 0; s->oracle && k < THICKNESS_COUNT; k++)
            free(s->oracle[v][k]);
        for (int i = 0; s->accumulators && i < r->split_count; i++) {
            accumulator *a = accumulator_of(s, i, v);
            free(a->sum[0]);
            free(a->sum[1]);
            for (int k = 0; k < SINGLE_SEEDS * VARIANT_COUNT; k++)
                free(a->single[k / VARIANT_COUNT][k % VARIANT_COUNT]);
        }
    }
    free(s->accumulators);
    free(s->oracle);
    free(s->truth);
    free(s->pixels);
    free(s->picture);
}

/* Mean square of the difference. */
static double mean_square(const float *a, const float *b, int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++)
        sum += ((double)a[i] - (double)b[i]) * ((double)a[i] - (double)b[i]);
    return count > 0 ? sum / count : 0;
}

static bool measure_oracle(splitter *s)
{
    results *r = s->results;
    oracle_result *o = &r->oracle;
    memcpy(o->thickness, thickness_of_radius, sizeof o->thickness);
    double sum[THICKNESS_COUNT] = {0};
    for (int v = 0; v < r->view_count; v++) {
        progress_show("marching through the depth map: %s", r->views[v].name);
        if (!oracle_march(&r->views[v], &s->pixels[v], r->options->oracle_rays, r->cores, r->options->seed,
                          o->thickness, s->oracle[v]))
            return false;
        for (int k = 0; k < THICKNESS_COUNT; k++) {
            const double square = mean_square(s->oracle[v][k], s->truth[v], s->pixels[v].count);
            o->rmse[v][k] = sqrt(square);
            sum[k] += square;
        }
    }
    for (int k = 0; k < THICKNESS_COUNT; k++)
        o->best = sum[k] < sum[o->best] ? k : o->best;
    return true;
}

/* One view, one seed, one technique. */
static bool run_variants(splitter *s, effects *e, int technique, int view, int seed, failure *fault)
{
    const results *r = s->results;
    const split_result *split = &r->splits[technique];
    accumulator *a = accumulator_of(s, technique, view);
    const sampled_pixels *pixels = &s->pixels[view];
    for (int v = 0; v < VARIANT_COUNT; v++) {
        if (v > HALF && seed >= SINGLE_SEEDS)
            break;
        const glssao_settings settings = variant_settings(split, (variant)v);
        const bench_view *on = &r->views[view];
        /* Horizon's noise is a tile that is the same for all seeds. The estimates of glssao_accumulate differ. */
        const effect_job job = {.gbuffer = &on->gbuffer,
                                .settings = &settings,
                                .radius = on->radius,
                                .accumulates = v == FULL && settings.technique == GLSSAO_HORIZON};
        if (!effects_run(e, s->reader, &job, s->picture, fault))
            return false;
        for (int i = 0; i < pixels->count; i++) {
            const float value = s->picture[pixels->index[i]];
            if (v <= HALF)
                a->sum[v][i] += (double)value;
            if (seed < SINGLE_SEEDS)
                a->single[seed][v][i] = value;
        }
    }
    return true;
}

static bool run_seeds(splitter *s, context *c, failure *fault)
{
    const results *r = s->results;
    for (int seed = 0; seed < r->options->split_seeds; seed++) {
        effects e = {.context = c,
                     .width = s->reader->width,
                     .height = s->reader->height,
                     .seed = r->options->seed + (uint32_t)seed,
                     .path = (glssao_path)r->options->path};
        bool ran = true;
        progress_show("split: seed %d/%d", seed + 1, r->options->split_seeds);
        for (int t = 0; ran && t < r->split_count; t++)
            for (int v = 0; ran && v < r->view_count; v++)
                ran = run_variants(s, &e, t, v, seed, fault);
        effects_destroy(&e);
        if (!ran)
            return false;
    }
    return true;
}

static void raise(float *values, int count, double exponent)
{
    for (int i = 0; i < count; i++)
        values[i] = (float)pow((double)values[i], exponent);
}

static double mean_of_seeds(const double *squares, int seeds)
{
    double sum = 0;
    for (int i = 0; i < seeds; i++)
        sum += squares[i];
    return sum / seeds;
}

static bool finish_view(splitter *s, split_result *split, int technique, int view)
{
    const results *r = s->results;
    accumulator *a = accumulator_of(s, technique, view);
    const int count = s->pixels[view].count, seeds = r->options->split_seeds;
    const int singles = seeds < SINGLE_SEEDS ? seeds : SINGLE_SEEDS;
    const float *truth = s->truth[view], *oracle = s->oracle[view][r->oracle.best];
    float *converged[2] = {calloc((size_t)count + 1, sizeof(float)), calloc((size_t)count + 1, sizeof(float))};
    const bool ok = converged[0] && converged[1];
    for (int size = 0; ok && size < 2; size++) {
        for (int i = 0; i < count; i++)
            converged[size][i] = (float)(a->sum[size][i] / seeds);
        raise(converged[size], count, split->of->exponent);
    }
    const variant own = own_size(split);
    double square[STEP_COUNT] = {0}, step[STEP_COUNT] = {0};
    if (ok) {
        double noise[SINGLE_SEEDS], noise_step[SINGLE_SEEDS], blurred[SINGLE_SEEDS], blurred_step[SINGLE_SEEDS];
        double shipped[SINGLE_SEEDS], shipped_step[SINGLE_SEEDS];
        for (int k = 0; k < singles; k++) {
            float **single = a->single[k];
            raise(single[own], count, split->of->exponent);
            raise(single[BLURRED], count, split->of->exponent);
            noise[k] = mean_square(single[own], truth, count);
            /* The mean includes the seed itself. This factor gives the distance from the mean of the others. */
            noise_step[k] = mean_square(single[own], converged[own], count) * (seeds > 1 ? seeds / (seeds - 1.0) : 1);
            blurred[k] = mean_square(single[BLURRED], truth, count);
            blurred_step[k] = mean_square(single[BLURRED], converged[own], count);
            shipped[k] = mean_square(single[SHIPPED], truth, count);
            shipped_step[k] = mean_square(single[SHIPPED], single[BLURRED], count);
        }
        step[STEP_LAYER] = square[STEP_LAYER] = mean_square(oracle, truth, count);
        step[STEP_ESTIMATOR] = mean_square(converged[FULL], oracle, count);
        square[STEP_ESTIMATOR] = mean_square(converged[FULL], truth, count);
        step[STEP_HALF] = mean_square(converged[HALF], converged[FULL], count);
        square[STEP_HALF] = mean_square(converged[HALF], truth, count);
        step[STEP_NOISE] = mean_of_seeds(noise_step, singles);
        square[STEP_NOISE] = mean_of_seeds(noise, singles);
        step[STEP_DENOISE] = mean_of_seeds(blurred_step, singles);
        square[STEP_DENOISE] = mean_of_seeds(blurred, singles);
        step[STEP_CONTRAST] = mean_of_seeds(shipped_step, singles);
        square[STEP_CONTRAST] = mean_of_seeds(shipped, singles);
    }
    const bool skipped[STEP_COUNT] = {
        [STEP_HALF] = own == FULL, [STEP_CONTRAST] = !bench_has_contrast(&split->of->config)};
    for (int k = 0; k < STEP_COUNT; k++) {
        split->views[view].alone[k] = sqrt(step[k]);
        split->views[view].total[k] = skipped[k] ? NAN : sqrt(square[k]);
    }
    free(converged[0]);
    free(converged[1]);
    return ok;
}

static bool finish(splitter *s)
{
    for (int t = 0; t < s->results->split_count; t++)
        for (int v = 0; v < s->results->view_count; v++)
            if (!finish_view(s, &s->results->splits[t], t, v))
                return false;
    return true;
}

bool split_measure(results *r, context *c, map_reader *m, failure *fault)
{
    splitter s = {.results = r, .reader = m};
    for (int t = 0; t < BENCH_TECHNIQUES; t++)
        for (int level = GLSSAO_LOW; level <= GLSSAO_ULTRA; level++) {
            const config_result *of = results_level(r, (glssao_technique)t, (glssao_quality)level);
            if (of && (level == GLSSAO_HIGH || t == GLSSAO_HORIZON))
                r->splits[r->split_count++] = (split_result){.of = of};
        }
    const bool done = (allocate(&s) && measure_oracle(&s) && run_seeds(&s, c, fault) && finish(&s)) ||
                      fault_set(fault, "out of memory, or of threads");
    progress_clear();
    release(&s);
    return done;
}

void split_destroy(results *r)
{
    free(r->oracle.rmse);
    for (int i = 0; i < r->split_count; i++)
        free(r->splits[i].views);
}
