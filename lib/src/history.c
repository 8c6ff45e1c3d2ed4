/* SPDX-License-Identifier: MIT
 *
 * What the last frame left: its camera, so that the next one finds its points again.
 */
#include "history.h"

#include "input/matrix.h"

#include <math.h>
#include <string.h>

/* Frames count up to twice this; then as many are taken off. A multiple of the period of the picks and of the turns. */
enum { COUNT_PERIOD = 1 << 16 };

static bool has_same_estimate(const glssao_settings *a, const glssao_settings *b)
{
    return a->technique == b->technique && a->radius == b->radius && a->radius_in_pixels == b->radius_in_pixels &&
           a->thickness == b->thickness && a->fade_far_start == b->fade_far_start &&
           a->fade_far_end == b->fade_far_end && a->fade_start == b->fade_start && a->fade_end == b->fade_end &&
           a->surface_epsilon == b->surface_epsilon && a->power == b->power && a->sample_count == b->sample_count &&
           a->half_resolution == b->half_resolution && a->no_angle_weight == b->no_angle_weight;
}

int glssao__history_frames(const glssao__history *h, const glssao_frame *frame, const glssao_settings *settings,
                           const glssao__projection *projection)
{
    const bool holds = settings->history > 0 && h->frames > 0 && !frame->cut && h->margin == frame->margin &&
                       h->has_rays == (frame->rays_texture != 0) && h->is_orthographic == projection->is_orthographic &&
                       has_same_estimate(&h->settings, settings);
    return holds ? h->frames : 0;
}

/* The passes' view space from world space: the host's turned about the view axis, and moved along it (projection.h). */
static void find_view(const glssao__uniforms_source *source, double out[16])
{
    const glssao__projection *p = source->projection;
    const double cosine = (double)p->turn[0], sine = (double)p->turn[1];
    for (int col = 0; col < 4; ++col) {
        const float *v = source->frame->view + 4 * col;
        const double last = col == 3 ? 1.0 : 0.0;
        out[4 * col] = cosine * (double)v[0] + sine * (double)v[1];
        out[4 * col + 1] = cosine * (double)v[1] - sine * (double)v[0];
        out[4 * col + 2] = (double)v[2] + p->eye * last;
        out[4 * col + 3] = last;
    }
}

/* The last view space from this one. In double precision: far from the origin both matrices move points by much more
 * than the two views differ. */
static void find_last_view(const double last[16], const double now[16], float out[16])
{
    double inverse[16];
    (void)glssao__matrix_invert(now, inverse); /* the view was checked */
    for (int col = 0; col < 4; ++col)
        for (int row = 0; row < 4; ++row) {
            double sum = 0.0;
            for (int k = 0; k < 4; ++k)
                sum += last[4 * k + row] * inverse[4 * col + k];
            out[4 * col + row] = (float)sum;
        }
}

void glssao__history_fill(const glssao__history *h, const glssao__uniforms_source *source, int frames,
                          glssao__frame_block *block)
{
    if (source->settings->history == 0)
        return;
    /* All four texels of a block in each four frames, in an order that differs from four to four: R2 is nearly periodic
     * with period 4. With rays, the host says which. */
    static const float picks[4][2] = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
    const float *pick = picks[(frames + frames / 4) % 4];
    block->gHistory[0] = (float)source->settings->history;
    for (int i = 0; i < 2; ++i)
        block->gRaysPick[i] = source->frame->rays_texture ? (float)source->frame->rays_offset[i] : 0.0f;
    for (int i = 0; i < 2 && source->settings->half_resolution; ++i)
        block->gPick[i] = source->frame->rays_texture ? block->gRaysPick[i] : pick[i];
    block->gTurns =
        source->frame->rays_texture && memcmp(h->rays_offset, source->frame->rays_offset, sizeof h->rays_offset) == 0
            ? 0.0f
            : 1.0f;
    if (frames == 0)
        return;
    double now[16];
    find_view(source, now);
    find_last_view(h->view, now, block->gLastView);
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
    h->margin = source->frame->margin;
    h->has_rays = source->frame->rays_texture != 0;
    memcpy(h->rays_offset, source->frame->rays_offset, sizeof h->rays_offset);
    h->is_orthographic = source->projection->is_orthographic;
    find_view(source, h->view);
    h->settings = *source->settings;
    memcpy(h->ray_origin, source->projection->ray_origin, sizeof h->ray_origin);
    memcpy(h->ray_direction, source->projection->ray_direction, sizeof h->ray_direction);
    h->region = *region;
}
