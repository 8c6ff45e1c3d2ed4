/* SPDX-License-Identifier: MIT
 *
 * Runs the effect on stored views. One effect for each technique and size, with a margin or without, because an effect
 * makes its maps anew when half_resolution changes, which would be timed too.
 */
#ifndef GLSSAO_BENCH_EFFECTS_H
#define GLSSAO_BENCH_EFFECTS_H

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

bool map_reader_create(map_reader *m, int width, int height, char *error, size_t error_size);
void map_reader_destroy(map_reader *m);

typedef struct effects {
    context *context;
    int width, height;
    uint32_t seed;
    glssao_path path;
    bool no_timers;
    glssao_load_fn load;                       /* NULL: context_load */
    glssao_effect *of[BENCH_TECHNIQUES][2][2]; /* technique, half size, with a margin; made when first asked for */
} effects;

void effects_destroy(effects *e);

/* The effect that these settings are run on; NULL, with one line in `error`, where it can't be made. */
glssao_effect *effects_get(effects *e, const gbuffer *g, const glssao_settings *settings, char *error,
                           size_t error_size);

/* Accessibility of the view at full size into `out`; settings as in bench_config, scaled to the radius here. */
bool effects_run(effects *e, map_reader *m, const gbuffer *g, float radius, const glssao_settings *settings, float *out,
                 char *error, size_t error_size);

/* The same for the first estimate of glssao_accumulate, whose noise follows the effect's seed; horizon, full size. */
bool effects_run_noise(effects *e, map_reader *m, const gbuffer *g, float radius, const glssao_settings *settings,
                       float *out, char *error, size_t error_size);

#endif
