/* SPDX-License-Identifier: MIT
 *
 * One hard case: the shapes, how they are stored, which values are spoilt, and the result that is required, at every
 * technique and quality.
 */
#pragma once

#include "techniques.h"

typedef enum seen { SEE_PLANE, SEE_SPHERE, SEE_ROOM, SEE_WALL, SEE_NOTHING } seen;

typedef struct hard_case { /* zero means default */
    const char *name;
    seen shape;
    double degrees, distance; /* of a plane: angle between normal and view axis; scene units, default 3 */
    analytic_projection projection;
    double flip;                  /* y is mirrored if this is not 0 */
    double near_plane, far_plane; /* default 0.1 and 1000 */
    double zoom;                  /* width and height of the picture over the extent that 60 degrees show; default 1 */
    int width, height;            /* default 64 x 48 */
    depth_store depth;
    normal_store normal;
    double lengths;            /* multiplies the settings' lengths, relative to a third of the distance; default 1 */
    void (*spoil)(subject *s); /* changes the maps */
    void (*change)(glssao_settings *s);
    double least[TECHNIQUES]; /* the least accessibility allowed; 0: only finite and within 0..1 */
    int turn; /* not 0 for a case with shaders of its own: if not all configurations run, one per technique, chosen by
                 turn */
} hard_case;

/* Runs every configuration, each `stride`-th, or those of the case's turn, with the host's normals, and with rebuilt
 * ones if the case says so. Returns the number of pictures. */
int hard_case_run(fixture *f, const hard_case *c, int stride);
