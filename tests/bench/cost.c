/* SPDX-License-Identifier: MIT
 *
 * glssao-cost: the price of the quality levels as the picture or the radius grows, and all that a host pays: compute,
 * apply, first frame, memory of maps. Writes sweep.tsv and host.tsv. No rays are traced.
 */
#include "clock.h"
#include "configs.h"
#include "context.h"
#include "gbuffer.h"
#include "gl_counter.h"
#include "measure.h"
#include "scenes.h"
#include "statistics.h"
#include "table.h"
#include "tool.h"
#include "truth.h"

#include <glssao/glssao.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LEVELS = GLSSAO_ULTRA + 1, CASES = 2 * LEVELS, WARM_UP = 1, IN_A_ROW = 50 };
static const int sizes[][2] = {{854, 480}, {1280, 720}, {1920, 1080}, {2560, 1440}, {3840, 2160}};
static const double radii[] = {0.25, 0.5, 1, 2, 4};

typedef struct cost {
    options options;
    context *context;
    bool software;
    bench_scene scene;
    char error[4096];
} cost;

/* One size of the picture, with an effect for each level and input. */
typedef struct stage {
    int width, height;
    float radius;
    gbuffer gbuffer;
    GLuint color, framebuffer;
    glssao_effect *effects[CASES];
    double first_ms[CASES], bytes[CASES];
    double compute_ms[CASES], apply_ms[CASES];
} stage;

static glssao_settings settings_of(int which, double radius)
{
    const glssao_settings s = glssao_default_settings(GLSSAO_HORIZON, (glssao_quality)(which % LEVELS));
    return bench_scale_settings(&s, (float)radius);
}

static bool fail(cost *c, const char *call, glssao_result result)
{
    snprintf(c->error, sizeof c->error, "%s: %s", call, glssao_result_string(result));
    return false;
}

static bool make_effect(cost *c, stage *s, int which)
{
    const glssao_config config = {.load = gl_counter_load,
                                  .log = glssao_log_to_stderr,
                                  .width = s->width,
                                  .height = s->height,
                                  .no_timers = true,
                                  .path = (glssao_path)c->options.path};
    const glssao_settings settings = settings_of(which, (double)s->radius);
    const glssao_frame frame = gbuffer_frame(&s->gbuffer, which >= LEVELS);
    gl_counter_start(context_load, c->context);
    gl.Finish();
    const double start = clock_wall_ms();
    glssao_result result = glssao_create(&config, &s->effects[which]);
    if (result == GLSSAO_OK)
        result = glssao_compute(s->effects[which], &frame, &settings);
    gl.Finish();
    s->first_ms[which] = clock_wall_ms() - start;
    s->bytes[which] = (double)gl_counter_take().bytes;
    return result == GLSSAO_OK || fail(c, "the first frame", result);
}

static bool open_stage(cost *c, stage *s, int width, int height)
{
    scene_view view;
    *s = (stage){.width = width, .height = height};
    scene *shown = bench_scene_open(&c->scene, width, height, &view, &s->radius, FAULT(c->error));
    bool done = shown && gbuffer_draw(&s->gbuffer, shown, &view, 0, FAULT(c->error));
    scene_destroy(shown);
    s->color = gl_make_texture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, width, height, NULL);
    (void)gl_make_framebuffer(s->color, 0, &s->framebuffer);
    for (int i = 0; done && i < CASES; i++)
        done = make_effect(c, s, i);
    return done;
}

static void close_stage(stage *s)
{
    for (int i = 0; i < CASES; i++)
        glssao_destroy(s->effects[i]);
    gl.DeleteFramebuffers(1, &s->framebuffer);
    gl.DeleteTextures(1, &s->color);
    gbuffer_destroy(&s->gbuffer);
}

/* Milliseconds of one call; on a GPU the mean of many in a row. Negative, with the error set, on failure. */
static double time_call(cost *c, stage *s, int which, double radius, bool apply)
{
    const glssao_settings settings = settings_of(which, radius);
    const glssao_frame frame = gbuffer_frame(&s->gbuffer, which >= LEVELS);
    const int count = c->software ? 1 : IN_A_ROW;
    glssao_result result = GLSSAO_OK;
    gl.Finish();
    const double start = clock_wall_ms();
    for (int i = 0; i < count && result == GLSSAO_OK; i++)
        result = apply ? glssao_apply(s->effects[which], s->framebuffer)
                       : glssao_compute(s->effects[which], &frame, &settings);
    gl.Finish();
    if (result != GLSSAO_OK)
        fail(c, apply ? "glssao_apply" : "glssao_compute", result);
    return result == GLSSAO_OK ? (clock_wall_ms() - start) / count : -1;
}

