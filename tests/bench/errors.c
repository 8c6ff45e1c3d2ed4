/* SPDX-License-Identifier: MIT
 *
 * The pictures of one configuration are all made first, because its exponent must fit all views. Then threads measure
 * them.
 */
#include "errors.h"

#include "peers.h"
#include "progress.h"
#include "traced.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_THREADS = 64 };

typedef struct worker {
    pthread_t thread;
    const results *results;
    config_result *config;
    float *const *pictures; /* a view, with power 1 */
    int first, step;
} worker;

/* Other rays than the truth's. */
static bool run_rays(const results *r, const bench_config *c, int view, float *out, failure *fault)
{
    const options *o = r->options;
    const truth_request request = {.name = r->views[view].name,
                                   .cache = o->cache,
                                   .radius = r->views[view].radius,
                                   .rays = c->rays,
                                   .seed = o->seed + 1};
    scene_view at;
    float radius;
    bench_truth t = {.accessibility = NULL};
    scene *s = bench_scene_open(&r->scenes[view], o->size[0], o->size[1], &at, &radius, fault);
    const bool traced = s && truth_get(&request, s, &at, &t, fault);
    if (traced)
        memcpy(out, t.accessibility, (size_t)at.width * (size_t)at.height * sizeof *out);
    truth_destroy(&t);
    scene_destroy(s);
    return traced;
}

/* Replaces a picture of rays by what GLSSAO_RAYS makes of it. */
static bool denoise(const bench_config *c, const bench_view *v, effects *e, map_reader *m, float *picture,
                    failure *fault)
{
    GLuint plain = gl_make_texture(GL_R32F, GL_RED, GL_FLOAT, v->gbuffer.view.width, v->gbuffer.view.height, picture);
    const effect_job job = {
        .gbuffer = &v->gbuffer, .settings = &c->settings, .radius = v->radius, .rays_texture = plain};
    const bool ran = effects_run(e, m, &job, picture, fault);
    gl.DeleteTextures(1, &plain);
    return ran;
}

static bool run_peer(const results *r, const bench_config *c, int view, float *out, failure *fault)
{
    const bench_view *v = &r->views[view];
    const peer_view at = {&v->gbuffer, v->radius, v->median_distance};
    replay_inputs in;
    replay *p = peers_load(r->peers, c->peer, &at, fault);
    bool ran = replay_inputs_create(&in, &v->gbuffer) && p;
    if (ran) {
        replay_draw(r->peers->replayer, p, &in);
        ran = replay_read(p, v->gbuffer.view.width, v->gbuffer.view.height, out, fault);
    }
    replay_inputs_destroy(&in);
    replay_destroy(p);
    return ran;
}

static bool run_traced(const results *r, const bench_config *c, int view, effects *e, map_reader *m, float *out,
                       failure *fault)
{
    const bench_view *v = &r->views[view];
    const options *o = r->options;
    host_rays t;
    bool ran = traced_open(&t, &r->scenes[view], o->size[0], o->size[1], fault) &&
               traced_run(&t, &v->gbuffer, c, v->radius, o->seed, fault);
    if (ran) {
        const effect_job job = {
            .gbuffer = &v->gbuffer, .settings = &c->settings, .radius = v->radius, .rays_texture = t.rays.texture};
        ran = effects_run(e, m, &job, out, fault);
    }
    traced_close(&t);
    return ran;
}

bool errors_run(const results *r, const bench_config *c, int view, bool plain, effects *e, map_reader *m, float *out,
                failure *fault)
{
    const bench_view *v = &r->views[view];
    glssao_settings settings = c->settings;
    if (c->kind == BENCH_RAYS)
        return run_rays(r, c, view, out, fault) && (!c->denoised || denoise(c, v, e, m, out, fault));
    if (c->kind == BENCH_PEER)
        return run_peer(r, c, view, out, fault);
    if (c->kind == BENCH_TRACED)
        return run_traced(r, c, view, e, m, out, fault);
    if (plain)
        settings.power = 1;
    const effect_job job = {.gbuffer = c->inputs == INPUTS_BEYOND ? &v->beyond : &v->gbuffer,
                            .settings = &settings,
                            .radius = v->radius,
                            .depth_alone = c->inputs == INPUTS_DEPTH};
    return effects_run(e, m, &job, out, fault);
}

