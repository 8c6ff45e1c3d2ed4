/* SPDX-License-Identifier: MIT
 *
 * One table holds every option; the help is printed from it.
 */
#include "options.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum option_kind { KIND_FLAG, KIND_INT, KIND_SEED, KIND_SIZE, KIND_WORD, KIND_TEXT } option_kind;

typedef struct option {
    const char *name, *value, *help; /* value: how the help calls it; of KIND_WORD: the words */
    option_kind kind;
    size_t offset; /* into struct options */
    int min, max;
} option;

#define AT(member) offsetof(options, member)
static const option table[] = {
    {"scenes", "DIR", "folder of glTF scenes, measured beside the built-in ones", KIND_TEXT, AT(scenes), 0, 0},
    {"pick", "NAME,...", "only scenes whose name holds one of these", KIND_TEXT, AT(pick), 0, 0},
    {"only", "ID,...", "only configurations whose id holds one of these", KIND_TEXT, AT(only), 0, 0},
    {"all-views", NULL, "every view of every scene, not the first of the main ones", KIND_FLAG, AT(all_views), 0, 0},
    {"peer-grid", NULL, "peers with many settings, to find their best; with --only PEER", KIND_FLAG, AT(peer_grid), 0,
     0},
    {"size", "WxH", "size at which errors are measured (960x540)", KIND_SIZE, AT(size), 16, 8192},
    {"rays", "N", "rays a pixel of the truth (512)", KIND_INT, AT(rays), 1, 1 << 20},
    {"cache", "DIR", "where traced truths are kept (out/bench-cache)", KIND_TEXT, AT(cache), 0, 0},
    {"time-size", "WxH", "size at which times are taken (1920x1080)", KIND_SIZE, AT(time_size), 16, 8192},
    {"frames", "N", "timed frames of each configuration, 0: no times (15)", KIND_INT, AT(frames), 0, 10000},
    {"time-scene", "NAME", "the scene times are taken on (steps)", KIND_TEXT, AT(time_scene), 0, 0},
    {"time-all", NULL, "times on every scene", KIND_FLAG, AT(time_all), 0, 0},
    {"most-rays", "N", "ray tracing as a peer with 1, 2, 4 to N rays a pixel, 0: none (512)", KIND_INT, AT(most_rays),
     0, 1 << 16},
    {"sequence-frames", "N", "frames of a moving camera for frame and roll change, 0: none (6)", KIND_INT,
     AT(sequence_frames), 0, 1000},
    {"oracle-step", "N", "the error is split on one pixel of every N x N (4)", KIND_INT, AT(oracle_step), 1, 64},
    {"oracle-rays", "N", "rays a pixel through the depth map (256)", KIND_INT, AT(oracle_rays), 1, 65536},
    {"split-seeds", "N", "seeds whose mean stands for convergence, 0: no split (64)", KIND_INT, AT(split_seeds), 0,
     4096},
    {"out", "DIR", "where tables and pictures are written (out/bench)", KIND_TEXT, AT(out), 0, 0},
    {"peers", "NODE_MODULES", "also the effects of the npm packages there (docs/comparison.md)", KIND_TEXT, AT(peers),
     0, 0},
    {"quick", NULL, "built-in scenes, small and rough: under 3 minutes on 2 cores", KIND_FLAG, AT(quick), 0, 0},
    {"check", NULL, "also fails where figures are not finite or not in the right order", KIND_FLAG, AT(check), 0, 0},
    {"context", "auto|egl|osmesa", "how to get OpenGL (auto)", KIND_WORD, AT(context), 0, 0},
    {"path", "auto|fragment|compute", "fragment or compute shaders, where both will do (auto)", KIND_WORD, AT(path), 0,
     0},
    {"fold", "N", "glssao-tune: searches on even scenes (0), on odd ones (1), or on all (2)", KIND_INT, AT(fold), 0, 2},
    {"rounds", "N", "glssao-tune: passes over its constants (12)", KIND_INT, AT(rounds), 0, 1000},
    {"seed", "N", "of every random input (0)", KIND_SEED, AT(seed), 0, 0},
    {"help", NULL, "prints this", KIND_FLAG, AT(help), 0, 0},
};
enum { TABLE_LENGTH = sizeof table / sizeof table[0] };

