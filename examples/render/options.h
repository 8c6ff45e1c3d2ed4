/* SPDX-License-Identifier: MIT
 *
 * The command line of glssao-render, parsed and checked: after options_parse every value is in its range.
 */
#pragma once

#include "context.h"
#include "fault.h"
#include "option.h"
#include "scene.h"

#include <glssao/glssao.h>

typedef struct options {
    const char *scene_path;            /* NULL: a built-in scene */
    const char *scene_name;            /* the built-in scene; NULL if a file is given */
    scene_load_options file;           /* how to load the file; its time and memory are set by: */
    int memory_mib;                    /* 0: half of the machine's memory */
    const char *depth_in, *normals_in; /* a depth map instead of a scene, and its normals; NULL: none */
    int depth_kind;                    /* options_depth */
    option_number depth_scale, ortho_height, heightmap;
    option_matrix projection;                          /* of the depth map, in columns */
    const char *set;                                   /* text of --set, see setting_table.h; NULL: nothing */
    const char *output, *ao, *normals, *depth, *stats; /* NULL: not written */
    int width, height;
    int quality, technique, context, path; /* glssao_quality, glssao_technique, context_kind, glssao_path */
    option_number radius, power, intensity, fov_deg, near_plane, far_plane, error, budget_ms, time_s;
    option_number thickness;
    option_pair fade_far;
    option_vector eye, target, up, sky_up;
    int sample_count; /* 0: the default of the quality */
    bool adaptive_rays;
    int rays;          /* a traced pixel; 0: the default of the quality with -t rays, none with another technique */
    int blur_rounds;   /* -1: the default of the quality */
    int history;       /* -1: not given */
    int margin;        /* pixels on each side */
    int layers;        /* 1 or 2; 0: not given */
    int camera;        /* of the file, counted from 1; 0: not given; -1: none */
    const char *view;  /* direction to see the scene from; NULL: not given */
    int frames, bench; /* 0: not given */
    option_number fps; /* given: the frames show an animation */
    uint32_t seed;
    bool no_shadows, mapped_normals, specular_occlusion, multi_bounce, bent_normals;
    int shadow_size; /* texels; 0: not given */
    int debug_map;   /* options_map; OPTIONS_MAP_NONE: not given */
    bool radius_in_pixels;
    bool orthographic, plan, no_ao, help, version;
    const char *background;       /* text of --background; NULL: the sky */
    int samples_per_pixel;        /* 0: the default for the context */
    const char *environment;      /* picture that lights the scene; NULL: the built-in light */
    const char *program_cache;    /* folder for linked programs; NULL: none */
    const char *batch;            /* list file, "-": standard input; NULL: one picture or turntable */
    int shard_index, shard_count; /* of a batch; count 0: not given */
    option_number timeout_s;      /* limit for one job */
    bool isolate;                 /* batch: each job in a process of its own */
    int cache_mib;                /* memory for scenes that later jobs may need */
} options;

#define OPTIONS_DEPTH_WORDS "distance|window|window-0-1"
/* What the values of a depth map are: view distance, or what a depth buffer stores under clip space of -1 to 1 or of 0
 * to 1. */
typedef enum options_depth { OPTIONS_DEPTH_DISTANCE, OPTIONS_DEPTH_WINDOW, OPTIONS_DEPTH_WINDOW_0_1 } options_depth;

/* Where options come from. Each place accepts different ones. */
typedef enum options_program { OPTIONS_RENDER, OPTIONS_JOB, OPTIONS_VIEWER } options_program;

/* A value of options.technique after those of glssao_technique. */
enum { OPTIONS_RAYTRACE = GLSSAO_RAYS + 1 };

enum { OPTIONS_ADAPTIVE_RAYS = 16 }; /* options.rays is at most that with adaptive_rays */

#define OPTIONS_MAP_WORDS "none|ao|normals|depth|random|shadow|tiles|bent"
/* Values of options.debug_map. The shadow map exists only if the scene has one. */
typedef enum options_map {
    OPTIONS_MAP_NONE = 0,
    OPTIONS_MAP_AO,
    OPTIONS_MAP_NORMALS,
    OPTIONS_MAP_DEPTH,
    OPTIONS_MAP_RANDOM,
    OPTIONS_MAP_SHADOW,
    OPTIONS_MAP_TILES,
    OPTIONS_MAP_BENT
} options_map;

/* Parses --background. False for the sky (also for NULL); otherwise true, with a linear colour and its alpha, which is
 * 0 for "none". */
bool options_parse_background(const char *text, float out_rgba[4]);

typedef enum options_result { OPTIONS_RUN, OPTIONS_DONE, OPTIONS_WRONG } options_result;

/* OPTIONS_DONE: help or version was printed to stdout. OPTIONS_WRONG: one line in `why` names the option and the value.
 * The strings live as long as argv. */
options_result options_parse(int argc, char **argv, options *out, failure *why);

/* Parses a line of a batch, from argv[1] on. Options that the line does not set come from `defaults`, the command line;
 * a scene on the line replaces theirs. False, with one line in `why`, if the line is wrong. */
bool options_parse_job(const options *defaults, int argc, char **argv, options *out, failure *why);

/* The same for glssao-view, which needs no output and refuses options that only concern files. */
options_result options_parse_for_viewer(int argc, char **argv, options *out, failure *why);