static void measure_view(bench_view *v, float *picture, double exponent, view_result *out)
{
    const int width = v->gbuffer.view.width, height = v->gbuffer.view.height;
    const size_t count = (size_t)width * (size_t)height;
    for (size_t i = 0; i < count && fabs(exponent - 1) > 0; i++)
        picture[i] = powf(picture[i], (float)exponent);
    out->error = measure_error(picture, v->truth.accessibility, v->classes, count);
    const error_measure flat = measure_error(picture, v->flat.accessibility, v->classes, count);
    out->flat_rmse = flat.rmse;
    out->flat_mean = flat.mean;
    out->ssim = perception_ssim(&v->perception, picture);
    out->flip = perception_flip(&v->perception, picture);
    out->grain = grain_measure(&v->grain, picture);
    out->specks = count_specks(picture, v->truth.accessibility, v->classes, width, height);
}

static void *run_worker(void *argument)
{
    const worker *w = argument;
    for (int i = w->first; i < w->results->view_count; i += w->step)
        measure_view(&w->results->views[i], w->pictures[i], w->config->exponent, &w->config->views[i]);
    return NULL;
}

/* What a thread that can't be started would have done is done here. */
static void measure_views(const results *r, config_result *c, float *const *pictures)
{
    worker workers[MAX_THREADS];
    bool started[MAX_THREADS];
    const int count = r->cores > MAX_THREADS ? MAX_THREADS : r->cores;
    for (int i = 0; i < count; i++) {
        workers[i] = (worker){.results = r, .config = c, .pictures = pictures, .first = i, .step = count};
        started[i] = pthread_create(&workers[i].thread, NULL, run_worker, &workers[i]) == 0;
    }
    for (int i = 0; i < count; i++) {
        if (started[i])
            pthread_join(workers[i].thread, NULL);
        else
            run_worker(&workers[i]);
    }
}

static bool measure_config(results *r, config_result *c, effects *e, map_reader *m, float *const *pictures,
                           fit_sum *fits, failure *fault)
{
    const size_t count = (size_t)m->width * (size_t)m->height;
    const bool contrast = bench_has_contrast(&c->config);
    fit_sum *all = &fits[r->view_count];
    memset(fits, 0, (size_t)(r->view_count + 1) * sizeof *fits);
    for (int i = 0; i < r->view_count; i++) {
        const bench_view *v = &r->views[i];
        if (!errors_run(r, &c->config, i, false, e, m, pictures[i], fault))
            return false;
        const error_measure as_is = measure_error(pictures[i], v->truth.accessibility, v->classes, count);
        c->views[i].by_default_rmse = as_is.rmse;
        c->views[i].by_default_mean = as_is.mean;
        const bool has_power =
            c->config.kind == BENCH_EFFECT && (c->config.settings.power > 1 || c->config.settings.power < 1);
        if (has_power && !errors_run(r, &c->config, i, true, e, m, pictures[i], fault))
            return false;
        fit_add(&fits[i], pictures[i], v->truth.accessibility, v->classes, count);
        fit_merge(all, &fits[i]);
    }
    c->exponent = contrast ? fit_exponent(all) : 1;
    measure_views(r, c, pictures);
    for (int i = 0; i < r->view_count; i++) {
        c->views[i].own_exponent = fit_exponent(&fits[i]);
        c->views[i].own_rmse = fit_rmse(&fits[i], c->views[i].own_exponent);
    }
    return true;
}

static bool record_peers(const results *r, failure *fault)
{
    peer_view views[BENCH_SCENES_MAX];
    for (int i = 0; i < r->view_count; i++)
        views[i] = (peer_view){&r->views[i].gbuffer, r->views[i].radius, r->views[i].median_distance};
    return peers_record_configs(r, views, r->view_count, fault);
}

bool errors_measure(results *r, effects *e, map_reader *m, failure *fault)
{
    const size_t count = (size_t)m->width * (size_t)m->height;
    float *pictures[BENCH_SCENES_MAX] = {NULL};
    fit_sum *fits = calloc((size_t)r->view_count + 1, sizeof *fits);
    bool measured = fits != NULL;
    for (int i = 0; measured && i < r->view_count; i++)
        measured = (pictures[i] = malloc(count * sizeof *pictures[i])) != NULL;
    if (!measured)
        fault_set_memory(fault);
    measured = measured && (!r->peers || record_peers(r, fault));
    for (int i = 0; measured && !r->options->record && i < r->config_count; i++) {
        progress_show("error %d/%d: %s", i + 1, r->config_count, r->configs[i].config.id);
        measured = measure_config(r, &r->configs[i], e, m, pictures, fits, fault);
    }
    progress_clear();
    for (int i = 0; i < r->view_count; i++)
        free(pictures[i]);
    free(fits);
    return measured;
}
