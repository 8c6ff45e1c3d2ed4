/* SPDX-License-Identifier: MIT
 *
 * Random inputs that repeat: PCG32, XSH-RR variant (M. O'Neill, "PCG: A Family of Simple Fast Space-Efficient
 * Statistically Good Algorithms for Random Number Generation", 2014), and the random vector map made with it.
 */
#include "random.h"

/* The generator has one fixed increment. The stream goes into the state instead, and two steps mix its bits. */
glssao__random glssao__random_seed(uint32_t seed, uint32_t stream)
{
    glssao__random r = {(uint64_t)stream << 32 | seed};
    (void)glssao__random_next(&r);
    (void)glssao__random_next(&r);
    return r;
}

uint32_t glssao__random_next(glssao__random *r)
{
    uint64_t old = r->state;
    r->state = old * 6364136223846793005u + 1442695040888963407u;
    uint32_t xorshifted = (uint32_t)((old >> 18 ^ old) >> 27);
    uint32_t rotation = (uint32_t)(old >> 59);
    return xorshifted >> rotation | xorshifted << (-rotation & 31u);
}

float glssao__random_unit(glssao__random *r)
{
    return (float)(glssao__random_next(r) >> 8) * 0x1p-24f;
}

void glssao__random_vector_texels(uint32_t seed, uint8_t *out_rgba)
{
    glssao__random r = glssao__random_seed(seed, GLSSAO__STREAM_VECTORS);
    for (int i = 0; i < RANDOM_VECTOR_MAP_SIZE * RANDOM_VECTOR_MAP_SIZE * 4; ++i)
        out_rgba[i] = (uint8_t)(glssao__random_next(&r) >> 24);
}
