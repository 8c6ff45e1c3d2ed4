/* SPDX-License-Identifier: MIT
 *
 * A picture of all that surrounds a scene, as a source of light: irradiance as nine spherical harmonics, and what
 * mirrors of growing roughness show. No OpenGL.
 *
 * The picture is equirectangular: twice as wide as high, straight up along its upper edge, straight down along its
 * lower one. Its middle lies along -z of the world, to the right of it +x; for another
 * up than +y it is turned the shortest way.
 */
#pragma once

#include "fault.h"

#include <stdbool.h>

enum { ENVIRONMENT_LEVELS = 6, ENVIRONMENT_WIDTH = 512, ENVIRONMENT_MOST_WIDTH = 4096 };

/* Linear RGB, rows from the top. */
typedef struct environment_picture {
    int width, height;
    float *rgb;
} environment_picture;

typedef struct environment {
    environment_picture sky; /* the file's own, halved until it is no wider than ENVIRONMENT_MOST_WIDTH */
    /* The reflection in a mirror of roughness i / 5. The first is ENVIRONMENT_WIDTH wide, each further one half as
     * wide. */
    environment_picture mirrors[ENVIRONMENT_LEVELS];
    /* Irradiance / pi, times: 1, y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2 of the unit normal. */
    float irradiance[9][3];
} environment;

/* A PNG, JPEG or WebP (sRGB), or a Radiance picture (linear). The file does not say how bright it is to look. If it
 * would give a white surface more than 1, the whole picture is dimmed so that the brightest of the six directions along
 * the axes gets 1. NULL, with one line in `error` that names the file and the fault, on failure. */
environment *environment_load(const char *path, failure *fault);
void environment_destroy(environment *e);

/* Radiance / pi of a white matte surface that faces along the unit vector. */
void environment_irradiance(const environment *e, const float normal_world[3], float out_rgb[3]);
/* The reflection in a mirror of roughness level / 5 along the unit vector, filtered linearly. */
void environment_mirrored(const environment *e, int level, const float direction_world[3], float out_rgb[3]);

/* ---- environment_light.c */

/* Fills mirrors and irradiance from the sky. False where memory is short. */
bool environment_light(environment *e);
