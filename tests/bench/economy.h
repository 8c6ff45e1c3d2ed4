/* SPDX-License-Identifier: MIT
 *
 * What glssao-economy measures: scenes with all tiles and with tiles skipped; a frame as effects are added; pictures of
 * which a growing share needs no work; and the first frame.
 */
#pragma once

#include "context.h"
#include "gbuffer.h"
#include "options.h"
#include "scenes.h"

/* One scene with one configuration: with all tiles, and with tiles skipped. */
typedef struct economy_row {
    char name[64];
    int config;
    double ms[2];   /* median of a frame: CPU time of all threads on a software rasteriser, GPU time otherwise */
    double skipped; /* share of the picture */
    double worst;   /* difference of the two pictures, in steps of R16 */
    int programs[2];
    int64_t bytes[2]; /* of the effect's textures */
} economy_row;

enum { ECONOMY_CONFIGS = 5, ECONOMY_STEPS = 8, ECONOMY_SHARES = 9, ECONOMY_FIRSTS = 4 };

/* A frame of the renderer with one effect more than the step before: with all tiles, and with tiles skipped. */
typedef struct economy_step {
    const char *what;
    double ms[2];
    int draws; /* of the effect, planned */
} economy_step;

/* A whole frame of the renderer: with everything on although the scene does not need it, and as planned. */
typedef struct economy_whole {
    char name[64];
    double ms[2];       /* median of a frame: processor time of all threads on a software rasteriser, else wall time */
    double first_ms[2]; /* renderer, effect and one frame, without the driver's cache */
    double skipped;     /* share of the estimate's pixels, planned */
    int draws[2], programs[2];
    int64_t bytes[2]; /* of textures */
} economy_whole;

typedef struct economy {
    const options *options;
    context *context;
    bool software;
    economy_row *rows;
    int row_count;
    economy_whole *wholes;
    int whole_count;
    char driver_cache[1024]; /* where Mesa and NVIDIA's driver are told to cache programs */
    const char *step_scene;
    economy_step steps[ECONOMY_STEPS];
    economy_row shares[2][ECONOMY_SHARES]; /* of sky and of a plane; the rest is rough */
    double first_ms[ECONOMY_FIRSTS];       /* of glssao_create and a frame: see economy_first_name */
} economy;

glssao_settings economy_settings(int config);
const char *economy_config_name(int config);
const char *economy_first_name(int first);

/* Fills *out except for its name and configuration. */
bool economy_compare(const economy *e, const glssao_frame *frame, int width, int height,
                     const glssao_settings *settings, economy_row *out, failure *fault);

/* Share of the picture whose tiles the last frame skipped. */
double economy_skipped_share(const glssao_effect *effect);

/* economy_whole.c: fills e->wholes, which has room for `count`. */
bool economy_measure_wholes(economy *e, const bench_scene *scenes, int count, failure *fault);

/* economy_steps.c */
bool economy_measure_steps(economy *e, failure *fault);

/* economy_shares.c */
bool economy_measure_shares(economy *e, failure *fault);

/* economy_report.c: writes economy-*.tsv into the output folder. */
bool economy_write(const economy *e, failure *fault);
