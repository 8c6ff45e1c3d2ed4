/* SPDX-License-Identifier: MIT
 *
 * One hard case: what is seen, how it is stored, what is spoilt, and what must come out, at every technique and
 * quality.
 */
#ifndef GLSSAO_TESTS_HARD_CASE_H
#define GLSSAO_TESTS_HARD_CASE_H

#include "techniques.h"

typedef enum seen { SEE_PLANE, SEE_SPHERE, SEE_ROOM, SEE_WALL, SEE_NOTHING } seen;

typedef struct hard_case { /* zero means default */
    const char *name;
    seen shape;
    double degrees, distance; /* of a plane: between its normal and the view axis; scene units, default 3 */
    analytic_projection projection;
    double flip;                  /* y is mirrored where this is not 0 */
    double near_plane, far_plane; /* default 0.1 and 1000 */
    double zoom;                  /* the picture's width and height over what 60 degrees show; default 1 */
    int width, height; /* default 60 x 44: what depends on powers of two is compiled once with the odd sizes */
    depth_store depth;
    normal_store normal;
    double lengths;            /* the settings' lengths, over a third of the distance; default 1 */
    void (*spoil)(subject *s); /* changes the maps */
    void (*change)(glssao_settings *s);
    double least[TECHNIQUES]; /* accessibility is nowhere below; 0: it need only be sound */
    int turn; /* not 0, for what has shaders to itself: one configuration a technique, the turn-th, where not all are
                 run */
} hard_case;

/* Every configuration, or each `stride`-th, or those of the case's turn; with the host's normals, and rebuilt where the
 * case brings its own. Returns how many pictures were made. */
int hard_case_run(fixture *f, const hard_case *c, int stride);

#endif
