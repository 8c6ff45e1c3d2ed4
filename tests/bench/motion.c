/* SPDX-License-Identifier: MIT
 *
 * glssao-motion: settings with reuse of earlier frames against single frames, on recorded motions, with ray-traced
 * truth for every fourth frame. Prints a table to standard output. With --check it also writes a film of each motion:
 * film-SCENE-MOTION-SETTING.png in the output folder. `--paths NAME,...` before other options picks motions.
 */
#include "clock.h"
#include "context.h"
#include "effects.h"
#include "error_color.h"
#include "measure.h"
#include "paths.h"
#include "perception.h"
#include "picture.h"
#include "scenes.h"
#include "sequence.h"
#include "tool.h"
#include "traced.h"
#include "truth.h"
#include "words.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ERROR_LENGTH = 4096, FRAMES_MAX = 64, CONFIGS_MAX = 32, TRUTH_EVERY = 4, WARM = 15 };
static const double ERROR_RANGE = 0.25; /* gets the full colour */

/* One frame of a motion. */
typedef struct shot {
    gbuffer gbuffer;
    float *distance;
    unsigned char *is_new, *classes;
    bench_truth truth; /* nothing where this frame has none */
    perception perception;
    GLuint motion; /* texture; 0: nothing moves by itself */
} shot;

typedef struct motion {
    options options;
    context *context;
    map_reader reader;
    scene_renderer *mover; /* of what moves by itself; NULL: nothing does */
    host_rays traced;      /* of rays in a scene where only the camera moves */
    shot shots[FRAMES_MAX];
    int count;
    float radius;
    char error[ERROR_LENGTH];
} motion;

/* What is printed of a setting on one motion. */
typedef struct figures {
    double sum2, pixels, ssim, flip, new2, new_pixels;
    double cpu_ms; /* of the fastest frame but the first */
    int truths, lag;
    frame_change change;
} figures;

typedef struct config {
    char name[32];
    glssao_settings settings;
} config;

/* Where each point was in the last frame, by the demo's renderer, which keeps the pose before. */
static bool draw_motion(motion *m, const scene *s, shot *now, const shot *before)
{
    const scene_draw_options draws = {.no_picture = true, .no_prepass = true, .motion = true};
    const scene_lighting none = {0};
    const scene_view *v = &now->gbuffer.view;
    bool done = m->mover ? scene_renderer_pose(m->mover, s) : true;
    if (!m->mover) {
        m->mover = scene_renderer_create(s, FAULT(m->error));
        done = m->mover && scene_renderer_configure(m->mover, &none, &draws, FAULT(m->error));
    }
    now->motion = gl_make_texture(GL_RG32F, GL_RG, GL_FLOAT, v->width, v->height, NULL);
    GLuint framebuffer;
    done = gl_make_framebuffer(now->motion, now->gbuffer.depth, &framebuffer) && done;
    if (done)
        scene_draw_motion(m->mover, v, before ? &before->gbuffer.view : v);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.DeleteFramebuffers(1, &framebuffer);
    return done;
}

static bool make_truth(motion *m, const scene *s, shot *k, const char *name)
{
    const scene_view *v = &k->gbuffer.view;
    const size_t count = (size_t)v->width * (size_t)v->height;
    const truth_request request = {
        .name = name, .cache = m->options.cache, .radius = m->radius, .rays = m->options.rays, .seed = 0};
    if (!truth_get(&request, s, v, &k->truth, FAULT(m->error)))
        return false;
    k->classes = calloc(1, count);
    for (size_t i = 0; k->classes && i < count; i++)
        k->classes[i] = k->distance[i] > 0 && k->truth.foreground[i] ? PIXEL_SMOOTH : PIXEL_NONE;
    return k->classes && perception_create(&k->perception, k->truth.accessibility, k->classes, v->width, v->height);
}

