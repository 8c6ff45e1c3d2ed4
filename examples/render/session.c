/* SPDX-License-Identifier: MIT */
#include "session.h"

#include "clock.h"
#include "gl.h"
#include "outputs.h"
#include "progress.h"
#include "stop.h"

#include <stdio.h>
#include <string.h>

enum { WARM_UP_FRAMES = 3 };

bool session_open(session *s, const options *o, bool quiet, failure *why)
{
    s->context = context_create(&(context_options){.kind = (context_kind)o->context}, why->text, why->size);
    if (!s->context || !gl_load(context_load, s->context, why->text, why->size))
        return false;
    s->writer = writer_create();
    s->readback = s->writer ? readback_create(s->writer) : NULL;
    if (!s->readback)
        return fault_set(why, "out of memory");
    if (!quiet)
        fprintf(stderr, "context: %s\n", context_description(s->context));
    return true;
}

void session_close(session *s)
{
    readback_destroy(s->readback);
    writer_destroy(s->writer);
    bench_destroy(&s->bench);
    if (s->readback) /* then OpenGL is loaded */
        pipeline_destroy(&s->pipeline);
    context_destroy(s->context);
    *s = (session){.context = NULL};
}

/* By default 4 samples a pixel on a GPU, where a frame takes about a millisecond, and 1 on a software rasteriser, where
 * it takes about a hundred. */
static int choose_samples(const session *s)
{
    const options *o = s->options;
    return o->samples_per_pixel ? o->samples_per_pixel : o->bench || context_is_software(s->context) ? 1 : 4;
}

static pipeline_wants choose_wants(const session *s)
{
    const options *o = s->options;
    const bool maps_alone = !o->output && (o->ao || o->normals || o->depth);
    pipeline_wants wants = {.picture = o->bench || !maps_alone};
    wants.maps = o->ao || o->normals || o->depth || o->debug_map;
    wants.samples = choose_samples(s);
    wants.ao = !o->no_ao && (wants.picture || o->ao);
    wants.ao_map = o->ao || o->debug_map == OPTIONS_MAP_AO || o->debug_map == OPTIONS_MAP_TILES ||
                   o->debug_map == OPTIONS_MAP_BENT;
    wants.traced = wants.ao && o->technique == OPTIONS_RAYTRACE;
    wants.motion = wants.ao && o->fps.given && pipeline_settings(o, s->scene).history > 0;
    wants.rays = wants.ao && (o->rays || o->technique == GLSSAO_RAYS);
    wants.normal_map = o->normals || o->debug_map == OPTIONS_MAP_NORMALS;
    wants.normals = (wants.ao && !wants.traced) || wants.normal_map || o->debug_map == OPTIONS_MAP_RANDOM;
    wants.timers = o->stats || o->bench;
    /* Where nothing reads depth, a pre-pass pays if it saves shading of hidden surfaces; more triangles than pixels
     * cost more than that. */
    const bool shades_more = scene_count_triangles(s->scene) <= (uint64_t)o->width * (uint64_t)o->height;
    wants.prepass = wants.normals || o->depth || o->debug_map == OPTIONS_MAP_DEPTH || (wants.picture && shades_more);
    return wants;
}

/* The view of the job, including the margin. */
static bool find_view(session *s, float angle_rad, scene_view *out_view, failure *why)
{
    const options *o = s->options;
    if (!viewpoint_view(&s->viewpoint, s->scene, angle_rad, o->width, o->height, out_view, why))
        return false;
    *out_view = camera_widened_view(out_view, o->margin);
    return true;
}

bool session_begin(session *s, const options *o, stage *st, failure *why)
{
    s->options = o;
    s->scene = st->scene;
    s->stage = st;
    s->frames_drawn = 0;
    s->times.finish = o->stats || o->bench;
    for (int i = 0; i < 16 && gl.GetError() != GL_NO_ERROR;
         i++) { /* errors of an earlier job; a lost context never runs out of them */
    }
    scene_view view;
    stopwatch_start(&s->times);
    if (!outputs_spare_inputs(o, st->inputs, why))
        return false;
    if (!viewpoint_choose(o, s->scene, 0, &s->viewpoint, why) || !find_view(s, 0, &view, why))
        return false;
    if (!pipeline_prepare(&s->pipeline, st, context_load, s->context, o, choose_wants(s), why)) {
        pipeline_destroy(&s->pipeline);
        return false;
    }
    s->pipeline.has_last = s->pipeline.is_posed = false;
    s->pipeline.frame_number = 0;
    stopwatch_lap(&s->times, PHASE_SETUP);
    if (o->plan)
        pipeline_print_plan(&s->pipeline, &view);
    return true;
}

