/* SPDX-License-Identifier: MIT
 *
 * The command line of glssao-bench, parsed and checked.
 */
#pragma once

#include "fault.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct options {
    const char *scenes;      /* folder of glTF scenes; NULL: the built-in ones alone */
    const char *pick, *only; /* words separated by commas; NULL: all */
    const char *cache, *out, *time_scene;
    const char *peers;         /* node_modules; NULL: no peers */
    int size[2], time_size[2]; /* pixels */
    int rays, frames;
    int most_rays;       /* of ray tracing as a peer; 0: not measured */
    int sequence_frames; /* 0: no frame change */
    int rounds, fold;    /* glssao-tune's */
    int oracle_step, oracle_rays, split_seeds;
    int context, path; /* context_kind, glssao_path */
    uint32_t seed;
    bool peer_grid, all_views, time_all, record, bent, quick, check, help;
    bool flat;          /* truths about the surfaces' own normals are wanted, too */
    char command[1024]; /* as typed, without the program's folder */
} options;

typedef enum options_result { OPTIONS_RUN, OPTIONS_DONE, OPTIONS_WRONG } options_result;

/* OPTIONS_DONE: help was printed to stdout. OPTIONS_WRONG: one line in `error` names the option and the value. The
 * strings live as long as argv. */
options_result options_parse(int argc, char **argv, options *out, failure *fault);

/* True where one of the comma-separated words occurs in `text`, or `words` is NULL. */
bool options_match(const char *words, const char *text);
