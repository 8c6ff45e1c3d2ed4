/* SPDX-License-Identifier: MIT
 *
 * The configurations that are measured: each technique at each quality level, and what changes when one choice of the
 * default level is made otherwise.
 */
#ifndef GLSSAO_BENCH_CONFIGS_H
#define GLSSAO_BENCH_CONFIGS_H

#include "options.h"

#include <glssao/glssao.h>

enum { BENCH_CONFIGS_MAX = 128, BENCH_TECHNIQUES = GLSSAO_HORIZON + 1 };

typedef struct bench_config {
    char id[48];              /* stable: technique-level, or technique-level-change */
    glssao_settings settings; /* lengths as glssao_default_settings gives them */
    bool level;               /* a quality level as it comes */
    bool beyond;              /* on bench_view.beyond */
} bench_config;

/* Fills `out` and returns how many there are. `effect` is asked whether it takes the settings; what it refuses is left
 * out. */
int bench_configs_list(const options *o, const glssao_effect *effect, bench_config out[BENCH_CONFIGS_MAX]);

const char *bench_technique_name(glssao_technique technique);
enum { BENCH_BLURS = GLSSAO_BLUR_PLANAR + 1 };
const char *bench_blur_name(glssao_blur blur);

/* True where power is a matter of taste, so that the exponent which fits best is reported too. */
bool bench_has_contrast(glssao_technique technique);

/* The settings with every length scaled along to another radius. */
glssao_settings bench_scale_settings(const glssao_settings *settings, float radius);

#endif
