/* SPDX-License-Identifier: MIT
 *
 * A picture of analytic shapes as a frame, and the surface that each pixel shows.
 */
#pragma once

#include "fixture.h"

typedef struct analytic_shot {
    const analytic_shape *shapes;
    int shape_count;
    analytic_view view;
    int width, height;
    float *depth, *normals;
    glssao_frame frame;
} analytic_shot;

/* The shapes must outlive it. */
analytic_shot analytic_take(const analytic_shape *shapes, int shape_count, analytic_projection projection, int width,
                            int height);
void analytic_free_shot(analytic_shot *s);
#define test_end_shot analytic_free_shot /* for SCOPED */
/* View-space position of a pixel's surface, in perspective. */
void analytic_position(const analytic_shot *s, int x, int y, double out[3]);
