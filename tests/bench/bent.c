/* SPDX-License-Identifier: MIT
 *
 * Bent normals in degrees, over the pixels that show a surface: all configurations at full size, as glssao_accumulate
 * gives it too, the normal itself, and another trace, which tells how far the truth is off.
 */
#include "bent.h"

#include "bent_light.h"
#include "progress.h"
#include "table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ESTIMATES = 64, BINS = 1800 };
static const double DEGREES = 57.29577951308232;
static const float OCCLUDED = 0.9f;

typedef struct figures {
    double mean, rms, median, p95;
    double occluded; /* mean where the truth's accessibility is at most OCCLUDED */
} figures;

/* One view with its truth. */
typedef struct subject {
    const bench_view *view;
    float *truth, *other; /* three a pixel; of another seed */
    size_t pixels;
    float *got; /* four a pixel */
    bent_light light;
} subject;

typedef struct tables {
    table degrees, light;
} tables;

static double degrees_between(const float *a, const float *b)
{
    double dot = 0, across2 = 0;
    for (int i = 0; i < 3; i++) {
        const int k = (i + 1) % 3, m = (i + 2) % 3;
        const double across = (double)a[k] * (double)b[m] - (double)a[m] * (double)b[k];
        dot += (double)a[i] * (double)b[i];
        across2 += across * across;
    }
    return DEGREES * atan2(sqrt(across2), dot);
}

/* Of `stride` floats a pixel. Nowhere open, there is no direction to hit. */
static figures compare(const subject *s, const float *got, int stride)
{
    double sum = 0, squares = 0, count = 0, bins[BINS] = {0}, occluded = 0, occluded_sum = 0;
    figures f = {NAN, NAN, NAN, NAN, NAN};
    for (size_t i = 0; i < s->pixels; i++) {
        const float *t = s->truth + 3 * i;
        if (s->view->classes[i] == PIXEL_NONE || !(t[0] * t[0] + t[1] * t[1] + t[2] * t[2] > 1e-6f))
            continue;
        const double off = degrees_between(got + (size_t)stride * i, t);
        sum += off;
        squares += off * off;
        count++;
        if (s->view->truth.accessibility[i] <= OCCLUDED) {
            occluded_sum += off;
            occluded++;
        }
        bins[(int)(off * (BINS / 180.0)) < BINS ? (int)(off * (BINS / 180.0)) : BINS - 1]++;
    }
    f.mean = sum / count;
    f.rms = sqrt(squares / count);
    f.occluded = occluded_sum / occluded;
    double below = 0;
    for (int i = 0; i < BINS; i++) {
        below += bins[i];
        f.median = isnan(f.median) && below >= 0.5 * count ? (i + 0.5) * 180.0 / BINS : f.median;
        f.p95 = isnan(f.p95) && below >= 0.95 * count ? (i + 0.5) * 180.0 / BINS : f.p95;
    }
    return f;
}

static void add_row(table *t, const subject *s, const char *id, const char *inputs, figures f)
{
    table_text(t, id);
    table_text(t, inputs);
    table_text(t, s->view->name);
    TABLE_END_ROW(t, f.mean, f.rms, f.median, f.p95, f.occluded);
}

static bool run(const subject *s, effects *e, const glssao_settings *settings, bool depth_alone, int estimates,
                failure *fault)
{
    glssao_effect *effect = effects_get(e, &s->view->gbuffer, settings, fault);
    if (!effect)
        return false;
    const glssao_settings scaled = bench_scale_settings(settings, s->view->radius);
    const glssao_frame frame = gbuffer_frame(&s->view->gbuffer, depth_alone);
    glssao_result result = GLSSAO_OK;
    glssao_restart_accumulation(effect);
    for (int i = 0; i < estimates && result == GLSSAO_OK; i++)
        result = glssao_accumulate(effect, &frame, &scaled);
    if (estimates == 0)
        result = glssao_compute(effect, &frame, &scaled);
    if (result != GLSSAO_OK)
        return fault_set(fault, "bent normals: %s", glssao_result_string(result));
    gl.BindTexture(GL_TEXTURE_2D, glssao_map(effect, GLSSAO_MAP_BENT_NORMAL, NULL, NULL));
    gl.GetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, s->got);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    return true;
}

