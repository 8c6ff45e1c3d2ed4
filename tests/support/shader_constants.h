/* SPDX-License-Identifier: MIT
 *
 * Constants of a shader, read from the source that the library embeds, so that a model has the numbers that the shader
 * has, whatever they are tuned to.
 */
#ifndef GLSSAO_TESTS_SHADER_CONSTANTS_H
#define GLSSAO_TESTS_SHADER_CONSTANTS_H

#include <stdbool.h>

/* The value of `const float NAME = number;` in the `count` pieces of a source, joined, where conditional lines are left
 * out as the preprocessor does: conditions are macros, !, && and ||. False where there is not exactly one. */
bool shader_constant(const char *const *pieces, int count, const char *name, double *out_value);

#endif
