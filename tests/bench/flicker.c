/* SPDX-License-Identifier: MIT
 *
 * One scene at a time, at half the measuring size.
 */
#include "flicker.h"

#include "peers.h"
#include "progress.h"
#include "sequence.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* How the camera moves from frame to frame. */
typedef enum motion { TURNS = 0, ROLLS, MOTIONS } motion;
static const float step_rad[MOTIONS] = {0.5f * 0.01745329252f, 25 * 0.01745329252f};
enum { ROLL_FRAMES = 3 };

typedef struct clip {
    float radius;
    int count;
    gbuffer *frames;
    float **distance;
    float *result[2];  /* of the last frame and of this one */
    peer_bench *peers; /* NULL: none; a value of the two below for each frame */
    peer_view *views;
    replay_inputs *inputs;
} clip;

/* About the axis of the view (Rodrigues' formula). */
static camera rolled(const camera *c, float angle_rad)
{
    camera r = *c;
    float axis[3], length = 0, along = 0;
    for (int i = 0; i < 3; i++) {
        axis[i] = c->target[i] - c->eye[i];
        length += axis[i] * axis[i];
    }
    for (int i = 0; i < 3; i++) {
        axis[i] /= sqrtf(length);
        along += axis[i] * c->up[i];
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        r.up[i] = c->up[i] * cosf(angle_rad) + (axis[j] * c->up[k] - axis[k] * c->up[j]) * sinf(angle_rad) +
                  axis[i] * along * (1 - cosf(angle_rad));
    }
    return r;
}

static bool clip_draw(clip *k, const bench_scene *b, motion how, int width, int height, failure *fault)
{
    scene_view view;
    scene *s = bench_scene_open(b, width, height, &view, &k->radius, fault);
    bool drawn = s != NULL;
    for (int i = 0; drawn && i < k->count; i++) {
        float *normals;
        const camera start = bench_scene_camera(b, s, (float)width / (float)height);
        const float angle = step_rad[how] * (float)i;
        const float up[3] = {0.0f, 1.0f, 0.0f};
        const camera now = how == TURNS ? camera_turned(&start, start.target, up, angle) : rolled(&start, angle);
        view = camera_view(&now, width, height);
        drawn = gbuffer_draw(&k->frames[i], s, &view, 0, fault);
        if (drawn) {
            gbuffer_read(&k->frames[i], &k->distance[i], &normals);
            free(normals);
            drawn = k->distance[i] != NULL;
        }
        if (drawn && k->peers) {
            k->views[i] =
                (peer_view){&k->frames[i], k->radius, peers_distance(k->distance[i], (size_t)width * (size_t)height)};
            drawn = replay_inputs_create(&k->inputs[i], &k->frames[i]);
        }
    }
    scene_destroy(s);
    return drawn;
}

static void clip_clear(clip *k)
{
    for (int i = 0; i < k->count; i++) {
        gbuffer_destroy(&k->frames[i]);
        replay_inputs_destroy(&k->inputs[i]);
        free(k->distance[i]);
        k->distance[i] = NULL;
    }
}

static bool run_peer(const clip *k, const config_result *c, int frame, failure *fault)
{
    const scene_view *view = &k->frames[frame].view;
    replay *p = peers_load(k->peers, c->config.peer, &k->views[frame], fault);
    if (!p)
        return false;
    replay_draw(k->peers->replayer, p, &k->inputs[frame]);
    const bool ran = replay_read(p, view->width, view->height, k->result[frame % 2], fault);
    replay_destroy(p);
    return ran;
}

