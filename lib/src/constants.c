/* SPDX-License-Identifier: MIT
 *
 * Fills the uniform blocks. glsl/cb_ssao.glsl and glsl/cb_frame.glsl are compiled here as C too, so that the structs
 * can't drift from what the shaders read.
 */
#include "effect.h"

#include <math.h>
#include <string.h>

typedef float mat4[16];
typedef float vec4[4];
typedef float vec2[2];
struct block_ssao {
#include "cb_ssao.glsl"
};
struct block_frame {
#include "cb_frame.glsl"
};

struct block_hemisphere {
#include "cb_hemisphere.glsl"
};

#define SAME(block, type, member)                                                                                      \
    _Static_assert(offsetof(struct block, member) == offsetof(type, member), #member " lies elsewhere in the shader")
SAME(block_ssao, glssao_constants, gProj);
SAME(block_ssao, glssao_constants, gInvProj);
SAME(block_ssao, glssao_constants, gProjTex);
SAME(block_ssao, glssao_constants, gOffsetVectors);
SAME(block_ssao, glssao_constants, gBlurWeights);
SAME(block_ssao, glssao_constants, gInvRenderTargetSize);
SAME(block_ssao, glssao_constants, gOcclusionRadius);
SAME(block_ssao, glssao_constants, gOcclusionFadeStart);
SAME(block_ssao, glssao_constants, gOcclusionFadeEnd);
SAME(block_ssao, glssao_constants, gSurfaceEpsilon);
SAME(block_frame, glssao__frame_constants, gDistanceFromDepth);
SAME(block_frame, glssao__frame_constants, gRayOrigin);
SAME(block_frame, glssao__frame_constants, gRayDirection);
SAME(block_frame, glssao__frame_constants, gSkyDepth);
SAME(block_frame, glssao__frame_constants, gPower);
SAME(block_frame, glssao__frame_constants, gBlurNormalThreshold);
SAME(block_frame, glssao__frame_constants, gBlurDepthThreshold);
SAME(block_frame, glssao__frame_constants, gSampleCount);
SAME(block_frame, glssao__frame_constants, gFactor);
SAME(block_frame, glssao__frame_constants, gNoise);
SAME(block_frame, glssao__frame_constants, gAccumulation);
SAME(block_frame, glssao__frame_constants, gProbe);
SAME(block_frame, glssao__frame_constants, gDepthStep);
SAME(block_frame, glssao__frame_constants, gLogDepth);
SAME(block_frame, glssao__frame_constants, gTiles);
SAME(block_frame, glssao__frame_constants, gPixel);
SAME(block_frame, glssao__frame_constants, gEstimateSize);
SAME(block_frame, glssao__frame_constants, gFullTexel);
SAME(block_frame, glssao__frame_constants, gTileRings);
SAME(block_frame, glssao__frame_constants, gPerRadius);
SAME(block_hemisphere, glssao__hemisphere_constants, gKernel);
SAME(block_hemisphere, glssao__hemisphere_constants, gRotations);
_Static_assert(sizeof(struct block_ssao) == 488 && sizeof(glssao_constants) == 496, "cbSsao has another size");
_Static_assert(sizeof(glssao__frame_constants) % 16 == 0, "std140 rounds a block up to a vec4");

static const double PI = 3.14159265358979323846;

/* 0 .. count - 1 in random order (Fisher and Yates). */
static void shuffle(int *order, int count, glssao__random random)
{
    for (int i = 0; i < count; ++i) {
        int k = (int)(glssao__random_next(&random) % (uint32_t)(i + 1));
        order[i] = order[k];
        order[k] = i;
    }
}

void glssao__constants_init(glssao_constants *c, uint32_t seed)
{
    memset(c, 0, sizeof *c);
    /* Opposite ones next to each other, so that any even count of them is balanced. */
    static const float directions[14][3] = {
        {1, 1, 1},  {-1, -1, -1}, {-1, 1, 1}, {1, -1, -1}, {1, 1, -1}, {-1, -1, 1}, {-1, 1, -1},
        {1, -1, 1}, {-1, 0, 0},   {1, 0, 0},  {0, -1, 0},  {0, 1, 0},  {0, 0, -1},  {0, 0, 1},
    };
    glssao__random random = glssao__random_seed(seed, 0);
    for (int i = 0; i < 14; ++i) {
        const float *d = directions[i];
        float length = sqrtf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        float scale = (0.25f + 0.75f * glssao__random_unit(&random)) / length;
        for (int axis = 0; axis < 3; ++axis)
            c->gOffsetVectors[i][axis] = scale * d[axis];
    }
}

/* The tile's rotation angles: evenly spaced, in an order that the seed shuffles, so that a box of the tile's size
 * averages over all of them. */
void glssao__constants_init_hemisphere(glssao__hemisphere_constants *c, uint32_t seed)
{
    memset(c, 0, sizeof *c);
    enum { COUNT = ROTATION_TILE * ROTATION_TILE };
    int order[COUNT];
    shuffle(order, COUNT, glssao__random_seed(seed, 2));
    for (int i = 0; i < COUNT; ++i) {
        double angle_rad = 2.0 * PI * (order[i] + 0.5) / COUNT;
        c->gRotations[i][0] = (float)cos(angle_rad);
        c->gRotations[i][1] = (float)sin(angle_rad);
    }
}

/* Directions uniform over the hemisphere (heights in shuffled strata, azimuths by the golden angle), lengths denser
 * towards the point: the i-th of n is 0.1 + 0.9 (i / n)^2 long. */
void glssao__constants_fill_kernel(glssao__hemisphere_constants *c, uint32_t seed, int sample_count)
{
    int order[HEMISPHERE_CAPACITY];
    shuffle(order, sample_count, glssao__random_seed(seed, 3));
    for (int i = 0; i < sample_count; ++i) {
        double height = (order[i] + 0.5) / sample_count, across = sqrt(1.0 - height * height);
        double azimuth_rad = PI * (3.0 - sqrt(5.0)) * order[i];
        double fraction = (double)i / sample_count, length = 0.1 + 0.9 * fraction * fraction;
        c->gKernel[i][0] = (float)(length * across * cos(azimuth_rad));
        c->gKernel[i][1] = (float)(length * across * sin(azimuth_rad));
        c->gKernel[i][2] = (float)(length * height);
    }
}

/* weight(i) ~ exp(-i^2 / (2 sigma^2)), i = -radius..radius with radius = ceil(2 sigma), stored about slot 5. */
void glssao__constants_gauss_weights(float sigma, float out_weights[3][4])
{
    int radius = (int)ceilf(2.0f * sigma);
    double sum = 0.0, weights[12] = {0.0};
    for (int i = -radius; i <= radius; ++i) {
        weights[i + 5] = exp(-(double)(i * i) / (2.0 * (double)sigma * (double)sigma));
        sum += weights[i + 5];
    }
    for (int i = 0; i < 12; ++i)
        out_weights[i / 4][i % 4] = (float)(weights[i] / sum);
}

void glssao__constants_fill(glssao_constants *c, const glssao_frame *frame, const glssao_settings *settings,
                            const glssao__projection *projection, int ambient_width, int ambient_height)
{
    memcpy(c->gProj, frame->projection, sizeof c->gProj);
    memcpy(c->gInvProj, projection->view_from_clip, sizeof c->gInvProj);
    for (int col = 0; col < 4; ++col) {
        const float *p = frame->projection + 4 * col;
        float *t = c->gProjTex + 4 * col;
        t[0] = 0.5f * p[0] + 0.5f * p[3];
        t[1] = 0.5f * p[1] + 0.5f * p[3];
        t[2] = p[2];
        t[3] = p[3];
    }
    glssao__constants_gauss_weights(settings->blur_sigma, c->gBlurWeights);
    c->gInvRenderTargetSize[0] = 1.0f / (float)ambient_width;
    c->gInvRenderTargetSize[1] = 1.0f / (float)ambient_height;
    c->gOcclusionRadius = settings->radius;
    c->gOcclusionFadeStart = settings->fade_start;
    c->gOcclusionFadeEnd = settings->fade_end;
    c->gSurfaceEpsilon = settings->surface_epsilon;
}

void glssao__constants_fill_frame(glssao__frame_constants *c, const glssao_frame *frame,
                                  const glssao_settings *settings, const glssao__projection *projection,
                                  const glssao__precision *precision, const int full_size[2],
                                  const int estimate_size[2])
{
    memset(c, 0, sizeof *c);
    memcpy(c->gDistanceFromDepth, projection->distance_from_depth, sizeof c->gDistanceFromDepth);
    memcpy(c->gRayOrigin, projection->ray_origin, sizeof c->gRayOrigin);
    memcpy(c->gRayDirection, projection->ray_direction, sizeof c->gRayDirection);
    c->gSkyDepth = frame->depth_kind == GLSSAO_DEPTH_WINDOW ? projection->sky_depth : FAR_AWAY;
    c->gPower = settings->power;
    c->gBlurNormalThreshold = settings->blur_normal_threshold;
    c->gBlurDepthThreshold = settings->blur_depth_threshold;
    c->gSampleCount = settings->sample_count;
    c->gFactor = settings->half_resolution ? 2 : 1;
    c->gPerRadius = 1.0f / settings->radius;
    const bool orthographic = projection->ray_direction[0] == 0.0f;
    for (int i = 0; i < 2; ++i) {
        const double pixel =
            (double)c->gFactor / full_size[i] * (double)(orthographic ? c->gRayOrigin[i] : c->gRayDirection[i]);
        c->gPixel[i] = (float)(pixel / (double)settings->radius);
        c->gPixel[2 + i] = (float)((double)settings->radius / pixel);
        c->gEstimateSize[i] = (float)estimate_size[i];
        c->gFullTexel[i] = 1.0f / (float)full_size[i];
    }
    glssao__projection_depth_step(frame, projection, precision, c->gDepthStep);
    if (frame->depth_kind == GLSSAO_DEPTH_LOGARITHMIC) {
        const double constant = glssao__projection_log_constant(frame);
        c->gLogDepth[0] = (float)log2(constant * (double)frame->log_depth_far + 1.0);
        c->gLogDepth[1] = (float)(1.0 / constant);
    }
}
