/* SPDX-License-Identifier: MIT
 *
 * One table holds every option; the help is printed from it.
 */
#include "options.h"

#include "option.h"
#include "words.h"

#include <stdio.h>
#include <string.h>

#define AT(member) offsetof(options, member)
#define TEXT(name, value, help, member)                                                                                \
    {                                                                                                                  \
        0, name, value, help, OPTION_TEXT, AT(member), 0, 0, "", 0                                                     \
    }
#define WHOLE(name, help, member, min, max)                                                                            \
    {                                                                                                                  \
        0, name, "N", help, OPTION_INT, AT(member), min, max, "a whole number from " #min " to " #max, 0               \
    }
#define SIZE(name, help, member)                                                                                       \
    {                                                                                                                  \
        0, name, "WxH", help, OPTION_SIZE, AT(member), 16, 8192, "WxH with sides from 16 to 8192", 0                   \
    }
#define FLAG(name, help, member)                                                                                       \
    {                                                                                                                  \
        0, name, NULL, help, OPTION_FLAG, AT(member), 0, 0, NULL, 0                                                    \
    }
#define WORD(name, words, help, member)                                                                                \
    {                                                                                                                  \
        0, name, words, help, OPTION_WORD, AT(member), 0, 0, words, 0                                                  \
    }
static const option table[] = {
    TEXT("scenes", "DIR", "folder of glTF scenes, measured beside the built-in ones", scenes),
    TEXT("pick", "NAME,...", "only scenes whose name holds one of these", pick),
    TEXT("only", "ID,...", "only configurations whose id holds one of these", only),
    FLAG("all-views", "every view of every scene, not the first of the main ones", all_views),
    FLAG("peer-grid", "peers with many settings, to find their best; with --only PEER", peer_grid),
    SIZE("size", "size at which errors are measured (960x540)", size),
    WHOLE("rays", "rays a pixel of the truth (512)", rays, 1, 1048576),
    TEXT("cache", "DIR", "where traced truths are kept (out/bench-cache)", cache),
    SIZE("time-size", "size at which times are taken (1920x1080)", time_size),
    WHOLE("frames", "timed frames of each configuration, 0: no times (15)", frames, 0, 10000),
    TEXT("time-scene", "NAME", "the scene times are taken on (steps)", time_scene),
    FLAG("time-all", "times on every scene", time_all),
    WHOLE("most-rays", "ray tracing as a peer with 1, 2, 4 to N rays a pixel, 0: none (512)", most_rays, 0, 65536),
    WHOLE("sequence-frames", "frames of a moving camera for frame and roll change, 0: none (6)", sequence_frames, 0,
          1000),
    WHOLE("oracle-step", "the error is split on one pixel of every N x N (4)", oracle_step, 1, 64),
    WHOLE("oracle-rays", "rays a pixel through the depth map (256)", oracle_rays, 1, 65536),
    WHOLE("split-seeds", "seeds whose mean stands for convergence, 0: no split (64)", split_seeds, 0, 4096),
    TEXT("out", "DIR", "where tables and pictures are written (out/bench)", out),
    TEXT("peers", "NODE_MODULES", "also the effects of the npm packages there (docs/comparison.md)", peers),
    FLAG("record", "only records what the peers draw, for machines without node, and measures nothing", record),
    FLAG("bent", "bent normals of every level of horizon, and nothing else", bent),
    FLAG("quick", "built-in scenes, small and rough: under 3 minutes on 2 cores", quick),
    FLAG("check", "also fails where figures are not finite or not in the right order", check),
    WORD("context", CONTEXT_WORDS, "how to get OpenGL (auto)", context),
    WORD("path", PATH_WORDS, "fragment or compute shaders, where both will do (auto)", path),
    WHOLE("fold", "glssao-tune: searches on even scenes (0), on odd ones (1), or on all (2)", fold, 0, 2),
    WHOLE("rounds", "glssao-tune: passes over its constants (12)", rounds, 0, 1000),
    {0, "seed", "N", "of every random input (0)", OPTION_SEED, AT(seed), 0, 4294967295.0,
     "a whole number from 0 to 4294967295", 0},
    FLAG("help", "prints this", help),
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

options_result options_parse(int argc, char **argv, options *out, char *error, size_t error_size)
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
    if (!option_parse(&set, argc, argv, out, &(failure){.text = error, .size = error_size}))
        return OPTIONS_WRONG;
    if (out->record && !out->peers) {
        snprintf(error, error_size, "--record: there is nothing to record without --peers");
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
