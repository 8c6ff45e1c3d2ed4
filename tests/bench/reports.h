/* SPDX-License-Identifier: MIT
 *
 * What a run leaves in files. Each returns false, with one line in `error`, where a file can't be written.
 */
#ifndef GLSSAO_BENCH_REPORTS_H
#define GLSSAO_BENCH_REPORTS_H

#include "effects.h"
#include "results.h"

/* Everything, for programs. */
bool report_json(const results *r, const char *path, char *error, size_t error_size);
/* One line a scene and configuration, and one a configuration over all (scene "all"). */
bool report_tsv(const results *r, const char *path, char *error, size_t error_size);

/* Writes the gnuplot script and has gnuplot draw the PNG. Without gnuplot, or without times, only says so on stderr:
 * *out_drawn tells. */
bool report_chart(const results *r, const char *script, const char *picture, bool *out_drawn, char *error,
                  size_t error_size);

/* strip-SCENE-TECHNIQUE.png in the folder, for the default level of every technique: the truth, the result, and the
 * signed error; below, for the contrast techniques, the last two again with the best exponent. */
bool report_strips(const results *r, effects *e, map_reader *m, const char *folder, char *error, size_t error_size);

/* worst-horizon.png in the folder: of each scene, in order down the left half and then the right, the place where the
 * level `high` of horizon is worst: truth, result, error, in full size. Nothing where the pictures are smaller than a
 * place. */
bool report_worst_places(const results *r, effects *e, map_reader *m, const char *folder, char *error,
                         size_t error_size);

/* The report for people. Copies the chart, and one strip a technique, from the output folder to pictures/ beside it. */
bool report_document(const results *r, const char *path, bool has_chart, char *error, size_t error_size);

/* The built-in scene on which this technique's default level is worst, for a picture; NULL: none was measured. */
const char *report_worst_built_in(const results *r, const config_result *c);

#endif
