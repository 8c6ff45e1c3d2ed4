/* SPDX-License-Identifier: MIT
 *
 * Fills the uniform blocks.
 */
#include "frame/uniforms.h"

#include "frame/steps.h"
#include "random.h"

#include <math.h>
#include <string.h>

/* The public header can't include a shader file, so it has the members of cbSsao once more. */
#define SAME(member)                                                                                                   \
    _Static_assert(offsetof(glssao__ssao_block, member) == offsetof(glssao_constants, member),                         \
                   #member " has another offset in the shader")
SAME(gProj);
SAME(gInvProj);
SAME(gProjTex);
SAME(gOffsetVectors);
SAME(gBlurWeights);
SAME(gInvRenderTargetSize);
SAME(gOcclusionRadius);
SAME(gOcclusionFadeStart);
SAME(gOcclusionFadeEnd);
SAME(gSurfaceEpsilon);
_Static_assert(sizeof(glssao__ssao_block) == 488 && sizeof(glssao_constants) == 496, "cbSsao has another size");
#undef SAME

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

static void init_offsets(glssao_constants *c, uint32_t seed)
{
    /* Opposite directions are neighbours, so any even number of them is balanced. */
    static const float directions[14][3] = {
        {1, 1, 1},  {-1, -1, -1}, {-1, 1, 1}, {1, -1, -1}, {1, 1, -1}, {-1, -1, 1}, {-1, 1, -1},
        {1, -1, 1}, {-1, 0, 0},   {1, 0, 0},  {0, -1, 0},  {0, 1, 0},  {0, 0, -1},  {0, 0, 1},
    };
    glssao__random random = glssao__random_seed(seed, GLSSAO__STREAM_OFFSETS);
    for (int i = 0; i < 14; ++i) {
        const float *d = directions[i];
        float length = sqrtf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        float scale = (0.25f + 0.75f * glssao__random_unit(&random)) / length;
        for (int axis = 0; axis < 3; ++axis)
            c->gOffsetVectors[i][axis] = scale * d[axis];
    }
}

/* The rotation angles of the tile are evenly spaced, in an order that the seed shuffles: a box of the tile's size
 * averages over all of them. `turn`: of all, in turns. */
static void fill_rotations(glssao__hemisphere_block *c, uint32_t seed, float turn)
{
    enum { COUNT = sizeof c->gRotations / sizeof *c->gRotations };
    int order[COUNT];
    shuffle(order, COUNT, glssao__random_seed(seed, GLSSAO__STREAM_ROTATIONS));
    for (int i = 0; i < COUNT; ++i) {
        double angle_rad = 2.0 * PI * ((order[i] + 0.5) / COUNT + (double)turn);
        c->gRotations[i][0] = (float)cos(angle_rad);
        c->gRotations[i][1] = (float)sin(angle_rad);
    }
}

/* Heights in shuffled strata, azimuths by the golden angle. */
void glssao__uniforms_kernel(glssao__hemisphere_block *c, uint32_t seed, int sample_count)
{
    int order[sizeof c->gKernel / sizeof *c->gKernel];
    shuffle(order, sample_count, glssao__random_seed(seed, GLSSAO__STREAM_KERNEL));
    for (int i = 0; i < sample_count; ++i) {
        double height = (order[i] + 0.5) / sample_count, across = sqrt(1.0 - height * height);
        double azimuth_rad = PI * (3.0 - sqrt(5.0)) * order[i];
        double fraction = (double)i / sample_count, length = 0.1 + 0.9 * fraction * fraction;
        c->gKernel[i][0] = (float)(length * across * cos(azimuth_rad));
        c->gKernel[i][1] = (float)(length * across * sin(azimuth_rad));
        c->gKernel[i][2] = (float)(length * height);
    }
}

void glssao__uniforms_gauss_weights(float sigma, float out_weights[3][4])
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

void glssao__uniforms_init(glssao__uniforms *u, uint32_t seed)
{
    memset(u, 0, sizeof *u);
    init_offsets(&u->ssao, seed);
    fill_rotations(&u->hemisphere, seed, 0.0f);
}

/* Bent normals are made at radius 0 too (scene units): samples then reach no other pixel. */
static const float LEAST_RADIUS = 1e-12f;

/* The radius in scene units, or where it counts pixels in perspective, at a view distance of 1. Pixels that are no
 * squares count as squares of the same area. */
static double radius_of(const glssao__uniforms_source *source)
{
    const glssao_settings *s = source->settings;
    const glssao__projection *p = source->projection;
    const float *side = p->is_orthographic ? p->ray_origin : p->ray_direction;
    double radius = (double)s->radius;
    if (s->radius_in_pixels)
        radius *= sqrt(fabs((double)side[0] / source->size[0] * (double)side[1] / source->size[1]));
    return s->bent_normals && radius <= 0.0 ? (double)LEAST_RADIUS : radius;
}

static void fill_ssao(glssao_constants *c, const glssao__uniforms_source *source)
{
    const glssao_settings *settings = source->settings;
    memcpy(c->gProj, source->projection->clip_from_view, sizeof c->gProj);
    memcpy(c->gInvProj, source->projection->view_from_clip, sizeof c->gInvProj);
    for (int col = 0; col < 4; ++col) {
        const float *p = source->projection->clip_from_view + 4 * col;
        float *t = c->gProjTex + 4 * col;
        t[0] = 0.5f * p[0] + 0.5f * p[3];
        t[1] = 0.5f * p[1] + 0.5f * p[3];
        t[2] = p[2];
        t[3] = p[3];
    }
    glssao__uniforms_gauss_weights(settings->blur_sigma, c->gBlurWeights);
    c->gInvRenderTargetSize[0] = 1.0f / (float)source->estimate_size[0];
    c->gInvRenderTargetSize[1] = 1.0f / (float)source->estimate_size[1];
    c->gOcclusionRadius = (float)radius_of(source);
    c->gOcclusionFadeStart = settings->fade_start;
    c->gOcclusionFadeEnd = settings->fade_end;
    c->gSurfaceEpsilon = settings->surface_epsilon;
}

/* Sine of the angle up to which a surface counts as a plane. Horizon's estimate of such a plane is 1 within a step of
 * R16 (glsl/tiles/proof.md); the hemisphere technique's epsilon hides more. */
static const float FLAT = 1.5e-3f;

/* For the passes in glsl/tiles/. */
static void fill_tiles(glssao__frame_block *c, const glssao__uniforms_source *source)
{
    const glssao_settings *s = source->settings;
    const bool grows = s->radius_in_pixels && !source->projection->is_orthographic; /* beyond any epsilon */
    const bool classic = s->technique == GLSSAO_CLASSIC, hemisphere = s->technique == GLSSAO_HEMISPHERE;
    /* A sample above a plane that is off by FLAT may lie this little behind the surface that is seen there. */
    const bool hidden = hemisphere && (grows || s->surface_epsilon < 16.0f * FLAT * (float)radius_of(source));
    c->gTiles[0] = (float)TILE_SIDE;
    /* Classic reflects its offsets about vectors that are not of unit length: one as long as the root of 3 stretches an
     * offset by 5. */
    c->gTiles[1] = classic ? 5.0f : 1.0f;
    /* The little occlusion that is left of a plane grows with the power. */
    c->gTiles[2] = classic || hidden ? 0.0f : s->power > 1.0f ? FLAT / s->power : FLAT;
    c->gTiles[3] = classic ? s->surface_epsilon : 0.0f;
    c->gTileRings = (float)(source->tile_rings + 3);
}

/* From stored normals to the view space of the passes, which is the host's turned about the view axis. */
static void fill_turn(glssao__frame_block *c, const glssao_frame *frame, const glssao__projection *projection)
{
    const double cosine = (double)projection->turn[0], sine = (double)projection->turn[1];
    double n[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    if (frame->world_normals && frame->normal_texture != 0)
        (void)glssao__matrix_normals(frame->view, n); /* the check has seen that it is not singular */
    for (int i = 0; i < 3; ++i) {
        c->gTurn[0][i] = (float)(cosine * n[i] + sine * n[3 + i]);
        c->gTurn[1][i] = (float)(cosine * n[3 + i] - sine * n[i]);
        c->gTurn[2][i] = (float)n[6 + i];
    }
    memcpy(c->gRoll, projection->turn, sizeof c->gRoll);
}

/* How thick occluders count, and how far away occlusion does. */
static void fill_extent(glssao__frame_block *c, const glssao_settings *s, const glssao__projection *projection)
{
    const double thickness = s->thickness > 0.0f ? (double)s->thickness : 1.0;
    const double start = (double)s->fade_far_start, end = (double)s->fade_far_end;
    c->gThickness[0] = (float)thickness;
    /* So far before the point that the run is thicker than the sphere. */
    c->gThickness[1] = (float)(-100.0 / fmin(thickness, 1.0));
    c->gFadeFar[0] = (float)FAR_AWAY;
    c->gFadeFar[1] = 1.0f;
    if (end > 0.0) {
        c->gFadeFar[0] = (float)(end - projection->eye);
        c->gFadeFar[1] = (float)fmin(1.0 / (end - start), 1e30); /* infinite for a step */
    }
}

static void fill_frame(glssao__frame_block *c, const glssao__uniforms_source *source)
{
    const glssao_frame *frame = source->frame;
    const glssao_settings *settings = source->settings;
    const glssao__projection *projection = source->projection;
    memset(c, 0, sizeof *c);
    memcpy(c->gDistanceFromDepth, projection->distance_from_depth, sizeof c->gDistanceFromDepth);
    memcpy(c->gRayOrigin, projection->ray_origin, sizeof c->gRayOrigin);
    memcpy(c->gRayDirection, projection->ray_direction, sizeof c->gRayDirection);
    const bool is_window = glssao__projection_reads_window_depth(frame, projection->is_oblique);
    c->gSkyDepth = is_window ? projection->sky_depth : (float)FAR_AWAY;
    c->gWindowSky = projection->sky_depth;
    memcpy(c->gOblique, projection->oblique, sizeof c->gOblique);
    c->gPower = settings->power;
    c->gBlurNormalThreshold = settings->blur_normal_threshold;
    c->gBlurDepthThreshold = settings->blur_depth_threshold;
    c->gSampleCount = settings->sample_count;
    c->gFactor = settings->half_resolution ? 2 : 1;
    for (int i = 0; i < 2; ++i) {
        const double pixel = (double)source->map_factor / source->size[i] *
                             (double)(projection->is_orthographic ? c->gRayOrigin[i] : c->gRayDirection[i]);
        c->gPixel[i] = (float)pixel;
        c->gPixel[2 + i] = (float)(1.0 / pixel);
        c->gEstimateSize[i] = (float)source->estimate_size[i];
        c->gMapSize[i] = source->map_factor == 1 ? (float)source->size[i] : (float)source->estimate_size[i];
        c->gMapTexel[i] = 1.0f / c->gMapSize[i];
        c->gFullTexel[i] = 1.0f / (float)source->size[i];
    }
    /* R2 (M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018): the inverse of the plastic
     * number, and its square. */
    const double inverse = 0.7548776662466927;
    c->gNoise[0] = (float)fmod(source->noise_index * inverse, 1.0);
    c->gNoise[1] = (float)fmod(source->noise_index * (inverse * inverse), 1.0);
    fill_turn(c, frame, projection);
    fill_tiles(c, source);
    fill_extent(c, settings, projection);
    glssao__projection_depth_step(frame, projection, &source->precision, c->gDepthStep);
    if (settings->technique == GLSSAO_HORIZON || settings->technique == GLSSAO_RAYS)
        c->gDepthStep[0] += settings->surface_epsilon;
    if (frame->depth_kind == GLSSAO_DEPTH_LOGARITHMIC) {
        const double constant = glssao__projection_log_constant(frame);
        c->gLogDepth[0] = (float)log2(constant * (double)frame->log_depth_far + 1.0);
        c->gLogDepth[1] = (float)(1.0 / constant);
    }
}

void glssao__uniforms_fill(glssao__uniforms *u, const glssao__uniforms_source *source)
{
    fill_ssao(&u->ssao, source);
    fill_frame(&u->frame, source);
    if (source->settings->technique == GLSSAO_HEMISPHERE) {
        glssao__uniforms_kernel(&u->hemisphere, source->seed, source->settings->sample_count);
        fill_rotations(&u->hemisphere, source->seed, u->frame.gNoise[0]);
    }
}
