/* SPDX-License-Identifier: MIT
 *
 * The checks, and tracing with few and many rays.
 */
#include "check.h"

#include "truth.h"

#include <math.h>
#include <stdio.h>

static bool check_view(const results *r, const config_result *c, int view, failure *fault)
{
    /* The exponent comes after the blur, the default power before it. That makes a small difference. */
    const double slack = 0.002;
    const view_result *v = &c->views[view];
    const char *id = c->config.id, *name = r->views[view].name;
    const double figures[] = {v->error.rmse, v->error.mean, v->error.p99,    v->ssim,     v->flip,
                              v->grain,      v->specks,     v->own_exponent, v->own_rmse, v->flat_rmse};
    for (size_t i = 0; i < sizeof figures / sizeof figures[0]; i++)
        if (!isfinite(figures[i]))
            return fault_set(fault, "%s on %s: figure %zu is not finite", id, name, i);
    if (v->error.nonfinite_share > 0)
        fault_set(fault, "%s on %s: %g of the pixels are not finite", id, name, v->error.nonfinite_share);
    else if (!(v->error.rmse <= 1 && v->error.p95 <= v->error.p99 && fabs(v->error.mean) <= v->error.rmse + 1e-9))
        fault_set(fault, "%s on %s: rmse %g, mean %g, p95 %g, p99 %g", id, name, v->error.rmse, v->error.mean,
                  v->error.p95, v->error.p99);
    else if (!(v->own_rmse <= v->by_default_rmse + slack && v->own_rmse <= v->error.rmse + slack))
        fault_set(fault, "%s on %s: rmse %g with its best exponent, %g without", id, name, v->own_rmse,
                  v->by_default_rmse);
    else if (!(v->ssim <= 1 && v->flip >= 0 && v->flip <= 1))
        fault_set(fault, "%s on %s: SSIM %g, FLIP %g", id, name, v->ssim, v->flip);
    else if (isfinite(v->time.median_ms) && !(v->time.median_ms > 0 && v->time.median_ms <= v->time.p95_ms))
        fault_set(fault, "%s on %s: median %g ms, p95 %g ms", id, name, v->time.median_ms, v->time.p95_ms);
    else
        return true;
    return false;
}

static bool check_split(const results *r, failure *fault)
{
    for (int i = 0; i < r->split_count; i++)
        for (int k = 0; k < STEP_COUNT * r->view_count; k++)
            if (!isfinite(r->splits[i].views[k / STEP_COUNT].alone[k % STEP_COUNT]))
                return fault_set(fault, "%s: step %d of the split is not finite on %s", r->splits[i].of->config.id,
                                 k % STEP_COUNT, r->views[k / STEP_COUNT].name);
    return true;
}

/* The mean of a configuration's squared RMSE; NAN where it is not measured. */
static double mean_square(const results *r, bool denoised, int rays)
{
    double sum = NAN;
    for (int i = 0; i < r->config_count; i++) {
        const bench_config *c = &r->configs[i].config;
        if (c->kind != BENCH_RAYS || c->rays != rays || c->denoised != denoised)
            continue;
        sum = 0;
        for (int v = 0; v < r->view_count; v++)
            sum += r->configs[i].views[v].error.rmse * r->configs[i].views[v].error.rmse / r->view_count;
    }
    return sum;
}

/* Few rays gain by denoising. */
static bool check_denoiser(const results *r, failure *fault)
{
    for (int rays = 1; rays <= 4; rays *= 2) {
        const double plain = mean_square(r, false, rays), denoised = mean_square(r, true, rays);
        if (denoised > plain)
            return fault_set(fault, "%d rays: rmse %g, denoised %g", rays, sqrt(plain), sqrt(denoised));
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

static bool check_rays(const results *r, const bench_scene *b, failure *fault)
{
    static const int counts[] = {16, 64, 256};
    const options *o = r->options;
    scene_view view;
    float radius;
    scene *s = bench_scene_open(b, o->size[0], o->size[1], &view, &radius, fault);
    if (!s)
        return false;
    /* Another seed, so that the many rays do not include the few. */
    truth_request request = {.name = b->name, .radius = radius, .rays = 1024, .seed = o->seed + 1};
    bench_truth best;
    bool good = truth_get(&request, s, &view, &best, fault);
    double last = INFINITY;
    for (size_t i = 0; good && i < sizeof counts / sizeof counts[0]; i++) {
        bench_truth t;
        request.rays = counts[i];
        request.seed = o->seed;
        good = truth_get(&request, s, &view, &t, fault);
        if (good) {
            const double now =
                rmse(t.accessibility, best.accessibility, best.foreground, (size_t)view.width * (size_t)view.height);
            fprintf(stderr, "%s, %d rays against 1024: rmse %.5f\n", b->name, counts[i], now);
            good = now < last; /* also false for nan */
            if (!good)
                fault_set(fault, "%s: %d rays are no nearer to 1024 (rmse %g) than fewer (%g)", b->name, counts[i], now,
                          last);
            last = now;
        }
        truth_destroy(&t);
    }
    truth_destroy(&best);
    scene_destroy(s);
    return good;
}

bool check_results(const results *r, failure *fault)
{
    for (int i = 0; i < r->config_count; i++)
        for (int v = 0; v < r->view_count; v++)
            if (!check_view(r, &r->configs[i], v, fault))
                return false;
    return check_split(r, fault) && check_denoiser(r, fault) && check_rays(r, &r->scenes[0], fault);
}
