/* SPDX-License-Identifier: MIT
 *
 * Reads a shader's constants from the source that the library embeds, so that a model uses the same tuned numbers.
 */
#ifndef GLSSAO_TESTS_SHADER_CONSTANTS_H
#define GLSSAO_TESTS_SHADER_CONSTANTS_H

#include <stdbool.h>

/* The value of `const float NAME = number;` in the `count` joined pieces of a source. Conditional lines are dropped as
 * the preprocessor does; conditions may use macros, !, && and ||. False unless exactly one such line remains. */
bool shader_constant(const char *const *pieces, int count, const char *name, double *out_value);

#endif
