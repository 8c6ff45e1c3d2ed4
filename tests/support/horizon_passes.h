/* SPDX-License-Identifier: MIT
 *
 * The planar blur and upsampling in double precision, written from their formulas, to compare with pixel by pixel. As
 * in horizon_model.h, the result is an interval where float arithmetic could decide a threshold either way.
 */
#pragma once

#include <stdbool.h>

/* Two floats per texel, as the passes hand them on: accessibility, whose ten lowest bits hold the normal's equal-area
 * projection; and the linear quantity of distance (1 / distance in perspective, distance in orthographic views). */
typedef struct paired_map {
    float *texels; /* three a texel, the third unused */
    int width, height;
} paired_map;
void paired_free(paired_map *map);
#define test_end_paired paired_free /* for SCOPED */

typedef struct pass_constants {
    double tolerance, near, hollow; /* scene units; used by the last of the later blur rounds only */
    double alone;                   /* accessibility that a pixel without taps may be darker by than its neighbours */
    double wide_alike;              /* taps that differ by so much do not count in a later round */
    double chord;                   /* between two unit normals on different sides of a crease */
    double normal_step;
    int apart;            /* pixels between neighbours of the first round; 0: 1 */
    bool are_rays;        /* values below 0 are missing; else they are part of a mean, as in passes/horizon.frag */
    double alike;         /* values of rays that differ by so much do not count; 0: all do */
    double prior;         /* taps without a difference that count besides those of the window; 0: of a mean */
    double fall;          /* upsampling without normals: see upsample_model */
    double depth_step[3]; /* step of the depth format at view distance t: coefficients of 1, t and t^2 */
} pass_constants;

/* One direction of the first round; one later round. Of rays, values below 0 are missing, and so is the result of none
 * but such, which is -1. */
void planar_blur_model(const paired_map *map, bool horizontal, bool orthographic, const pass_constants *constants,
                       int x, int y, double *out_low, double *out_high);
void wide_blur_model(const paired_map *map, bool orthographic, const pass_constants *constants, int x, int y,
                     double *out_low, double *out_high);

/* A full-size pixel: its linear quantity; with a normal map its unit normal; without, the linear quantity beyond each
 * of the four half-size texels about it, seen from the pixel, as far again. Without normals a texel does not count
 * where the line through it and what lies beyond passes above the pixel by more than `tolerance` and `fall` times the
 * best texel's. */
typedef struct full_pixel {
    double linear;
    const double *normal; /* NULL: no normal map */
    double beyond[4];
} full_pixel;

void upsample_model(const paired_map *half, bool orthographic, const pass_constants *constants, const full_pixel *own,
                    int x, int y, double *out_low, double *out_high);

/* Accessibility of a texel without the bits of the normal. */
double paired_accessibility(float red);
/* Replaces the value, which keeps its normal; negative: missing. */
void paired_set(float *red, double value);
