/* SPDX-License-Identifier: MIT
 *
 * A frame is a list of steps: what a schedule is made of. Whoever needs programs, maps, the public plan or counts loops
 * over the steps.
 */
#ifndef GLSSAO_FRAME_STEPS_H
#define GLSSAO_FRAME_STEPS_H

#include "frame/shaders.h"
#include "gpu/textures.h"

#include "glssao/glssao.h"

/* Texture units that the passes read through; the shaders' samplers are tied to them once. */
enum glssao__unit {
    UNIT_NORMAL = 0,
    UNIT_DEPTH,
    UNIT_RANDOM_VECTOR,
    UNIT_AMBIENT,
    UNIT_DISTANCE,
    UNIT_BACK,
    UNIT_SECOND,
    UNIT_TILES,
    UNIT_COUNT,
    UNIT_RAYS = UNIT_RANDOM_VECTOR,   /* no pass reads both */
    UNIT_MOTION = UNIT_RANDOM_VECTOR, /* the history reads none of the maps that these hold otherwise */
    UNIT_RAW = UNIT_DISTANCE,
    UNIT_HISTORY = UNIT_BACK
};

/* Textures that steps read and draw into. */
enum glssao__map {
    MAP_NONE = 0,
    MAP_HOST_DEPTH, /* the host's, in the order of HOST_DEPTH and so on */
    MAP_HOST_NORMAL,
    MAP_HOST_BACK,
    MAP_HOST_SECOND,
    MAP_HOST_MOTION,
    MAP_HOST_RAYS,
    MAP_RANDOM_VECTOR,
    MAP_DEPTH_COPY, /* the effect's targets from here on */
    MAP_NORMAL_COPY,
    MAP_BACK_COPY,
    MAP_SECOND_COPY,
    MAP_MOTION_COPY,
    MAP_NORMAL,
    MAP_REBUILT,     /* normals from depth, at the estimate's size (normals.frag) */
    MAP_DISTANCE,    /* view distance; with layers also thickness and second layer (distance.frag) */
    MAP_TILE_ROWS,   /* bounds, as tile_rows.frag writes them */
    MAP_TILE_BOUNDS, /* of tiles; later rings for a correction */
    MAP_TILE_CLASS,  /* 1: needs an estimate (tile_class.frag), or holds occlusion (tile_values.frag) */
    MAP_TILE_RINGS,  /* as tile_near.frag, then as tile_rings.frag writes them */
    MAP_TILE_BLOCKS, /* as tile_blocks.frag writes them */
    MAP_TILE_RAYS,   /* the same for a correction */
    MAP_AMBIENT_0,   /* accessibility */
    MAP_AMBIENT_1,
    MAP_PAIRED_0, /* paired values (paired.glsl) */
    MAP_PAIRED_1,
    MAP_RAYS_0, /* differences between rays and estimate (rays.frag) */
    MAP_RAYS_1,
    MAP_BLOCKS,      /* blocks of four pixels (upsample.frag) */
    MAP_RESULT,      /* the result, where it has another size than the estimate */
    MAP_BENT,        /* bent normals and accessibility */
    MAP_BENT_BLOCKS, /* packed bent normals of such blocks (upsample.frag) */
    MAP_SUM,         /* sums of accumulated estimates, one channel for each of two replicates */
    MAP_OTHER_SUM,   /* with bent normals each replicate has a map of its own, which sums hidden vectors too */
    MAP_PROBE,       /* samples of their difference */
    MAP_RAW,         /* paired values of the estimate, which the history reads besides those that the blur left */
    MAP_HISTORY_0,   /* the history of the last frame and of this one, by turns (history.glsl) */
    MAP_HISTORY_1,
    MAP_COUNT,
    MAP_FIRST_TARGET = MAP_DEPTH_COPY
};

enum {
    HOST_MAPS = 6, /* MAP_HOST_DEPTH and so on */
    PROBE_SIZE = 128,
    TILE_SIDE = 16,  /* pixels of the estimate: a software rasteriser draws smaller tiles at a loss */
    MOST_RINGS = 16, /* the greatest distance in tiles that tile_rings.frag tells */
    SCHEDULE_STEPS = 64,
    STEP_READS = 6
};

typedef struct glssao__region { /* pixels of a map */
    int x, y, width, height;
} glssao__region;

enum glssao__step_kind { STEP_DRAW, STEP_DISPATCH, STEP_CLEAR_TO_OPEN, STEP_CLEAR_TO_ZERO };

/* What a step waits for. */
enum glssao__barrier {
    BARRIER_NONE,
    BARRIER_DISPATCH, /* image writes can be fetched, and texels be written again */
    BARRIER_ALL       /* they can also be drawn over, and read by whatever follows the frame */
};

/* Tiles that a draw covers: those that lie `least` to `most` tiles from one that needs an estimate. */
typedef struct glssao__tile_range {
    int side; /* of a tile in pixels of the target; 0: the draw covers the whole target */
    int least, most;
    bool grows; /* each point reaches as many tiles farther as its ring says */
} glssao__tile_range;

typedef struct glssao__step {
    glssao_pass pass;
    enum glssao__step_kind kind;
    enum glssao__shader shader;
    glssao__variant variant;
    struct {
        enum glssao__unit unit;
        enum glssao__map map;
        enum glssao__sampler sampler;
    } reads[STEP_READS];
    int read_count;
    enum glssao__map target;
    enum glssao__map second; /* target of the shader's second output; MAP_NONE: it has one output */
    glssao__region region;   /* of the target that is drawn */
    int origin[2];           /* where in the maps that are read the target's lower left corner lies, pixels */
    glssao__tile_range tiles;
    bool is_horizontal;           /* of the two directions of a blur */
    bool adds;                    /* to what the target holds */
    enum glssao__barrier barrier; /* before the step */
} glssao__step;

/* What of the context and of the config decides about a frame. */
typedef struct glssao__capabilities {
    bool compute;        /* compute shaders that write images */
    bool compute_failed; /* the driver rejected one */
    glssao_path path;    /* as the config asks */
    bool is_software;    /* the processor rasterises */
    int max_size;        /* of textures and viewports, pixels */
    float max_point_size;
} glssao__capabilities;

typedef struct glssao__request {
    const glssao_frame *frame;
    const glssao_settings *settings;
    int size[2];                                 /* full size of the effect, pixels */
    int estimates;                               /* of glssao_accumulate, with this one; 0: glssao_compute */
    bool is_orthographic, is_oblique, is_turned; /* the projection, as in glssao__projection */
    int frames;                                  /* that the history has seen so far; 0: it begins */
    glssao__capabilities can;
} glssao__request;

typedef struct glssao__schedule {
    glssao__step steps[SCHEDULE_STEPS];
    int count;
    enum glssao__barrier last_barrier;   /* after the last step */
    glssao__target_spec maps[MAP_COUNT]; /* those that must be there; format 0: not used */
    gl_uint host_names[HOST_MAPS]; /* of the textures that the frame reads, 0 for others, in the order of HOST_DEPTH and
                                      so on */
    int estimate_size[2];
    int map_factor;           /* full-size pixels to one of the distance map */
    enum glssao__map result;  /* holds the result afterwards */
    enum glssao__map other;   /* the other of the maps that the passes draw into by turns */
    glssao__region delivered; /* the part of the last pass's map that is the result */
    bool has_tiles;
    int tile_rings;       /* tiles around one that needs an estimate in which later passes may change something */
    bool may_use_compute; /* a dispatch was chosen by default, so draws may replace it */
    glssao_plan plan;     /* what glssao_plan_frame returns */
} glssao__schedule;

#endif