static bool make_shot(motion *m, const bench_scene *b, scene *s, bench_path path, int frame)
{
    shot *k = &m->shots[frame];
    const int *size = m->options.size;
    const camera start = bench_scene_camera(b, s, (float)size[0] / (float)size[1]);
    camera now = path_camera(path, &start, frame);
    float *normals = NULL;
    const bool moves = path_moves_things(path);
    if (moves && !path_move_things(path, s, frame))
        return false;
    camera_fit_planes(&now, s);
    if (moves)
        now.near_plane = start.near_plane, now.far_plane = start.far_plane;
    const scene_view view = camera_view(&now, size[0], size[1]);
    if (!gbuffer_draw(&k->gbuffer, s, &view, 0, FAULT(m->error)))
        return false;
    gbuffer_read(&k->gbuffer, &k->distance, &normals);
    free(normals);
    k->is_new = calloc(1, (size_t)size[0] * (size_t)size[1]);
    if (!k->distance || !k->is_new)
        return false;
    if (frame > 0) {
        const shot *before = &m->shots[frame - 1];
        sequence_find_new(&(sequence_frame){before->gbuffer.view, before->distance, NULL},
                          &(sequence_frame){k->gbuffer.view, k->distance, NULL}, k->is_new);
    }
    if (moves && !draw_motion(m, s, k, frame > 0 ? &m->shots[frame - 1] : NULL))
        return false;
    char name[128];
    snprintf(name, sizeof name, "%.64s-%s-%d", b->name, path_name(path), frame);
    const bool wanted =
        (frame >= WARM && frame % TRUTH_EVERY == TRUTH_EVERY - 1) || (path == PATH_BOX && frame >= PATH_EVENT);
    return !wanted || make_truth(m, s, k, name);
}

static void clear_shots(motion *m)
{
    for (int i = 0; i < FRAMES_MAX; i++) {
        shot *k = &m->shots[i];
        gbuffer_destroy(&k->gbuffer);
        if (k->truth.accessibility)
            perception_destroy(&k->perception);
        truth_destroy(&k->truth);
        gl.DeleteTextures(1, &k->motion);
        free(k->distance);
        free(k->is_new);
        free(k->classes);
        *k = (shot){.motion = 0};
    }
}

static void add_truth(figures *f, shot *k, const float *result, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const double e = (double)result[i] - (double)k->truth.accessibility[i];
        if (!k->classes[i])
            continue;
        f->sum2 += e * e;
        f->pixels += 1;
        f->new2 += k->is_new[i] ? e * e : 0;
        f->new_pixels += k->is_new[i];
    }
    f->ssim += perception_ssim(&k->perception, result);
    f->flip += perception_flip(&k->perception, result);
    f->truths += 1;
}

/* One of the film's pictures, at half the size: accessibility, or its error where `truth` is given. */
static void draw_still(uint8_t *rgb, int film_width, const float *values, const float *truth, const shot *k)
{
    const int w = k->gbuffer.view.width, h = k->gbuffer.view.height;
    for (int y = 0; y < h / 2; y++)
        for (int x = 0; x < w / 2; x++) {
            double sum[3] = {0, 0, 0};
            for (int n = 0; n < 4; n++) {
                const size_t i = (size_t)(2 * y + n / 2) * (size_t)w + (size_t)(2 * x + n % 2);
                const double value = (double)values[i];
                double color[3] = {value, value, value};
                if (truth)
                    error_color(value - (double)truth[i], ERROR_RANGE, color);
                for (int c = 0; c < 3; c++)
                    sum[c] += color[c] / 4;
            }
            for (int c = 0; c < 3; c++)
                rgb[3 * ((size_t)y * (size_t)film_width + (size_t)x) + (size_t)c] =
                    (uint8_t)(255 * fmin(fmax(sum[c], 0), 1) + 0.5);
        }
}

/* Frames with truth side by side, from top to bottom: truth, each frame alone, its error, with a history, its error. */
static bool write_film(motion *m, const char *name, float *const *single, float *const *reused)
{
    enum { MOST = 6, ROWS = 5 };
    int frames[MOST], count = 0;
    for (int i = 0; i < m->count && count < MOST; i++)
        if (m->shots[i].truth.accessibility)
            frames[count++] = i;
    const int w = m->options.size[0] / 2, h = m->options.size[1] / 2, width = count * w;
    uint8_t *rgb = calloc((size_t)width * (size_t)h * ROWS, 3);
    char path[1200];
    for (int k = 0; rgb && k < count; k++) {
        const shot *s = &m->shots[frames[k]];
        const float *truth = s->truth.accessibility;
        const float *const values[ROWS] = {truth, single[frames[k]], single[frames[k]], reused[frames[k]],
                                           reused[frames[k]]};
        for (int row = 0; row < ROWS; row++)
            draw_still(rgb + 3 * ((size_t)(ROWS - 1 - row) * (size_t)h * (size_t)width + (size_t)k * (size_t)w), width,
                       values[row], row == 2 || row == 4 ? truth : NULL, s);
    }
    snprintf(path, sizeof path, "%s/film-%s.png", m->options.out, name);
    const bool done = rgb && picture_write_png(path, width, ROWS * h, 3, rgb, FAULT(m->error));
    free(rgb);
    return done;
}

