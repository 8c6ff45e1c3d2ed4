/* SPDX-License-Identifier: MIT
 *
 * One table holds every option; the help is printed from it.
 */
#include "options.h"

#include "option_rows.h"
#include "words.h"

#include <stdio.h>
#include <string.h>

#define AT(member) offsetof(options, member)
static const option table[] = {
    TEXT("scenes", "DIR", 0, scenes, "folder of glTF scenes, measured beside the built-in ones"),
    TEXT("pick", "NAME,...", 0, pick, "only scenes whose name holds one of these"),
    TEXT("only", "ID,...", 0, only, "only configurations whose id holds one of these"),
    FLAG(0, "all-views", 0, all_views, "every view of every scene, not the first of the main ones"),
    FLAG(0, "peer-grid", 0, peer_grid, "peers with many settings, to find their best; with --only PEER"),
    RANGE(SIZE, "size", "WxH", 0, size, 16, 8192, "size at which errors are measured (960x540)"),
    RANGE(INT, "rays", "N", 0, rays, 1, 1048576, "rays a pixel of the truth (512)"),
    TEXT("cache", "DIR", 0, cache, "where traced truths are kept (out/bench-cache)"),
    RANGE(SIZE, "time-size", "WxH", 0, time_size, 16, 8192, "size at which times are taken (1920x1080)"),
    RANGE(INT, "frames", "N", 0, frames, 0, 10000, "timed frames of each configuration, 0: no times (15)"),
    TEXT("time-scene", "NAME", 0, time_scene, "the scene times are taken on (steps)"),
    FLAG(0, "time-all", 0, time_all, "times on every scene"),
    RANGE(INT, "most-rays", "N", 0, most_rays, 0, 65536,
          "ray tracing as a peer with 1, 2, 4 to N rays a pixel, 0: none (512)"),
    RANGE(INT, "sequence-frames", "N", 0, sequence_frames, 0, 1000,
          "frames of a moving camera for frame and roll change, 0: none (6)"),
    RANGE(INT, "oracle-step", "N", 0, oracle_step, 1, 64, "the error is split on one pixel of every N x N (4)"),
    RANGE(INT, "oracle-rays", "N", 0, oracle_rays, 1, 65536, "rays a pixel through the depth map (256)"),
    RANGE(INT, "split-seeds", "N", 0, split_seeds, 0, 4096,
          "seeds whose mean stands for convergence, 0: no split (64)"),
    TEXT("out", "DIR", 0, out, "where tables and pictures are written (out/bench)"),
    TEXT("peers", "NODE_MODULES", 0, peers, "also the effects of the npm packages there (docs/comparison.md)"),
    FLAG(0, "record", 0, record, "only records what the peers draw, for machines without node, and measures nothing"),
    FLAG(0, "bent", 0, bent, "bent normals of every level of horizon, and nothing else"),
    FLAG(0, "quick", 0, quick, "built-in scenes, small and rough: under 3 minutes on 2 cores"),
    FLAG(0, "check", 0, check, "also fails where figures are not finite or not in the right order"),
    WORD("context", CONTEXT_WORDS, 0, context, CONTEXT_WORDS, "how to get OpenGL (auto)"),
    WORD("path", PATH_WORDS, 0, path, PATH_WORDS, "fragment or compute shaders, where both will do (auto)"),
    RANGE(INT, "fold", "N", 0, fold, 0, 2, "glssao-tune: searches on even scenes (0), on odd ones (1), or on all (2)"),
    RANGE(INT, "rounds", "N", 0, rounds, 0, 1000, "glssao-tune: passes over its constants (12)"),
    RANGE(SEED, "seed", "N", 0, seed, 0, 4294967295.0, "of every random input (0)"),
    FLAG(0, "help", 0, help, "prints this"),
};
static const option_set set = {table, sizeof table / sizeof table[0], NULL, NULL, 0};

static void print_help(void)
{
    puts("usage: glssao-bench [options]\n"
         "Measures every technique and setting of glssao: milliseconds a frame, and error against ray-traced truth.\n");
    option_print(&set);
    puts("\nExit code: 0 done, 1 could not measure or --check found a fault, 2 wrong usage.");
}

/* Small enough for every build of a project, and still the whole chain from tracing to the chart. */
static void set_quick(options *o)
{
    o->size[0] = 320;
    o->size[1] = 180;
    o->time_size[0] = 640;
    o->time_size[1] = 360;
    o->rays = 64;
    o->frames = 3;
    o->oracle_rays = 64;
    o->split_seeds = 8;
    o->most_rays = 16;
    o->sequence_frames = 3;
}

/* How the help calls the folder that such an option takes; NULL for other arguments. */
static const char *folder_of(const char *argument)
{
    for (int i = 0; i < set.count; i++)
        if (strncmp(argument, "--", 2) == 0 && strcmp(argument + 2, table[i].name) == 0 && table[i].value &&
            (strcmp(table[i].value, "DIR") == 0 || strcmp(table[i].value, "NODE_MODULES") == 0))
            return table[i].value;
    return NULL;
}

/* The command line without the names of this machine's folders. */
static void keep_command(int argc, char **argv, options *out)
{
    const char *slash = strrchr(argv[0], '/');
    size_t length = (size_t)snprintf(out->command, sizeof out->command, "%s", slash ? slash + 1 : argv[0]);
    for (int i = 1; i < argc && length < sizeof out->command; i++) {
        const char *folder = folder_of(argv[i - 1]);
        length +=
            (size_t)snprintf(out->command + length, sizeof out->command - length, " %s", folder ? folder : argv[i]);
    }
}

options_result options_parse(int argc, char **argv, options *out, failure *fault)
{
    *out = (options){.cache = "out/bench-cache",
                     .out = "out/bench",
                     .time_scene = "steps",
                     .size = {960, 540},
                     .time_size = {1920, 1080},
                     .rays = 512,
                     .rounds = 12,
                     .frames = 15,
                     .most_rays = 512,
                     .sequence_frames = 6,
                     .oracle_step = 4,
                     .oracle_rays = 256,
                     .split_seeds = 64};
    for (int i = 1; i < argc; i++) /* first, so that the others can change what it sets */
        if (strcmp(argv[i], "--quick") == 0)
            set_quick(out);
    if (!option_parse(&set, argc, argv, out, fault))
        return OPTIONS_WRONG;
    if (out->record && !out->peers) {
        fault_set(fault, "--record: there is nothing to record without --peers");
        return OPTIONS_WRONG;
    }
    out->rays = out->record ? 1 : out->rays; /* nothing is compared with the truth */
    keep_command(argc, argv, out);
    if (out->help)
        print_help();
    return out->help ? OPTIONS_DONE : OPTIONS_RUN;
}

bool options_match(const char *words, const char *text)
{
    if (!words)
        return true;
    while (*words) {
        char one[128];
        const size_t length = strcspn(words, ",");
        if (length > 0 && length < sizeof one) {
            memcpy(one, words, length);
            one[length] = '\0';
            if (strstr(text, one))
                return true;
        }
        words += length + (words[length] == ',');
    }
    return false;
}