/* A frame into its place in k->result; contrast techniques with the exponent that fits best. */
static bool run_frame(const clip *k, const config_result *c, int frame, effects *e, map_reader *m, failure *fault)
{
    glssao_settings settings = c->config.settings;
    float *result = k->result[frame % 2];
    const bool contrast = bench_has_contrast(&c->config);
    if (contrast)
        settings.power = 1;
    const effect_job job = {.gbuffer = &k->frames[frame],
                            .settings = &settings,
                            .radius = k->radius,
                            .depth_alone = c->config.inputs == INPUTS_DEPTH};
    if (!(c->config.kind == BENCH_PEER ? run_peer(k, c, frame, fault) : effects_run(e, m, &job, result, fault)))
        return false;
    for (int i = 0; contrast && i < m->width * m->height; i++)
        result[i] = powf(result[i], (float)c->exponent);
    return true;
}

/* RMS of the change between frames that follow each other; NAN where no point is seen twice. */
static bool measure_config(const clip *k, const config_result *c, effects *e, map_reader *m, double *out,
                           failure *fault)
{
    frame_change change = {0, 0};
    for (int i = 0; i < k->count; i++) {
        if (!run_frame(k, c, i, e, m, fault))
            return false;
        const sequence_frame now = {k->frames[i].view, k->distance[i], k->result[i % 2]};
        if (i > 0) {
            const sequence_frame before = {k->frames[i - 1].view, k->distance[i - 1], k->result[(i - 1) % 2]};
            sequence_compare(&change, &before, &now);
        }
    }
    *out = change.pixels > 0 ? sqrt(change.sum2 / change.pixels) : NAN;
    return true;
}

static bool is_measured(const bench_config *c)
{
    return c->kind == BENCH_PEER || (c->kind == BENCH_EFFECT && (c->level || c->inputs == INPUTS_DEPTH));
}

static bool measure_scene(results *r, int view, motion how, clip *k, effects *e, map_reader *m, failure *fault)
{
    progress_show("%s change: %s", how == TURNS ? "frame" : "roll", r->views[view].name);
    k->count = how == TURNS ? r->options->sequence_frames : ROLL_FRAMES;
    bool done = clip_draw(k, &r->scenes[view], how, m->width, m->height, fault) &&
                (!k->peers || peers_record_configs(r, k->views, k->count, fault));
    for (int i = 0; done && !r->options->record && i < r->config_count; i++)
        if (is_measured(&r->configs[i].config))
            done = measure_config(
                k, &r->configs[i], e, m,
                how == TURNS ? &r->configs[i].views[view].frame_change : &r->configs[i].views[view].roll_change, fault);
    clip_clear(k);
    return done;
}

bool flicker_measure(results *r, context *c, failure *fault)
{
    const options *o = r->options;
    const int width = o->size[0] / 2, height = o->size[1] / 2;
    const size_t pixels = (size_t)width * (size_t)height,
                 frames = (size_t)(o->sequence_frames > ROLL_FRAMES ? o->sequence_frames : ROLL_FRAMES);
    clip k = {.frames = calloc(frames + 1, sizeof *k.frames),
              .distance = calloc(frames + 1, sizeof *k.distance),
              .result = {calloc(pixels, sizeof(float)), calloc(pixels, sizeof(float))},
              .peers = r->peers,
              .views = calloc(frames + 1, sizeof *k.views),
              .inputs = calloc(frames + 1, sizeof *k.inputs)};
    effects e = {.context = c, .width = width, .height = height, .seed = o->seed, .path = (glssao_path)o->path};
    map_reader m = {.width = 0};
    bool done = k.frames && k.distance && k.result[0] && k.result[1] && k.views && k.inputs;
    if (!done)
        fault_set_memory(fault);
    done = done && map_reader_create(&m, width, height, fault);
    for (int i = 0; done && i < r->view_count * MOTIONS; i++)
        done = measure_scene(r, i / MOTIONS, (motion)(i % MOTIONS), &k, &e, &m, fault);
    progress_clear();
    effects_destroy(&e);
    map_reader_destroy(&m);
    free(k.frames);
    free(k.distance);
    free(k.views);
    free(k.inputs);
    free(k.result[0]);
    free(k.result[1]);
    return done;
}
