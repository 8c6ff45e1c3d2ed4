/* SPDX-License-Identifier: MIT
 *
 * A frame of the example renderer as its effects are added one by one.
 */
#include "economy.h"

#include "camera.h"
#include "clock.h"
#include "measure.h"
#include "scenes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Each step has what the one before has. */
static const struct {
    const char *what;
    bool main, sky, shadows;
    int quality; /* of the horizon technique; -1: no occlusion */
    bool multi_bounce;
} steps[ECONOMY_STEPS] = {
    {"depth and normals", false, false, false, -1, false},
    {"materials and light", true, false, false, -1, false},
    {"sky", true, true, false, -1, false},
    {"shadows", true, true, true, -1, false},
    {"occlusion, low", true, true, true, GLSSAO_LOW, false},
    {"medium: to full size", true, true, true, GLSSAO_MEDIUM, false},
    {"high: more samples", true, true, true, GLSSAO_HIGH, false},
    {"multi-bounce tint", true, true, true, GLSSAO_HIGH, true},
};

typedef struct stage {
    scene *scene;
    scene_view view;
    float radius;
    scene_renderer *renderer;
    scene_lighting lighting;
    glssao_effect *effect;
    GLuint depth, color, framebuffer;
} stage;

static bool open_stage(const economy *e, stage *s, char *error, size_t error_size)
{
    static bench_scene scenes[BENCH_SCENES_MAX];
    const int count = bench_scenes_list(e->options, scenes);
    const int w = e->options->time_size[0], h = e->options->time_size[1];
    int chosen = 0;
    for (int i = 0; i < count; i++)
        chosen = strcmp(scenes[i].name, e->step_scene) == 0 ? i : chosen;
    s->scene = bench_scene_open(&scenes[chosen], w, h, &s->view, &s->radius, error, error_size);
    s->renderer = s->scene ? scene_renderer_create(s->scene, error, error_size) : NULL;
    if (!s->renderer)
        return false;
    const glssao_config config = {.load = context_load,
                                  .load_user = e->context,
                                  .log = glssao_log_to_stderr,
                                  .width = w,
                                  .height = h,
                                  .no_timers = true};
    if (glssao_create(&config, &s->effect) != GLSSAO_OK) {
        snprintf(error, error_size, "no effect of %dx%d", w, h);
        return false;
    }
    gl.GenTextures(1, &s->depth);
    gl.BindTexture(GL_TEXTURE_2D, s->depth);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, w, h, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, NULL);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl.GenTextures(1, &s->color);
    gl.BindTexture(GL_TEXTURE_2D, s->color);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, w, h, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    gl.GenFramebuffers(1, &s->framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, s->framebuffer);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, s->color, 0);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, s->depth, 0);
    return true;
}

static void close_stage(stage *s)
{
    glssao_destroy(s->effect);
    if (s->renderer) {
        gl.DeleteFramebuffers(1, &s->framebuffer);
        gl.DeleteTextures(2, (const GLuint[2]){s->depth, s->color});
        scene_renderer_destroy(s->renderer);
    }
    scene_destroy(s->scene);
}

/* Returns the draw calls of the effect. */
static int draw_frame(stage *s, int step, glssao_tiles tiles)
{
    int draws = 0;
    unsigned ambient = 0;
    (void)glssao_begin_normals(s->effect, s->depth);
    scene_draw_normals(s->renderer, &s->view);
    (void)glssao_end_normals(s->effect);
    if (steps[step].quality >= 0) {
        glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, (glssao_quality)steps[step].quality);
        settings.radius = s->radius;
        settings.tiles = tiles;
        glssao_frame frame = {.depth_texture = s->depth,
                              .normal_texture = glssao_map(s->effect, GLSSAO_MAP_NORMAL, NULL, NULL)};
        memcpy(frame.projection, s->view.clip_from_view, sizeof frame.projection);
        (void)glssao_compute(s->effect, &frame, &settings);
        draws = glssao_get_stats(s->effect).draw_calls;
        ambient = glssao_map(s->effect, GLSSAO_MAP_AMBIENT, NULL, NULL);
    }
    if (steps[step].main) {
        scene_draw_shadow(s->renderer, &s->lighting);
        gl.BindFramebuffer(GL_FRAMEBUFFER, s->framebuffer);
        scene_draw_main(s->renderer, &s->view, &s->lighting, ambient);
    }
    gl.Finish();
    return draws;
}

bool economy_measure_steps(economy *e, char *error, size_t error_size)
{
    enum { WARM_UP = 2 };
    stage s = {.scene = NULL};
    const int frames = e->options->frames > 0 ? e->options->frames : 1;
    double *ms = calloc((size_t)frames * 2, sizeof *ms);
    bool done = ms && open_stage(e, &s, error, error_size);
    for (int step = 0; done && step < ECONOMY_STEPS; step++) {
        s.lighting = scene_default_lighting();
        for (int k = 0; !steps[step].sky && k < 3; k++)
            s.lighting.sky_tilt[k] = 0;
        const scene_draw_options draws = {
            .shadows = steps[step].shadows, .no_picture = !steps[step].main, .multi_bounce = steps[step].multi_bounce};
        done = scene_renderer_configure(s.renderer, &s.lighting, &draws, error, error_size);
        economy_step *out = &e->steps[step];
        out->what = steps[step].what;
        for (int f = -WARM_UP; done && f < frames; f++)
            for (int t = 0; t < 2; t++) {
                const double start = e->software ? clock_cpu_ms() : clock_wall_ms();
                out->draws = draw_frame(&s, step, t ? GLSSAO_TILES_AUTO : GLSSAO_TILES_OFF);
                if (f >= 0)
                    ms[t * frames + f] = (e->software ? clock_cpu_ms() : clock_wall_ms()) - start;
            }
        for (int t = 0; t < 2; t++)
            out->ms[t] = measure_percentile(ms + t * frames, frames, 50);
        fprintf(stderr, "%-24s off %8.2f ms, planned %8.2f ms\n", out->what, out->ms[0], out->ms[1]);
    }
    close_stage(&s);
    free(ms);
    return done;
}