/* The frames in order through one effect. `results`: of each frame, kept. */
static bool run_config(motion *m, const config *c, bench_path path, float **results, figures *f)
{
    effects e = {.context = m->context, .width = m->options.size[0], .height = m->options.size[1], .no_timers = true};
    const size_t count = (size_t)e.width * (size_t)e.height;
    bool done = true;
    for (int i = 0; done && i < m->count; i++) {
        shot *k = &m->shots[i];
        glssao_effect *effect = effects_get(&e, &k->gbuffer, &c->settings, FAULT(m->error));
        glssao_settings s = bench_scale_settings(&c->settings, m->radius);
        glssao_frame frame = gbuffer_frame(&k->gbuffer, false);
        frame.motion_texture = k->motion;
        frame.cut = path == PATH_CUT && i == PATH_EVENT;
        if (c->settings.technique == GLSSAO_RAYS) {
            const bench_config traced = {.settings = c->settings, .rays = c->settings.sample_count};
            rays_choose_offset(c->settings.history > 0 ? (uint32_t)i : 0, m->traced.offset);
            memcpy(frame.rays_offset, m->traced.offset, sizeof frame.rays_offset);
            done = traced_run(&m->traced, &k->gbuffer, &traced, m->radius, (uint32_t)i, FAULT(m->error));
            frame.rays_texture = m->traced.rays.texture;
        }
        gl.Finish();
        const double before = clock_cpu_ms();
        done = done && effect && glssao_compute(effect, &frame, &s) == GLSSAO_OK;
        gl.Finish();
        f->cpu_ms = i > 0 ? fmin(f->cpu_ms, clock_cpu_ms() - before) : INFINITY;
        if (done)
            map_reader_read(&m->reader, effect, results[i]);
        if (done && k->truth.accessibility && i >= WARM)
            add_truth(f, k, results[i], count);
        if (done && i >= WARM) {
            const shot *b = &m->shots[i - 1];
            sequence_compare(&f->change, &(sequence_frame){b->gbuffer.view, b->distance, results[i - 1]},
                             &(sequence_frame){k->gbuffer.view, k->distance, results[i]});
        }
    }
    effects_destroy(&e);
    return done;
}

/* PATH_BOX: how many frames after the event the error, where the single frame changed by more than 0.1, is back within
 * 0.02 of the single frame's. */
static int find_lag(const motion *m, float *const *single, float *const *result)
{
    const size_t count = (size_t)m->options.size[0] * (size_t)m->options.size[1];
    const shot *before = &m->shots[PATH_EVENT - 1];
    for (int i = PATH_EVENT; i < m->count; i++) {
        const shot *k = &m->shots[i];
        double sums[2] = {0, 0}, pixels = 0;
        for (size_t p = 0; p < count; p++) {
            if (!k->classes[p] || fabsf(k->distance[p] - before->distance[p]) > 1e-3f * k->distance[p] ||
                !(fabsf(single[i][p] - single[PATH_EVENT - 1][p]) > 0.1f))
                continue;
            const double t = (double)k->truth.accessibility[p];
            sums[0] += ((double)single[i][p] - t) * ((double)single[i][p] - t);
            sums[1] += ((double)result[i][p] - t) * ((double)result[i][p] - t);
            pixels += 1;
        }
        if (sqrt(sums[1] / pixels) <= sqrt(sums[0] / pixels) + 0.02)
            return i - PATH_EVENT;
    }
    return m->count;
}

static int list_configs(config out[CONFIGS_MAX])
{
    int n = 0;
    for (int q = 0; q < 5; q++)
        for (int h = 0; h < 2; h++) {
            config *c = &out[n++];
            const bool is_rays = q == 4;
            const glssao_quality quality = is_rays ? GLSSAO_MEDIUM : (glssao_quality)q;
            c->settings = glssao_default_settings(is_rays ? GLSSAO_RAYS : GLSSAO_HORIZON, quality);
            c->settings.history = h == 0 ? 0 : 16;
            snprintf(c->name, sizeof c->name, "%s%.8s%s", is_rays ? "rays-" : "",
                     words_at(QUALITY_WORDS, (int)quality).text, h == 0 ? "" : "-16");
        }
    return n;
}

