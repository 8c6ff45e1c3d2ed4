/* SPDX-License-Identifier: MIT
 *
 * The command line of glssao-render, parsed and checked: after options_parse every value is in its range.
 */
#ifndef GLSSAO_EXAMPLES_OPTIONS_H
#define GLSSAO_EXAMPLES_OPTIONS_H

#include "context.h"
#include "fault.h"
#include "option.h"
#include "scene.h"

#include <glssao/glssao.h>

typedef struct options {
    const char *scene_path;                            /* NULL: the built-in scene */
    const char *scene_name;                            /* of the built-in scene; NULL where a file is given */
    scene_load_options file;                           /* how to load a file; but for its time and memory: */
    int memory_mib;                                    /* 0: half of the machine's */
    const char *set;                                   /* setting_table.h; NULL: nothing */
    const char *output, *ao, *normals, *depth, *stats; /* NULL: not wanted */
    int width, height;
    int quality, technique, context, path; /* glssao_quality, glssao_technique, context_kind, glssao_path */
    option_number radius, power, fov_deg, near_plane, far_plane, error, budget_ms, time_s;
    option_vector eye, target, up;
    int sample_count;  /* 0: the quality's own */
    int blur_rounds;   /* -1: the quality's own */
    int margin;        /* pixels on each side */
    int layers;        /* 1 or 2; 0: not given */
    int camera;        /* the file's N-th, counted from 1; 0: not given; -1: none of the file's */
    const char *view;  /* direction to see the scene from; NULL: not given */
    int frames, bench; /* 0: not given */
    uint32_t seed;
    bool no_shadows, mapped_normals, specular_occlusion, multi_bounce;
    int shadow_size; /* texels; 0: not given */
    int debug_map;   /* options_map; OPTIONS_MAP_NONE: not given */
    bool orthographic, plan, no_ao, help, version;
    const char *background;       /* NULL: the sky */
    int samples_per_pixel;        /* 0: the default */
    const char *environment;      /* picture of the surroundings; NULL: the built-in light */
    const char *program_cache;    /* folder of linked programs; NULL: none */
    const char *batch;            /* list file, "-": standard input; NULL: one picture, or turntable */
    int shard_index, shard_count; /* of the batch; count 0: not given */
    option_number timeout_s;      /* of a job */
    bool isolate;                 /* each job of the batch in a process of its own */
    int cache_mib;                /* bound on scenes kept for later jobs */
} options;

/* Who takes options; what each takes differs. */
typedef enum options_program { OPTIONS_RENDER, OPTIONS_JOB, OPTIONS_VIEWER } options_program;

/* Of options.technique, behind the library's own. */
enum { OPTIONS_RAYTRACE = GLSSAO_HORIZON + 1 };

#define OPTIONS_MAP_WORDS "none|ao|normals|depth|random|shadow|tiles"
/* Of options.debug_map; the shadow map only where one is drawn. */
typedef enum options_map {
    OPTIONS_MAP_NONE = 0,
    OPTIONS_MAP_AO,
    OPTIONS_MAP_NORMALS,
    OPTIONS_MAP_DEPTH,
    OPTIONS_MAP_RANDOM,
    OPTIONS_MAP_SHADOW,
    OPTIONS_MAP_TILES
} options_map;

/* What --background says: false for the sky (NULL, too), true with a linear colour and alpha, 0 for none. */
bool options_parse_background(const char *text, float out_rgba[4]);

typedef enum options_result { OPTIONS_RUN, OPTIONS_DONE, OPTIONS_WRONG } options_result;

/* OPTIONS_DONE: help or version was asked for and printed to stdout. OPTIONS_WRONG: one line in `why` names the
 * option and the value. The strings live as long as argv. */
options_result options_parse(int argc, char **argv, options *out, fault *why);

/* One line of a batch, argv[0] left out, over `defaults`, the command line's: a scene on the line takes the place of
 * theirs. False, with one line in `why`. */
bool options_parse_job(const options *defaults, int argc, char **argv, options *out, fault *why);

/* The same command line for glssao-view, which needs no output and takes none of the options that are about files. */
options_result options_parse_for_viewer(int argc, char **argv, options *out, fault *why);

#endif
