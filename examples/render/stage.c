/* SPDX-License-Identifier: MIT */
#include "stage.h"

#include <stdio.h>
#include <stdlib.h>

scene *stage_load_scene(const options *o, char *error, size_t error_size)
{
    if (!o->scene_path)
        return scene_make(o->scene_name, error, error_size);
    return o->time_s.given ? scene_load_at(o->scene_path, (double)o->time_s.value, error, error_size)
                           : scene_load(o->scene_path, error, error_size);
}

bool stage_open(stage *st, const scene *s, const stage *like, char *error, size_t error_size)
{
    *st = (stage){.scene = s, .lights = malloc((s->light_count + 1u) * sizeof *st->lights)};
    if (!st->lights) {
        snprintf(error, error_size, "out of memory");
        return false;
    }
    st->lighting = scene_lighting_of(s, st->lights);
    st->renderer = scene_renderer_create_like(s, like ? like->renderer : NULL, error, error_size);
    return st->renderer;
}

void stage_close(stage *st)
{
    trace_scene_destroy(st->traced);
    scene_renderer_destroy(st->renderer);
    free(st->lights);
    *st = (stage){0};
}

bool stage_trace(stage *st, char *error, size_t error_size)
{
    if (!st->traced)
        st->traced = trace_scene_create(st->scene, error, error_size);
    return st->traced;
}