/* Pictures of the last result; of HIGH also a strip. */
static bool measure_light(const results *r, const subject *s, const char *id, table *t, failure *fault)
{
    const bent_light_error e = bent_light_measure(&s->light, s->got);
    char path[1024];
    table_text(t, id);
    table_text(t, s->view->name);
    TABLE_END_ROW(t, e.matte, e.matte_bent, e.glossy, e.glossy_lobe, e.glossy_bent);
    if (strcmp(id, "horizon-high") != 0)
        return true;
    snprintf(path, sizeof path, "%s/bent-%s.png", r->options->out, s->view->name);
    return bent_light_write(&s->light, s->got, path, fault);
}

/* The levels as they come, but at full size, and the mean of many estimates. */
static bool measure_levels(const results *r, const subject *s, effects *e, double of_normal, tables *t, failure *fault)
{
    for (int i = 0; i < 2 * (GLSSAO_ULTRA + 2); i++) {
        static const char *const names[] = {"horizon-low", "horizon-medium", "horizon-high", "horizon-ultra",
                                            "accumulated"};
        const int level = i / 2;
        const bool depth_alone = i % 2, accumulates = level > GLSSAO_ULTRA;
        glssao_settings settings =
            glssao_default_settings(GLSSAO_HORIZON, accumulates ? GLSSAO_HIGH : (glssao_quality)level);
        settings.upsample = true;
        settings.bent_normals = true;
        settings.half_resolution = settings.half_resolution && !accumulates;
        if (!run(s, e, &settings, depth_alone, accumulates ? ESTIMATES : 0, fault))
            return false;
        const figures f = compare(s, s->got, 4);
        add_row(&t->degrees, s, names[level], depth_alone ? "depth" : "normals", f);
        if (!depth_alone && !measure_light(r, s, names[level], &t->light, fault))
            return false;
        if (r->options->check && !depth_alone && !(f.occluded < of_normal))
            return fault_set(fault, "%s, %s: %g degrees off, the normal %g", s->view->name, names[level], f.mean,
                             of_normal);
    }
    return true;
}

static bool measure_view(const results *r, int index, effects *e, tables *t, failure *fault)
{
    const options *o = r->options;
    const bench_view *v = &r->views[index];
    scene_view at;
    float radius;
    truth_request request = {.name = v->name, .cache = o->cache, .radius = v->radius, .rays = o->rays, .seed = o->seed};
    scene *shown = bench_scene_open(&r->scenes[index], o->size[0], o->size[1], &at, &radius, fault);
    subject s = {.view = v, .pixels = (size_t)o->size[0] * (size_t)o->size[1]};
    s.truth = shown ? truth_get_open(&request, shown, &at, fault) : NULL;
    request.seed++;
    s.other = s.truth ? truth_get_open(&request, shown, &at, fault) : NULL;
    s.got = malloc(4 * s.pixels * sizeof *s.got);
    bool done = s.other && s.got && bent_light_open(&s.light, v, shown, &at, o, fault);
    if (!s.got)
        fault_set_memory(fault);
    if (done) {
        char id[32];
        const figures of_normal = compare(&s, v->normals, 3);
        snprintf(id, sizeof id, "rays-%d", o->rays);
        add_row(&t->degrees, &s, "normal", "normals", of_normal);
        add_row(&t->degrees, &s, id, "normals", compare(&s, s.other, 3));
        done = measure_levels(r, &s, e, of_normal.occluded, t, fault);
    }
    free(s.truth);
    free(s.other);
    free(s.got);
    bent_light_close(&s.light);
    scene_destroy(shown);
    return done;
}

bool bent_measure(const results *r, effects *e, failure *fault)
{
    tables t;
    if (!table_begin(&t.degrees, r->options, r->context, "bent",
                     "configuration inputs scene mean rms median p95 occluded_mean", fault) ||
        !table_begin(&t.light, r->options, r->context, "bent-light",
                     "configuration scene matte matte_bent glossy glossy_lobe glossy_bent", fault))
        return false;
    bool done = true;
    for (int i = 0; done && i < r->view_count; i++) {
        progress_show("bent normals %d/%d", i + 1, r->view_count);
        done = measure_view(r, i, e, &t, fault);
    }
    progress_clear();
    return table_end(&t.degrees, fault) && table_end(&t.light, fault) && done;
}
