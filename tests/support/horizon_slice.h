/* SPDX-License-Identifier: MIT
 *
 * Shared by the two halves of the horizon model: horizon_model.c makes the slice, horizon_slice.c finds what is hidden
 * in it.
 */
#pragma once

#include "horizon_model.h"
#include "rounded.h"

#include <stdint.h>

enum { MAX_STEPS = 16, MAX_CANDIDATES = 4, SECTORS = 31 };

static const double PI = 3.14159265358979323846;

typedef struct vector {
    rounded x, y, z;
} vector;

typedef struct point {
    const horizon_input *in;
    int x, y; /* of the estimate */
    bool orthographic;
    double distance;
    rounded radius; /* scene units */
    rounded y_step; /* of the depth format, in radii */
    vector up, normal;
    rounded px[2]; /* change of view xy per pixel; in perspective per unit of distance */
    rounded ray_length;
} point;

typedef struct slice {
    rounded step_px[2]; /* the radius along the slice, in pixels */
    rounded x_per_px[2], y_per_px[2];
    rounded cos_g, sin_g, projected;
    rounded run_width;          /* thickness of a run, in units of its width */
    rounded total, total_minus; /* measure of the whole slice, and of its minus side */
    vector along;               /* unit, view space */
    double jitter;
} slice;

/* A texel that a sample may snap to, in units of the radius: outward distance along the slice, height, and the width of
 * a step there. */
typedef struct candidate {
    rounded x, y, step;
    rounded thickness, behind; /* of the layers, if any; thickness not above 0: minus the least that it is */
    bool sky;
} candidate;

typedef struct side {
    candidate candidates[MAX_STEPS][MAX_CANDIDATES];
    int candidate_count[MAX_STEPS];
    bool minus;
    rounded lowest; /* cosine of the angle at which the hemisphere ends */
} side;

typedef struct hidden {
    uint32_t surely, possibly; /* sectors */
    interval highest;          /* cosine of the horizon above the occluders that cast a veil */
    bool started;
} hidden;

/* Bounds of the measure for a cosine between two. `sign` is -1 for the side that the normal leans away from. */
interval horizon_slice_measure(const slice *s, double sign, interval cosine);

/* What the samples of one side hide, over everything that rounding leaves open. */
hidden horizon_slice_hidden(const point *p, const slice *s, const side *d);

/* The integral of the directions, along the slice and towards the eye, that its hidden sectors and its veil stand for.
 * False where either is not decided. */
bool horizon_slice_directions(const point *p, const slice *s, const hidden h[2], double out[2]);
