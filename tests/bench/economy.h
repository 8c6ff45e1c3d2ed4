/* SPDX-License-Identifier: MIT
 *
 * What glssao-economy measures.
 */
#ifndef GLSSAO_BENCH_ECONOMY_H
#define GLSSAO_BENCH_ECONOMY_H

#include "context.h"
#include "gbuffer.h"
#include "options.h"

/* One scene with one configuration: without and with tiles left out. */
typedef struct economy_row {
    char name[64];
    int config;
    double ms[2];       /* median of a frame: CPU time of all threads on a software rasteriser, else the GPU's */
    double first_ms[2]; /* wall time of glssao_create and the first frame */
    double skipped;     /* share of the picture */
    int programs[2];
    int64_t bytes[2]; /* of the effect's textures */
} economy_row;

enum { ECONOMY_CONFIGS = 5 };

typedef struct economy {
    const options *options;
    context *context;
    bool software;
    economy_row *rows;
    int row_count;
} economy;

glssao_settings economy_settings(int config);
const char *economy_config_name(int config);

/* Fills all of *out but its name and configuration. */
bool economy_compare(const economy *e, const gbuffer *g, const glssao_settings *settings, economy_row *out, char *error,
                     size_t error_size);

#endif
