/* SPDX-License-Identifier: MIT
 *
 * Default settings.
 */
#include "glssao/glssao.h"

/* As in Learn OpenGL: 64 samples at full size, a box blur of the noise tile's size, no contrast. */
static glssao_settings hemisphere_settings(glssao_settings s, glssao_quality quality)
{
    s.technique = GLSSAO_HEMISPHERE;
    s.surface_epsilon = 0.025f;
    s.power = 1.0f;
    s.sample_count = quality == GLSSAO_LOW ? 8 : quality == GLSSAO_MEDIUM ? 16 : quality == GLSSAO_ULTRA ? 64 : 32;
    s.half_resolution = false;
    s.blur = GLSSAO_BLUR_BOX;
    s.blur_rounds = 1;
    return s;
}

/* LOW, MEDIUM and HIGH estimate at half size and upsample along surfaces. ULTRA estimates at full size. */
static glssao_settings horizon_settings(glssao_settings s, glssao_quality quality)
{
    s.technique = GLSSAO_HORIZON;
    s.surface_epsilon = 0.0f;
    s.power = 1.0f;
    s.sample_count = quality == GLSSAO_LOW ? 12 : quality == GLSSAO_MEDIUM ? 16 : 48;
    s.half_resolution = quality != GLSSAO_ULTRA;
    s.upsample = true;
    s.blur = GLSSAO_BLUR_PLANAR;
    /* One round smooths a 4x4 tile of noise. The second is for the 8x8 tile of a single slice, and for what is left;
     * ULTRA, whose pixels are half as wide, needs a third to reach as far. */
    s.blur_rounds = quality == GLSSAO_ULTRA ? 3 : 2;
    return s;
}

/* As many rays as the host may trace for a result that is better than that of horizon's level, docs/decisions/0142. */
static glssao_settings rays_settings(glssao_settings s, glssao_quality quality)
{
    s.technique = GLSSAO_RAYS;
    s.surface_epsilon = 0.0f;
    s.power = 1.0f;
    s.sample_count = quality == GLSSAO_LOW ? 2 : quality == GLSSAO_HIGH ? 4 : 8;
    s.half_resolution = quality <= GLSSAO_MEDIUM;
    s.upsample = true;
    s.blur = GLSSAO_BLUR_PLANAR;
    s.blur_rounds = 2;
    return s;
}

glssao_settings glssao_default_settings(glssao_technique technique, glssao_quality quality)
{
    /* The first edition of the effect in Luna's book; HIGH has the book's values. */
    glssao_settings s = {
        .technique = GLSSAO_CLASSIC,
        .radius = 0.5f,
        .fade_start = 0.2f,
        .fade_end = 1.0f,
        .surface_epsilon = 0.05f,
        .power = 6.0f,
        .sample_count = 14,
        .half_resolution = true,
        .blur = GLSSAO_BLUR_BILATERAL,
        .blur_rounds = 3,
        .blur_sigma = 2.5f,
        .blur_normal_threshold = 0.8f,
        .blur_depth_threshold = 0.2f,
        .thickness = 1.0f,
    };
    if (technique == GLSSAO_HEMISPHERE)
        return hemisphere_settings(s, quality);
    if (technique == GLSSAO_RAYS)
        return rays_settings(s, quality);
    if (technique == GLSSAO_HORIZON)
        return horizon_settings(s, quality);
    switch (quality) {
    case GLSSAO_LOW:
        s.sample_count = 8;
        s.blur_rounds = 1;
        break;
    case GLSSAO_MEDIUM:
        s.blur_rounds = 2;
        break;
    case GLSSAO_HIGH:
        break;
    case GLSSAO_ULTRA:
        s.half_resolution = false;
        s.blur_rounds = 4;
        break;
    }
    return s;
}
