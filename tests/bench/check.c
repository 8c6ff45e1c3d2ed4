/* SPDX-License-Identifier: MIT
 *
 * The checks, and tracing with few and many rays.
 */
#include "check.h"

#include "truth.h"

#include <math.h>
#include <stdio.h>

static bool check_measure(const char *id, const char *view, const error_measure *m, char *error, size_t error_size)
{
    if (!isfinite(m->rmse) || !isfinite(m->mean) || !isfinite(m->p95) || m->rmse > 1) {
        snprintf(error, error_size, "%s on %s: rmse %g, mean %g, p95 %g", id, view, m->rmse, m->mean, m->p95);
        return false;
    }
    if (m->nonfinite_share > 0) {
        snprintf(error, error_size, "%s on %s: %g of the pixels are no numbers", id, view, m->nonfinite_share);
        return false;
    }
    return true;
}

static bool check_config(const results *r, const config_result *c, char *error, size_t error_size)
{
    /* The exponent comes after the blur, the default power before it: that much they may differ. */
    const double slack = 0.002;
    if (!check_measure(c->config.id, "all", &c->as_is, error, error_size))
        return false;
    for (int v = 0; v < r->view_count; v++)
        if (!check_measure(c->config.id, r->views[v].name, &c->views[v].as_is, error, error_size))
            return false;
    if (!(c->rmse_fit <= c->as_is.rmse + slack)) {
        snprintf(error, error_size, "%s: rmse %g with the best exponent %g, %g with the default", c->config.id,
                 c->rmse_fit, c->exponent, c->as_is.rmse);
        return false;
    }
    if (r->time_scene && !(c->time.median_ms > 0 && c->time.median_ms <= c->time.p95_ms)) {
        snprintf(error, error_size, "%s: median %g ms, p95 %g ms", c->config.id, c->time.median_ms, c->time.p95_ms);
        return false;
    }
    return true;
}

static bool check_split(const results *r, char *error, size_t error_size)
{
    for (int i = 0; i < r->split_count; i++) {
        for (int k = 0; k < STEP_COUNT; k++) {
            if (!isfinite(r->splits[i].alone[k]) || !isfinite(r->splits[i].total[k])) {
                snprintf(error, error_size, "%s: step %d of the split is no number", r->splits[i].of->config.id, k);
                return false;
            }
        }
    }
    return true;
}

static double rmse(const float *a, const float *b, const uint8_t *foreground, size_t count)
{
    double sum = 0, pixels = 0;
    for (size_t i = 0; i < count; i++) {
        if (foreground[i]) {
            sum += ((double)a[i] - (double)b[i]) * ((double)a[i] - (double)b[i]);
            pixels++;
        }
    }
    return pixels > 0 ? sqrt(sum / pixels) : NAN;
}

static bool check_rays(const results *r, const bench_scene *b, char *error, size_t error_size)
{
    static const int counts[] = {16, 64, 256};
    const options *o = r->options;
    scene_view view;
    float radius;
    scene *s = bench_scene_open(b, o->size[0], o->size[1], &view, &radius, error, error_size);
    if (!s)
        return false;
    /* Another seed, so that the few rays are not among the many. */
    truth_request request = {.name = b->name, .radius = radius, .rays = 1024, .seed = o->seed + 1};
    bench_truth best;
    bool good = truth_get(&request, s, &view, &best, error, error_size);
    double last = INFINITY;
    for (size_t i = 0; good && i < sizeof counts / sizeof counts[0]; i++) {
        bench_truth t;
        request.rays = counts[i];
        request.seed = o->seed;
        good = truth_get(&request, s, &view, &t, error, error_size);
        if (good) {
            const double now =
                rmse(t.accessibility, best.accessibility, best.foreground, (size_t)view.width * (size_t)view.height);
            fprintf(stderr, "%s, %d rays against 1024: rmse %.5f\n", b->name, counts[i], now);
            good = now < last; /* also false for nan */
            if (!good)
                snprintf(error, error_size, "%s: %d rays are no nearer to 1024 (rmse %g) than fewer (%g)", b->name,
                         counts[i], now, last);
            last = now;
        }
        truth_destroy(&t);
    }
    truth_destroy(&best);
    scene_destroy(s);
    return good;
}

bool check_results(const results *r, const bench_scene *on, char *error, size_t error_size)
{
    for (int i = 0; i < r->config_count; i++)
        if (!check_config(r, &r->configs[i], error, error_size))
            return false;
    return check_split(r, error, error_size) && check_rays(r, on, error, error_size);
}