static bool draw(session *s, float angle_rad, scene_view *out_view, failure *why)
{
    if (!find_view(s, angle_rad, out_view, why))
        return false;
    if (!pipeline_draw(&s->pipeline, out_view, &s->times, why)) {
        pipeline_destroy(&s->pipeline);
        return false;
    }
    if (s->pipeline.reached.estimates > 0)
        progressive_print(s->options->output && strcmp(s->options->output, "-") == 0 ? stderr : stdout,
                          &s->pipeline.reached, &s->pipeline.goal);
    return true;
}

bool session_bench(session *s, failure *why)
{
    const int frames = s->options->bench;
    if (!bench_create(&s->bench, frames))
        return fault_set(why, "--bench %d: out of memory", frames);
    stopwatch *times = &s->times;
    const stopwatch before = *times;
    glssao_stats stats = {0};
    times->finish = false; /* measure frames as a program draws them, without waiting between passes */
    for (int i = -WARM_UP_FRAMES; i < frames; i++) {
        scene_view view;
        const double wall = clock_wall_ms(), cpu = clock_cpu_ms();
        if (!draw(s, 0, &view, why))
            return false;
        gl.Finish();
        const double wall_ms = clock_wall_ms() - wall, cpu_ms = clock_cpu_ms() - cpu;
        stats = glssao_get_stats(s->pipeline.effect);
        if (i >= 0)
            bench_record(&s->bench, wall_ms, cpu_ms, &stats);
    }
    *times = before;
    bench_print(&s->bench, &stats, context_is_software(s->context));
    return true;
}

/* Shows the animation that many pictures after its start. A camera of the file moves with it. */
static bool pose(session *s, int frame, failure *why)
{
    const options *o = s->options;
    pipeline *p = &s->pipeline;
    if (!animation_step(&s->animation, o, frame, s->stage, &p->is_posed, why))
        return false;
    s->scene = s->animation.scene;
    stopwatch_lap(&s->times, PHASE_LOAD);
    const bool follows = s->scene->camera_count > 0 && o->camera >= 0 && !o->view;
    if (follows && !viewpoint_choose(o, s->scene, 0, &s->viewpoint, why))
        return false;
    if (!pipeline_prepare(p, &s->animation.stage, context_load, s->context, o, p->wants, why)) {
        pipeline_destroy(p);
        return false;
    }
    stopwatch_lap(&s->times, PHASE_SETUP);
    return true;
}

static bool draw_frames(session *s, bool shows_progress, writer_slip *slip, failure *why)
{
    const float full_turn = 6.283185307f;
    const options *o = s->options;
    const int count = o->frames ? o->frames : 1;
    progress shown = progress_start("frame");
    for (int i = 0; i < count; i++) {
        scene_view view;
        const float angle_rad = o->fps.given ? 0 : full_turn * (float)i / (float)count;
        stopwatch_start(&s->times);
        if (stop_signal())
            return fault_set(why, "stopped");
        if ((o->fps.given && i > 0 && !pose(s, i, why)) || !draw(s, angle_rad, &view, why) ||
            !outputs_take(o, &s->pipeline, &view, o->frames ? i + 1 : 0, s->readback, slip, why))
            return false;
        if (s->times.finish) /* the whole read-back belongs to this phase */
            readback_drain(s->readback);
        else
            readback_poll(s->readback);
        stopwatch_lap(&s->times, PHASE_READBACK);
        s->frames_drawn++;
        if (writer_has_failed(s->writer, slip)) /* the other frames would fail too */
            return session_finish(s, slip, why);
        if (shows_progress && o->frames)
            progress_count(&shown, i + 1, count);
    }
    return true;
}

bool session_draw(session *s, bool shows_progress, writer_slip *slip, failure *why)
{
    const bool done = draw_frames(s, shows_progress, slip, why);
    s->scene = s->stage->scene;
    animation_close(&s->animation);
    return done;
}

bool session_finish(session *s, writer_slip *slip, failure *why)
{
    readback_drain(s->readback);
    const bool done = writer_wait(s->writer, slip);
    s->times.ms[PHASE_ENCODE] = slip->ms;
    if (!done)
        fault_set(why, "%s", slip->error);
    return done;
}

bool session_write_stats(session *s, double start_ms, double start_cpu_ms, failure *why)
{
    const pipeline *p = &s->pipeline;
    const report facts = {.options = s->options,
                          .scene = s->scene,
                          .context = context_description(s->context),
                          .settings = p->wants.ao ? &p->settings : NULL,
                          .passes = glssao_get_stats(p->effect),
                          .reached = p->reached.estimates ? &p->reached : NULL,
                          .times = &s->times,
                          .traced = p->wants.traced ? &p->truth.stats : NULL,
                          .bench = s->bench.recorded ? &s->bench : NULL,
                          .frames = s->frames_drawn,
                          .samples_per_pixel = p->wants.samples,
                          .wall_ms = clock_wall_ms() - start_ms,
                          .cpu_ms = clock_cpu_ms() - start_cpu_ms};
    return report_write(&facts, s->options->stats, why);
}