static bool run_motion(motion *m, const bench_scene *b, bench_path path)
{
    scene_view view;
    config configs[CONFIGS_MAX];
    float *results[2][FRAMES_MAX] = {{0}};
    scene *s = bench_scene_open(b, m->options.size[0], m->options.size[1], &view, &m->radius, FAULT(m->error));
    bool done = s != NULL;
    m->count = m->options.sequence_frames;
    for (int i = 0; done && i < m->count; i++) {
        done = make_shot(m, b, s, path, i);
        for (int k = 0; k < 2; k++)
            results[k][i] = calloc((size_t)view.width * (size_t)view.height, sizeof(float));
    }
    scene_renderer_destroy(m->mover);
    m->mover = NULL;
    scene_destroy(s);
    const int count = list_configs(configs);
    for (int i = 0; done && i < count; i++) {
        figures f = {.lag = 0};
        char label[128];
        const bool reuses = configs[i].settings.history > 0;
        const bool is_rays = configs[i].settings.technique == GLSSAO_RAYS;
        if (!options_match(m->options.only, configs[i].name) || (is_rays && path_moves_things(path)))
            continue;
        if (is_rays && !m->traced.embree)
            done = traced_open(&m->traced, b, view.width, view.height, FAULT(m->error));
        done = done && run_config(m, &configs[i], path, results[reuses], &f);
        snprintf(label, sizeof label, "%.60s-%s-%.30s", b->name, path_name(path), configs[i].name);
        if (done && reuses && m->options.check)
            done = write_film(m, label, results[0], results[1]);
        if (path == PATH_BOX && reuses)
            f.lag = find_lag(m, results[0], results[1]);
        printf("%s\t%s\t%s\t%.4f\t%.4f\t%.4f\t%.4f\t%.4f\t%d\t%.2f\n", b->name, path_name(path), configs[i].name,
               sqrt(f.sum2 / f.pixels), f.ssim / f.truths, f.flip / f.truths, sqrt(f.change.sum2 / f.change.pixels),
               f.new_pixels > 0 ? sqrt(f.new2 / f.new_pixels) : 0, f.lag, f.cpu_ms);
        fflush(stdout);
    }
    traced_close(&m->traced);
    clear_shots(m);
    for (int i = 0; i < FRAMES_MAX; i++)
        for (int k = 0; k < 2; k++)
            free(results[k][i]);
    return done;
}

static bool run(motion *m, const char *paths)
{
    bench_scene scenes[BENCH_SCENES_MAX];
    m->context = tool_open(&m->options, FAULT(m->error));
    if (!m->context || !map_reader_create(&m->reader, m->options.size[0], m->options.size[1], FAULT(m->error)))
        return false;
    const int count = bench_scenes_list(&m->options, scenes);
    printf("# %s\n# context=%s\tsize=%dx%d\trays=%d\n", m->options.command, context_description(m->context),
           m->options.size[0], m->options.size[1], m->options.rays);
    printf("scene\tmotion\tsetting\trmse\tssim\tflip\tframe_change\tnew_rmse\tlag\tcpu_ms\n");
    for (int i = 0; i < count; i++)
        for (int p = 0; p < PATH_COUNT; p++) {
            const bool has_things = strcmp(scenes[i].name, "columns") == 0;
            if (path_moves_things((bench_path)p) != has_things || !options_match(paths, path_name((bench_path)p)))
                continue;
            if (!run_motion(m, &scenes[i], (bench_path)p))
                return false;
        }
    return true;
}

int main(int argc, char **argv)
{
    static motion m;
    const char *paths = NULL;
    if (argc > 2 && strcmp(argv[1], "--paths") == 0) {
        paths = argv[2];
        argv += 2;
        argc -= 2;
    }
    const int code = tool_begin("glssao-motion", argc, argv, &m.options);
    if (code >= 0)
        return code;
    if (m.options.sequence_frames <= WARM || m.options.sequence_frames > FRAMES_MAX) {
        fprintf(stderr, "glssao-motion: --sequence-frames %d: want %d to %d, since truth begins at frame %d\n",
                m.options.sequence_frames, WARM + 1, FRAMES_MAX, WARM);
        return 2;
    }
    const bool done = run(&m, paths);
    map_reader_destroy(&m.reader);
    context_destroy(m.context);
    return tool_end("glssao-motion", done, m.error);
}
