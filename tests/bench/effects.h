/* SPDX-License-Identifier: MIT
 *
 * Runs the effect on stored views. There is one effect for each technique, size and margin, because an effect
 * reallocates its maps when half_resolution changes, and that must not be timed.
 */
#pragma once

#include "configs.h"
#include "context.h"
#include "gbuffer.h"

/* Brings ambient maps to full size and reads them back, as glssao-render --ao does. */
typedef struct map_reader {
    int width, height;
    scene *scene; /* the renderer can't do without one */
    scene_renderer *renderer;
    GLuint texture, framebuffer; /* R32F */
} map_reader;

bool map_reader_create(map_reader *m, int width, int height, failure *fault);
void map_reader_destroy(map_reader *m);
/* Reads the effect's result, stretched to the reader's size. */
void map_reader_read(const map_reader *m, const glssao_effect *effect, float *out);

typedef struct effects {
    context *context;
    int width, height;
    uint32_t seed;
    glssao_path path;
    bool no_timers;
    glssao_load_fn load;                      /* NULL: context_load */
    glssao_effect *of[GLSSAO_RAYS + 1][2][2]; /* technique, half size, with a margin; made when first asked for */
} effects;

void effects_destroy(effects *e);

/* One estimate of a view. */
typedef struct effect_job {
    const gbuffer *gbuffer;
    const glssao_settings *settings; /* lengths as in bench_config; they are scaled to `radius` */
    float radius;
    uint32_t rays_texture; /* 0: none */
    bool depth_alone;      /* no normals are handed over */
    bool accumulates; /* the first estimate of glssao_accumulate, whose noise follows the seed; horizon, full size */
} effect_job;

/* The effect that these settings are run on; NULL, with one line in `error`, where it can't be made. */
glssao_effect *effects_get(effects *e, const gbuffer *g, const glssao_settings *settings, failure *fault);

/* Accessibility of the view at full size into `out`. */
bool effects_run(effects *e, map_reader *m, const effect_job *job, float *out, failure *fault);