/* The cases take turns. */
static bool time_stage(cost *c, stage *s, double radius, bool apply, double out_ms[CASES])
{
    const int frames = c->options.frames < 1 ? 1 : c->options.frames;
    double *values = malloc((size_t)frames * CASES * sizeof *values);
    bool done = values != NULL;
    for (int f = -WARM_UP; done && f < frames; f++)
        for (int i = 0; done && i < CASES; i++) {
            const double ms = time_call(c, s, i, radius, apply);
            done = ms >= 0;
            if (f >= 0)
                values[i * frames + f] = ms;
        }
    for (int i = 0; done && i < CASES; i++)
        out_ms[i] = statistics_percentile(values + i * frames, frames, 50);
    free(values);
    return done;
}

static void add_case(table *t, int which)
{
    static const char *const names[LEVELS] = {"horizon-low", "horizon-medium", "horizon-high", "horizon-ultra"};
    table_text(t, names[which % LEVELS]);
    table_text(t, which < LEVELS ? "normals" : "depth");
}

static void add_sweep(table *t, const char *kind, double value, const double ms[CASES])
{
    for (int i = 0; i < CASES; i++) {
        table_text(t, kind);
        add_case(t, i);
        TABLE_END_ROW(t, value, ms[i]);
    }
}

static bool write_host(cost *c, const stage *s)
{
    table t;
    if (!table_begin(&t, &c->options, c->context, "host", "configuration inputs compute_ms apply_ms first_ms mib",
                     FAULT(c->error)))
        return false;
    for (int i = 0; i < CASES; i++) {
        add_case(&t, i);
        TABLE_END_ROW(&t, s->compute_ms[i], s->apply_ms[i], s->first_ms[i], s->bytes[i] / 1048576);
    }
    return table_end(&t, FAULT(c->error));
}

static bool sweep_sizes(cost *c, table *t)
{
    const int part = c->options.quick ? 8 : 1;
    bool done = true;
    for (size_t i = 0; done && i < sizeof sizes / sizeof sizes[0]; i++) {
        const int width = sizes[i][0] / part, height = sizes[i][1] / part;
        stage s;
        double ms[CASES];
        done = open_stage(c, &s, width, height) && time_stage(c, &s, (double)s.radius, false, ms);
        if (done)
            add_sweep(t, "size", width * height * 1e-6, ms);
        fprintf(stderr, "%dx%d is timed\n", width, height);
        close_stage(&s);
    }
    return done;
}

static bool sweep_radii(cost *c, table *t)
{
    stage s;
    double ms[CASES];
    bool done = open_stage(c, &s, c->options.time_size[0], c->options.time_size[1]) &&
                time_stage(c, &s, (double)s.radius, false, s.compute_ms) &&
                time_stage(c, &s, (double)s.radius, true, s.apply_ms) && write_host(c, &s);
    for (size_t i = 0; done && i < sizeof radii / sizeof radii[0]; i++) {
        done = time_stage(c, &s, radii[i] * (double)s.radius, false, ms);
        if (done)
            add_sweep(t, "radius", radii[i], ms);
    }
    close_stage(&s);
    return done;
}

static bool choose_scene(cost *c)
{
    static bench_scene scenes[BENCH_SCENES_MAX];
    const int count = bench_scenes_list(&c->options, scenes);
    for (int i = 0; i < count; i++)
        if (strcmp(scenes[i].name, c->options.time_scene) == 0) {
            c->scene = scenes[i];
            return true;
        }
    snprintf(c->error, sizeof c->error, "no scene has the name %s", c->options.time_scene);
    return false;
}

static bool measure(cost *c)
{
    table t;
    c->context = tool_open(&c->options, FAULT(c->error));
    if (!c->context || !choose_scene(c))
        return false;
    c->software = context_is_software(c->context);
    if (!table_begin(&t, &c->options, c->context, "sweep", "kind configuration inputs value ms", FAULT(c->error)))
        return false;
    const bool measured = sweep_sizes(c, &t) && sweep_radii(c, &t);
    return table_end(&t, FAULT(c->error)) && measured;
}

int main(int argc, char **argv)
{
    static cost c;
    const int code = tool_begin("glssao-cost", argc, argv, &c.options);
    if (code >= 0)
        return code;
    const bool done = measure(&c);
    context_destroy(c.context);
    return tool_end("glssao-cost", done, c.error);
}
