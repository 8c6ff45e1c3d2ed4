/* SPDX-License-Identifier: MIT
 *
 * Input of the stability tests: a picture of shapes, stored in any way that a host may store it, and the accessibility
 * that comes back.
 */
#pragma once

#include "analytic.h"
#include "fixture.h"

/* How depth is stored. */
typedef enum depth_store {
    DEPTH_16,
    DEPTH_24,
    DEPTH_24_STENCIL,
    DEPTH_32,
    DEPTH_32F,
    DEPTH_32F_STENCIL,
    DISTANCE_32F,
    DISTANCE_16F,
    ALPHA_32F, /* beside the normal */
    ALPHA_16F,
    DEPTH_STORES
} depth_store;

/* How normals are stored. Depth in alpha implies float normals. */
typedef enum normal_store {
    NORMAL_NONE, /* rebuilt from depth */
    NORMAL_32F,
    NORMAL_16F,
    NORMAL_8,
    NORMAL_UNSIGNED_8,
    NORMAL_OCTAHEDRAL,
    NORMAL_STORES
} normal_store;

/* The maps in memory, rows bottom to top, for a case to spoil before they become textures. */
typedef struct subject {
    int width, height;
    analytic_view view;
    float *depth;    /* window depth */
    float *normals;  /* xyz */
    float *distance; /* view distance; infinite: sky */
} subject;

typedef struct picture {
    float *values;
    int width, height;
} picture;

subject subject_of(const analytic_view *view, const analytic_shape *shapes, int count, int width, int height);
void subject_free(subject *s);
/* For SCOPED. */
#define test_end_subject subject_free
void test_end_picture(const picture *p);

/* Textures of the subject. fixture_delete_frame deletes them. */
glssao_frame subject_frame(const subject *s, depth_store depth, normal_store normal);

/* Runs glssao_compute on the frame; any result but GLSSAO_OK fails the test. The caller frees the values. */
picture subject_shade_by(fixture *f, glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings);
/* The same with the fixture's effect. */
picture subject_shade(fixture *f, int width, int height, const glssao_frame *frame, const glssao_settings *settings);

/* Names for messages. */
const char *subject_depth_name(depth_store depth);
const char *subject_normal_name(normal_store normal);
