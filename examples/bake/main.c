/* SPDX-License-Identifier: MIT
 *
 * glssao-bake: ambient accessibility into vertex colours, by ray casting.
 */
#include "bake.h"
#include "inputs.h"
#include "stop.h"
#include "streams.h"

#include <stdio.h>

enum { EXIT_DONE = 0, EXIT_NOT_BAKED = 1, EXIT_USAGE = 2, ERROR_LENGTH = 8192 };

static void print_summary(const bake_model *m, const bake_stats *stats)
{
    size_t vertices = 0, triangles = 0;
    for (size_t i = 0; i < m->part_count; i++) {
        vertices += m->parts[i].vertex_count;
        triangles += m->parts[i].index_count / 3;
    }
    printf("%zu vertices of %zu triangles: %.0f rays in %.2f s, %.2f million a second\n", vertices, triangles,
           (double)stats->rays, stats->seconds, stats->seconds > 0 ? (double)stats->rays / stats->seconds * 1e-6 : 0.0);
}

int main(int argc, char **argv)
{
    static char error[ERROR_LENGTH];
    bake_options options;
    streams_guard("glssao-bake", EXIT_NOT_BAKED);
    switch (bake_parse_options(argc, argv, &options, FAULT(error))) {
    case BAKE_DONE:
        return EXIT_DONE;
    case BAKE_WRONG:
        fprintf(stderr, "glssao-bake: %s\n", error);
        return EXIT_USAGE;
    case BAKE_RUN:
        break;
    }
    stop_at_once();
    failure fault = {.file = options.input, .text = error, .size = sizeof error};
    bake_model model;
    bake_stats stats;
    inputs read = {0};
    inputs_record(&read);
    const bool opened = bake_model_open(&model, &options, &fault);
    inputs_record(NULL);
    if (options.in_place)
        inputs_forget(&read, options.input);
    const bool done = opened && inputs_spare(&read, NULL, options.output, FAULT(error)) &&
                      bake_cast(&model, &options, &stats, &fault) && bake_write(&model, &options, &fault);
    if (done) {
        print_summary(&model, &stats);
    } else {
        fprintf(stderr, "glssao-bake: %s\n", error);
    }
    bake_model_close(&model);
    inputs_free(&read);
    return done ? EXIT_DONE : EXIT_NOT_BAKED;
}