static void print_help(void)
{
    puts("usage: glssao-bench [options]\n"
         "Measures every technique and setting of glssao: milliseconds a frame, and error against ray-traced truth.\n");
    for (int i = 0; i < TABLE_LENGTH; i++) {
        char left[64];
        snprintf(left, sizeof left, "--%s %s", table[i].name, table[i].value ? table[i].value : "");
        printf("  %-26s %s\n", left, table[i].help);
    }
    puts("\nExit code: 0 done, 1 could not measure or --check found a fault, 2 wrong usage.");
}

static bool parse_whole(const char *text, long long min, long long max, long long *out)
{
    if (text[0] == '\0' || text[strspn(text, "0123456789")] != '\0')
        return false;
    errno = 0;
    *out = strtoll(text, NULL, 10);
    return errno == 0 && *out >= min && *out <= max;
}

static bool parse_size(const char *text, int min, int max, int out[2])
{
    char width[8];
    const char *x = strchr(text, 'x');
    long long w, h;
    if (!x || (size_t)(x - text) >= sizeof width)
        return false;
    memcpy(width, text, (size_t)(x - text));
    width[x - text] = '\0';
    if (!parse_whole(width, min, max, &w) || !parse_whole(x + 1, min, max, &h))
        return false;
    out[0] = (int)w;
    out[1] = (int)h;
    return true;
}

static bool parse_word(const char *words, const char *text, int *out)
{
    for (int i = 0; *words; i++) {
        const size_t length = strcspn(words, "|");
        if (strlen(text) == length && memcmp(words, text, length) == 0) {
            *out = i;
            return true;
        }
        words += length + (words[length] == '|');
    }
    return false;
}

static bool take(const option *o, const char *text, options *out)
{
    void *target = (char *)out + o->offset;
    long long whole;
    switch (o->kind) {
    case KIND_FLAG:
        *(bool *)target = true;
        return true;
    case KIND_INT:
        if (!parse_whole(text, o->min, o->max, &whole))
            return false;
        *(int *)target = (int)whole;
        return true;
    case KIND_SEED:
        if (!parse_whole(text, 0, UINT32_MAX, &whole))
            return false;
        *(uint32_t *)target = (uint32_t)whole;
        return true;
    case KIND_SIZE:
        return parse_size(text, o->min, o->max, target);
    case KIND_WORD:
        return parse_word(o->value, text, target);
    case KIND_TEXT:
        *(const char **)target = text;
        return text[0] != '\0';
    }
    return false;
}

static const option *find(const char *argument)
{
    for (int i = 0; i < TABLE_LENGTH; i++)
        if (strncmp(argument, "--", 2) == 0 && strcmp(argument + 2, table[i].name) == 0)
            return &table[i];
    return NULL;
}

/* The whole chain from tracing to the tables, small enough for CI. */
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

/* Folders of this machine are called what the help calls them. */
static void keep_command(int argc, char **argv, options *out)
{
    const char *slash = strrchr(argv[0], '/');
    size_t length = (size_t)snprintf(out->command, sizeof out->command, "%s", slash ? slash + 1 : argv[0]);
    for (int i = 1; i < argc && length < sizeof out->command; i++) {
        const option *before = find(argv[i - 1]);
        const bool folder = before && before->kind == KIND_TEXT &&
                            (strcmp(before->value, "DIR") == 0 || strcmp(before->value, "NODE_MODULES") == 0);
        length += (size_t)snprintf(out->command + length, sizeof out->command - length, " %s",
                                   folder ? before->value : argv[i]);
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
    for (int i = 1; i < argc; i++) {
        const option *o = find(argv[i]);
        if (!o) {
            snprintf(error, error_size, "%s: there is no such option; --help lists them", argv[i]);
            return OPTIONS_WRONG;
        }
        if (o->kind != KIND_FLAG && i + 1 == argc) {
            snprintf(error, error_size, "%s: it needs %s", argv[i], o->value);
            return OPTIONS_WRONG;
        }
        const char *value = o->kind == KIND_FLAG ? "" : argv[++i];
        if (!take(o, value, out)) {
            snprintf(error, error_size, "--%s %s: want %s", o->name, value, o->value);
            if (o->kind == KIND_INT || o->kind == KIND_SIZE)
                snprintf(error, error_size, "--%s %s: want %s, %d to %d", o->name, value, o->value, o->min, o->max);
            return OPTIONS_WRONG;
        }
    }
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
        char word[128];
        const size_t length = strcspn(words, ",");
        if (length > 0 && length < sizeof word) {
            memcpy(word, words, length);
            word[length] = '\0';
            if (strstr(text, word))
                return true;
        }
        words += length + (words[length] == ',');
    }
    return false;
}
