/* SPDX-License-Identifier: MIT */
#include "truth.h"

#include "progress.h"
#include "stop.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

bool truth_open(truth *t, const trace_scene *s, int width, int height, failure *why)
{
    t->scene = s;
    t->stats = (trace_stats){0};
    if (t->map && t->width == width && t->height == height)
        return true;
    truth_close(t);
    *t = (truth){.scene = s, .width = width, .height = height};
    t->accessibility = malloc((size_t)width * (size_t)height * sizeof *t->accessibility);
    if (!t->accessibility)
        return fault_set(why, "--size %dx%d: out of memory", width, height);
    t->map = gl_make_texture(GL_R32F, GL_RED, GL_FLOAT, width, height, NULL);
    return true;
}

void truth_close(truth *t)
{
    if (t->map)
        gl.DeleteTextures(1, &t->map);
    free(t->accessibility);
    *t = (truth){0};
}

static bool is_stopped(void *user)
{
    (void)user;
    return stop_signal();
}

bool truth_trace(truth *t, const scene_view *view, const glssao_settings *settings, uint32_t seed, failure *why)
{
    progress bar = progress_start("tracing");
    const trace_options options = {.radius = settings->radius,
                                   .samples = settings->sample_count,
                                   .seed = seed,
                                   .progress = progress_share,
                                   .progress_user = &bar,
                                   .stopped = is_stopped};
    trace_stats stats;
    if (!trace_accessibility(t->scene, view, &options, t->accessibility, NULL, &stats, why))
        return false;
    progress_clear();
    t->stats.rays += stats.rays;
    t->stats.seconds += stats.seconds;
    const size_t count = (size_t)t->width * (size_t)t->height;
    for (size_t i = 0; settings->power != 1 && i < count; i++)
        t->accessibility[i] = powf(t->accessibility[i], settings->power);
    gl.BindTexture(GL_TEXTURE_2D, t->map);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R32F, t->width, t->height, 0, GL_RED, GL_FLOAT, t->accessibility);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    return true;
}
