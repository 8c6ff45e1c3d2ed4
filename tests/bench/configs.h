/* SPDX-License-Identifier: MIT
 *
 * The configurations that are measured: each technique at each quality level; the default level with one setting
 * changed; and ray tracing with few rays.
 */
#pragma once

#include "options.h"

#include <glssao/glssao.h>

enum { BENCH_CONFIGS_MAX = 160, BENCH_TECHNIQUES = GLSSAO_HORIZON + 1 /* of screen space */ };

typedef enum bench_kind { BENCH_EFFECT = 0, BENCH_RAYS, BENCH_PEER, BENCH_TRACED } bench_kind;

/* What the host hands over: depth and normals; depth alone; or both with a margin and a second layer,
 * bench_view.beyond. */
typedef enum bench_inputs { INPUTS_NORMALS = 0, INPUTS_DEPTH, INPUTS_BEYOND } bench_inputs;

typedef struct bench_config {
    char id[48]; /* stable: technique-level, or technique-level-change; rays-N, rays-N-denoised; the peer's name;
                    rays-level, or technique-level-with-N-rays, where -adaptive may follow */
    bench_kind kind;
    bench_inputs inputs;
    bool level; /* a quality level as it comes */
    glssao_settings
        settings;  /* BENCH_EFFECT, BENCH_TRACED, and of the denoiser; lengths as glssao_default_settings gives them */
    bool adaptive; /* BENCH_TRACED: about so many rays, where they are needed */
    bool denoised; /* BENCH_RAYS: by GLSSAO_RAYS at full size */
    int rays;      /* BENCH_RAYS: a pixel; BENCH_TRACED: a pixel of the estimate */
    int peer;      /* BENCH_PEER: its number */
} bench_config;

/* Fills `out` and returns how many there are. Settings that `effect` refuses are left out. */
int bench_configs_list(const options *o, const glssao_effect *effect, bench_config out[BENCH_CONFIGS_MAX]);

const char *bench_technique_name(glssao_technique technique);
enum { BENCH_BLURS = GLSSAO_BLUR_PLANAR + 1 };
const char *bench_blur_name(glssao_blur blur);

/* True where power is a matter of taste, so that the exponent that fits best is applied. */
bool bench_has_contrast(const bench_config *c);

/* The settings with every length scaled along to another radius. */
glssao_settings bench_scale_settings(const glssao_settings *settings, float radius);
