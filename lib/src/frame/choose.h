/* SPDX-License-Identifier: MIT
 *
 * The decisions of a frame: which passes run and why, by draws or dispatches, at which sizes, from which inputs.
 */
#ifndef GLSSAO_FRAME_CHOOSE_H
#define GLSSAO_FRAME_CHOOSE_H

#include "frame/steps.h"

enum {
    ROUNDS_OF_A_DISPATCH = 2, /* rounds of the planar blur that one dispatch runs, at most */
    CORRECTION_ROUNDS = 2 /* of the blur of the difference between rays and estimate at half size; one more at full */
};

/* All that the steps follow from. */
typedef struct glssao__choice {
    glssao_plan plan; /* run, reason and compute of each pass; its counts and sizes come from the steps */
    bool nothing;     /* no pass runs: the result is 1 everywhere */
    bool compute;     /* passes that can be dispatched are */
    bool accumulates;
    bool is_horizon, is_planar;
    bool bent;       /* bent normals come along */
    bool is_rays;    /* the estimate is the host's rays */
    bool corrects;   /* the host's rays correct another estimate */
    bool is_oblique; /* window depth becomes view distance in a copy */
    bool blurs, upsamples, has_tiles;
    bool sorts_again;  /* tiles are sorted anew for the correction */
    bool has_history;  /* the result is the mean of this frame and earlier ones */
    bool paired;       /* later passes read paired values */
    bool result_apart; /* the result goes to a map of its own */
    int size[2], estimate[2];
    bool is_dense; /* distances and rebuilt normals have the full size, though the estimate has half of it */
    int factor;    /* full-size pixels to one of the estimate: 1 or 2 */
    int margin, estimate_margin;
    int rays_rounds;                 /* of the blur of values from rays */
    int blur_rounds;                 /* of the estimate's blur */
    int inner_rounds;                /* rounds of the blur within the dispatch that upsamples */
    int reach;                       /* texels of the estimate beyond a pixel that later passes read */
    int tile_rings;                  /* the same in tiles, rounded up; of the estimate that is corrected */
    int rays_rings;                  /* the same of the correction */
    gl_uint host_names[HOST_MAPS];   /* as in glssao__schedule */
    bool copies[HOST_MAPS];          /* which of the host's textures are copied, in the order of HOST_DEPTH and so on */
    enum glssao__map depth, normals; /* where the passes after the copying read them */
    glssao__variant inputs;          /* how these are stored, and what all variants have in common */
} glssao__choice;

void glssao__choose(glssao__choice *out, const glssao__request *request);

/* Pixels between the neighbours that a round of the blur of values from rays reads, as a power of 2. */
int glssao__rays_stride(int round);

/* A plan in which every pass is skipped, for that reason. */
void glssao__choose_nothing(glssao_plan *out, const char *reason);

/* The size of the maps that an estimate draws into. */
void glssao__choose_estimate_size(const glssao_settings *settings, const int size[2], int out_size[2]);

/* Whether passes that can be dispatched are, in frames without tiles. */
bool glssao__choose_dispatches(const glssao__capabilities *can);

const char *glssao__pass_name(glssao_pass pass);

#endif
