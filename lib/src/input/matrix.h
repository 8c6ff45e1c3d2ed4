/* SPDX-License-Identifier: MIT
 *
 * A projection matrix as the passes use it: without rounding residues, and turned upright about the view axis.
 */
#ifndef GLSSAO_INPUT_MATRIX_H
#define GLSSAO_INPUT_MATRIX_H

#include "log.h"

/* A matrix that works but is probably not the one that was meant. */
enum glssao__doubt { DOUBT_NONE, DOUBT_IDENTITY, DOUBT_TRANSPOSED };

typedef struct glssao__matrix {
    double clip_from_view[16]; /* of the passes' view space: clip x depends on view x and z, clip y on view y and z */
    double cosine, sine;       /* the passes' view x is cosine x + sine y of the host's, their y is cosine y - sine x */
    bool is_turned;            /* by more than rounding */
    bool is_orthographic;
    bool is_oblique; /* clip z depends on view x or y: a near plane that is not across the view axis */
    enum glssao__doubt doubt;
} glssao__matrix;

/* False, with the reason logged, where no picture can come from the matrix. */
bool glssao__matrix_read(const float projection[16], const glssao__log *log, glssao__matrix *out);

/* The rows of the matrix that turns normals as the first three rows and columns of `m` turn points: their cofactors,
 * over their size. It keeps a normal on its side of the surface where `m` mirrors. False where `m` is singular. */
bool glssao__matrix_normals(const float m[16], double out_rows[9]);

/* What to add to a message about the matrix. */
const char *glssao__matrix_hint(enum glssao__doubt doubt);

/* False where the matrix is singular to working precision, or its inverse has no place in floats. */
bool glssao__matrix_invert(const double m[16], double out[16]);

#endif
