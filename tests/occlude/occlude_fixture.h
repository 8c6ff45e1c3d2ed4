/* SPDX-License-Identifier: MIT
 *
 * Shared by the tests of occlude: one `occlude` for all tests of a program, pictures of shapes as a caller would hand
 * them over, and calls that must succeed or fail.
 */
#pragma once

#include "analytic.h"
#include "fixture.h"
#include "occlude.h"

enum { WIDTH = 96, HEIGHT = 64, COUNT = WIDTH * HEIGHT };

extern occlude *shared; /* opened once: its shaders compile once */
extern char error[512]; /* for the calls of the tests */

/* cmocka group functions: fixture_setup's, and `shared`. */
int occlude_setup(void **state);
int occlude_teardown(void **state);

void turn_over(float *values, int width, int height, int channels);

typedef struct picture {
    analytic_view view;
    float *window_depth, *distance, *normals; /* rows from the top */
} picture;

picture make_picture(const analytic_shape *shapes, int count, analytic_projection projection);
void free_picture(picture *p);
#define test_end_picture free_picture /* for SCOPED */

occlude_input input_of(const picture *p, bool window_depth);
glssao_settings settings_of(float radius);

void compute(const occlude_input *input, const glssao_settings *settings, float *out);
/* Refused with exactly this line, and the result is not written to. */
void refuse(const occlude_input *input, const glssao_settings *settings, const char *line);
