/* SPDX-License-Identifier: MIT */
#pragma once

#include <stdbool.h>

/* The matrix that takes normals along with an affine transform: the inverse transpose of its upper 3x3, in columns of
 * three, scaled so that its largest element is 1. It exists for flat transforms too. Returns whether the transform
 * mirrors. */
bool matrix_for_normals(const float affine[16], double out[9]);
