/* SPDX-License-Identifier: MIT
 *
 * Random numbers that repeat: the same seed gives the same numbers on every machine.
 */
#ifndef GLSSAO_RANDOM_H
#define GLSSAO_RANDOM_H

#include <stdint.h>

enum { RANDOM_VECTOR_MAP_SIZE = 256 };

/* One stream for each use of the seed, so that the uses do not share numbers. */
enum {
    GLSSAO__STREAM_OFFSETS,
    GLSSAO__STREAM_VECTORS,
    GLSSAO__STREAM_ROTATIONS,
    GLSSAO__STREAM_KERNEL,
    GLSSAO__STREAM_ACCUMULATION /* this and the next: one for each replicate */
};

typedef struct glssao__random {
    uint64_t state;
} glssao__random;

glssao__random glssao__random_seed(uint32_t seed, uint32_t stream);
uint32_t glssao__random_next(glssao__random *r);
float glssao__random_unit(glssao__random *r); /* 0 <= x < 1, 24 bits */

/* Fills the random vector map: RANDOM_VECTOR_MAP_SIZE squared texels of RGBA8, each channel uniform. */
void glssao__random_vector_texels(uint32_t seed, uint8_t *out_rgba);

#endif
