/* SPDX-License-Identifier: MIT */
#include "stage.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct stage_build {
    pthread_t thread;
    const scene *scene;
    trace_scene *traced;
    char error[512];
} stage_build;

scene *stage_load_pose(const options *o, double time_s, failure *why)
{
    scene_load_options file = o->file;
    file.timed = o->time_s.given;
    file.time_s = time_s;
    file.memory_bytes = (uint64_t)o->memory_mib << 20;
    return scene_load_with(o->scene_path, &file, why);
}

scene *stage_load_scene(const options *o, inputs *out_inputs, failure *why)
{
    *out_inputs = (inputs){0};
    if (!o->scene_path)
        return scene_make(o->scene_name, why);
    inputs_record(out_inputs);
    scene *s = stage_load_pose(o, (double)o->time_s.value, why);
    inputs_record(NULL);
    for (size_t i = 0; s && i < s->warning_count; i++)
        fprintf(stderr, "%s: warning: %s\n", o->scene_path, s->warnings[i]);
    return s;
}

static bool open(stage *st, const scene *s, failure *why)
{
    *st = (stage){.scene = s, .lights = malloc((s->light_count + 1u) * sizeof *st->lights)};
    if (!st->lights)
        return fault_set(why, "out of memory");
    st->lighting = scene_lighting_of(s, st->lights);
    return true;
}

bool stage_open(stage *st, const scene *s, failure *why)
{
    if (open(st, s, why))
        st->renderer = scene_renderer_create(s, why);
    return st->renderer;
}

static void *build(void *argument)
{
    stage_build *b = argument;
    b->traced = trace_scene_create(b->scene, FAULT(b->error));
    return NULL;
}

/* The upload frees opaque images alone, which the tracer does not read. Without a thread, stage_trace builds. */
static void start_build(stage *st, const options *o)
{
    const bool traces = o->rays || o->technique == GLSSAO_RAYS || o->technique == OPTIONS_RAYTRACE;
    stage_build *b = traces && !o->no_ao ? calloc(1, sizeof *b) : NULL;
    if (!b)
        return;
    b->scene = st->scene;
    if (pthread_create(&b->thread, NULL, build, b) == 0)
        st->build = b;
    else
        free(b);
}

static void finish_build(stage *st, failure *why)
{
    stage_build *b = st->build;
    if (!b)
        return;
    pthread_join(b->thread, NULL);
    st->traced = b->traced;
    if (!b->traced)
        fault_set(why, "%s", b->error);
    free(b);
    st->build = NULL;
}

bool stage_open_spending(stage *st, scene *s, const stage *like, const options *o, failure *why)
{
    if (!open(st, s, why))
        return false;
    start_build(st, o);
    st->renderer = scene_renderer_create_spending(s, like ? like->renderer : NULL, why);
    return st->renderer;
}

bool stage_pose(stage *st, const scene *next, failure *why)
{
    char ignored[64];
    finish_build(st, FAULT(ignored));
    const stage before = *st;
    const bool done = open(st, next, why);
    trace_scene_destroy(before.traced);
    free(before.lights);
    st->renderer = before.renderer;
    return done;
}

void stage_close(stage *st)
{
    char ignored[64];
    finish_build(st, FAULT(ignored));
    trace_scene_destroy(st->traced);
    scene_renderer_destroy(st->renderer);
    free(st->lights);
    *st = (stage){0};
}

bool stage_trace(stage *st, failure *why)
{
    if (st->build)
        finish_build(st, why);
    else if (!st->traced)
        st->traced = trace_scene_create(st->scene, why);
    return st->traced;
}
