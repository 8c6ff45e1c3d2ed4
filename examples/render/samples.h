/* SPDX-License-Identifier: MIT
 *
 * Several samples a pixel: the scene is drawn once for each, shifted by a part of a pixel, and the pictures are
 * averaged in linear light. Also gives straight alpha where a picture has transparent parts.
 */
#pragma once

#include "draw.h"
#include "fault.h"
#include "gl.h"

typedef struct samples {
    GLuint sample, framebuffer;  /* RGBA16F: one sample, linear, alpha premultiplied */
    GLuint sum, sum_framebuffer; /* RGBA32F */
    GLuint program, vertex_array;
    GLint scale, resolves; /* uniforms */
} samples;

/* Makes what is missing, of the size of `depth`, a depth texture that is attached. False, with one line in `why`;
 * samples_close is due in either case. */
bool samples_open(samples *s, int width, int height, GLuint depth, failure *why);
void samples_close(samples *s);

/* The view of one of `count` samples. */
scene_view samples_view(const scene_view *view, int index, int count);

/* Adds the sample that was drawn into `framebuffer` to the sum; the first one begins a new sum. */
void samples_add(samples *s, bool first);
/* Draws the mean of `count` samples, with straight alpha, into a framebuffer that encodes sRGB. */
void samples_resolve(samples *s, int count, GLuint framebuffer);
