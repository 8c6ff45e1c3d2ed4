/* SPDX-License-Identifier: MIT
 *
 * What the last frame left: its camera, so that the next one finds its points again.
 */
#include "history.h"

#include <math.h>
#include <string.h>

/* Frames count up to twice this; then as many are taken off. A multiple of the period of the picks and of the turns. */
enum { COUNT_PERIOD = 1 << 16 };

static bool is_orthographic(const float projection[16])
{
    return projection[11] == 0.0f;
}

static bool has_same_estimate(const glssao_settings *a, const glssao_settings *b)
{
    return a->technique == b->technique && a->radius == b->radius && a->fade_start == b->fade_start &&
           a->fade_end == b->fade_end && a->surface_epsilon == b->surface_epsilon && a->power == b->power &&
           a->sample_count == b->sample_count && a->half_resolution == b->half_resolution &&
           a->no_angle_weight == b->no_angle_weight;
}

int glssao__history_frames(const glssao__history *h, const glssao_frame *frame, const glssao_settings *settings)
{
    const bool holds = settings->history > 0 && h->frames > 0 && !frame->cut && h->frame.margin == frame->margin &&
                       is_orthographic(h->frame.projection) == is_orthographic(frame->projection) &&
                       has_same_estimate(&h->settings, settings);
    return holds ? h->frames : 0;
}

/* view_now from world, inverted, then the last frame's view. In double precision: far from the origin both move points by much
 * more than the two views differ. */
static void last_view(const float last[16], const float now[16], float out[16])
{
    double n[16], inverse[16];
    for (int i = 0; i < 16; ++i)
        n[i] = (double)now[i];
    (void)glssao__invert(n, inverse); /* it was checked */
    for (int col = 0; col < 4; ++col)
        for (int row = 0; row < 4; ++row) {
            double sum = 0.0;
            for (int k = 0; k < 4; ++k)
                sum += (double)last[4 * k + row] * inverse[4 * col + k];
            out[4 * col + row] = (float)sum;
        }
}

void glssao__history_fill(const glssao__history *h, const glssao__uniforms_source *source, int frames,
                          glssao__frame_block *block)
{
    if (source->settings->history == 0)
        return;
    /* All four texels of a block in each four frames, in an order that differs from four to four: R2 is nearly periodic with
     * period 4. */
    static const float picks[4][2] = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
    const float *pick = picks[(frames + frames / 4) % 4];
    block->gHistory[0] = (float)source->settings->history;
    for (int i = 0; i < 2; ++i)
        block->gPick[i] = source->settings->half_resolution ? pick[i] : 0.0f;
    if (frames == 0)
        return;
    last_view(h->frame.view, source->frame->view, block->gLastView);
    memcpy(block->gLastRayOrigin, h->ray_origin, sizeof h->ray_origin);
    memcpy(block->gLastRayDirection, h->ray_direction, sizeof h->ray_direction);
    block->gLastRegion[0] = (float)h->region.x;
    block->gLastRegion[1] = (float)h->region.y;
    block->gLastRegion[2] = (float)(h->region.x + h->region.width - 1);
    block->gLastRegion[3] = (float)(h->region.y + h->region.height - 1);
    block->gHistory[1] = 1.0f;
}

void glssao__history_keep(glssao__history *h, const glssao__uniforms_source *source, int frames,
                          const glssao__region *region)
{
    *h = (glssao__history){0};
    if (source->settings->history == 0)
        return;
    h->frames = frames + 1 == 2 * COUNT_PERIOD ? COUNT_PERIOD : frames + 1;
    h->frame = *source->frame;
    h->settings = *source->settings;
    memcpy(h->ray_origin, source->projection->ray_origin, sizeof h->ray_origin);
    memcpy(h->ray_direction, source->projection->ray_direction, sizeof h->ray_direction);
    h->region = *region;
}
