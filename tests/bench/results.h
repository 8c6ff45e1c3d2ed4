/* SPDX-License-Identifier: MIT
 *
 * Everything a run finds out, for the writers to put into files.
 */
#ifndef GLSSAO_BENCH_RESULTS_H
#define GLSSAO_BENCH_RESULTS_H

#include "configs.h"
#include "measure.h"
#include "options.h"
#include "views.h"

/* Milliseconds; negative: not measured. */
typedef struct timing {
    double median_ms, p95_ms;          /* of glssao_compute: GPU time, or wall clock on a software rasteriser */
    double cpu_ms;                     /* median of the process's own, all threads */
    double pass_ms[GLSSAO_PASS_COUNT]; /* medians by timer queries; not on a software rasteriser */
} timing;

typedef struct view_result {
    error_measure as_is;
    double rmse_fit;               /* with the configuration's exponent over all views */
    double own_exponent, own_rmse; /* that fit this view alone */
    timing time;
} view_result;

typedef struct config_result {
    bench_config config;
    error_measure as_is; /* over all views, each with the same weight */
    double exponent;     /* fits best over all views, applied to the result with power 1 */
    double rmse_fit, mean_fit;
    double smooth_fit, edge_fit; /* RMSE with it, away from edges and near them */
    timing time;
    view_result *views;
} config_result;

enum { THICKNESS_COUNT = 8 };

typedef enum split_step { /* each on top of the ones before */
                          STEP_LAYER = 0,
                          STEP_ESTIMATOR,
                          STEP_HALF,
                          STEP_NOISE,
                          STEP_DENOISE,
                          STEP_CONTRAST,
                          STEP_COUNT
} split_step;

typedef struct split_result {
    const config_result *of;  /* the technique's default level */
    double exponent;          /* applied up to STEP_DENOISE */
    double alone[STEP_COUNT]; /* RMSE against the step before; against the truth for the first */
    double total[STEP_COUNT]; /* RMSE against the truth; negative: the technique has no such step */
    double (*view_total)[STEP_COUNT];
} split_result;

typedef struct oracle_result {
    double thickness[THICKNESS_COUNT]; /* of the radius */
    double rmse[THICKNESS_COUNT];      /* over all views */
    double (*view_rmse)[THICKNESS_COUNT];
    int best;        /* of thickness, over all views */
    double rmse_own; /* each view with its own best */
} oracle_result;

/* The default level of each technique, and the others of horizon. */
enum { BENCH_SPLITS = BENCH_TECHNIQUES + GLSSAO_ULTRA };

typedef struct results {
    const options *options;
    const char *context;
    bool software;
    char cpu[128];
    int cores;
    bench_view *views;
    int view_count;
    config_result *configs;
    int config_count;
    const char *time_scene; /* NULL: no times */
    bool split;
    oracle_result oracle;
    split_result splits[BENCH_SPLITS];
    int split_count;
    double seconds; /* the whole run */
} results;

/* The configuration with that id; NULL where it was not measured. */
const config_result *results_find(const results *r, const char *id);
/* NULL where it was not measured. */
const config_result *results_level(const results *r, glssao_technique technique, glssao_quality level);
/* The default level of a technique. */
const config_result *results_default(const results *r, glssao_technique technique);

/* What the chart and the ranking go by: as it is, or with the best exponent for the contrast techniques. */
double results_rmse(const config_result *c);

/* The time beside that of classic-high in the same run, on a software rasteriser the processor's, which a busy machine
 * changes least; negative: not known. */
double results_ratio(const results *r, const config_result *c);

/* True where no other configuration is both faster and nearer to the truth. */
bool results_on_front(const results *r, const config_result *c);

#endif
