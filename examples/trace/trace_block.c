/* SPDX-License-Identifier: MIT
 *
 * The rays of a block of 16 x 16 texels, in packets that are full but for the last of a block.
 */
#include "trace_picture.h"

#include <math.h>

enum { LEAST_ALIKE = 64 /* texels */ };

static bool has_surface(const float texel[4])
{
    const float square = texel[0] * texel[0] + texel[1] * texel[1] + texel[2] * texel[2];
    return texel[3] > 0 && texel[3] < 1e15f && square > 1e-20f && square < 1e20f;
}

static bool is_within(const trace_picture *p, int x, int y)
{
    const int m = p->seen.margin / p->seen.step;
    return x >= m && y >= m && x < p->width - m && y < p->height - m;
}

/* How many of the five texels in a row or column about this one lie on its surface, where the outer two count half: 1
 * to
 * 4. As the blur has it (glsl/shared/planar_blur.glsl): those that are on a line with two others. */
static float count_beside(const trace_picture *p, int x, int y, int across, int up)
{
    float at[5];
    for (int i = 0; i < 5; i++) {
        const int column = x + (i - 2) * across, row = y + (i - 2) * up;
        const int inside_x = column < 0 ? 0 : column < p->width ? column : p->width - 1;
        const int inside_y = row < 0 ? 0 : row < p->height ? row : p->height - 1;
        const float t = p->seen.rows[inside_y][inside_x][3];
        at[i] = p->lens.perspective > 0 ? 1 / t : t; /* is linear over a plane */
    }
    const float own = at[2], tolerance = 0.02f * p->radius * (p->lens.perspective > 0 ? own * own : 1);
    const bool before = fabsf(at[0] - 2 * at[1] + own) < tolerance, after = fabsf(at[4] - 2 * at[3] + own) < tolerance,
               line = fabsf(at[1] - 2 * own + at[3]) < tolerance;
    return 1 + 0.5f * (float)before + (float)(before || line) + (float)(after || line) + 0.5f * (float)after;
}

/* How many rays a texel of the picture is to get. */
static int rays_of(const trace_picture *p, int x, int y)
{
    const int at = y * p->width + x, usual = p->pattern.rays;
    const int rays = !is_within(p, x, y) ? 0 : p->counts ? p->counts[at] : usual;
    p->out[at] = -1;
    if (rays == 0 || !has_surface(p->seen.rows[y][x]))
        return 0;
    if (!p->adaptive)
        return rays < usual ? rays : usual;
    const float share = count_beside(p, x, y, 1, 0) * count_beside(p, x, y, 0, 1) / 16;
    return usual * (share < 0.2f ? 4 : share < 0.5f ? 2 : 1);
}

static float (*directions_of(const trace_pattern *p, int x, int y))[3]
{
    return p->directions + (y % p->side * p->side + x % p->side) * p->rays;
}

static void set_texel(const trace_picture *p, int x, int y, int rays, int i, trace_block *b)
{
    const float *texel = p->seen.rows[y][x];
    b->x[i] = (float)x;
    b->y[i] = (float)y;
    b->distance[i] = texel[3];
    for (int k = 0; k < 3; k++)
        b->normal[k][i] = texel[k];
    b->texel[i] = y * p->width + x;
    b->directions[i] = directions_of(&p->pattern, x, y);
    b->more[i] = p->adaptive ? directions_of(&p->more, x, y) : NULL;
    b->rays[i] = rays;
    b->blocked[i] = 0;
}

/* Ray number `k` of up to 16 texels of a block, which follow each other. */
static void trace_packet(const trace_picture *p, trace_block *b, int first, int count, int k)
{
    trace_query query = {.trace = p->trace};
    struct RTCRay16 rays;
    _Alignas(64) int valid[TRACE_PACKET];
    float x[TRACE_PACKET], y[TRACE_PACKET], z[TRACE_PACKET];
    embree_init_context(&query.embree);
    for (int i = 0; i < TRACE_PACKET; i++) {
        const float *d = k < p->pattern.rays ? b->directions[first + i][k] : b->more[first + i][k - p->pattern.rays];
        x[i] = d[0];
        y[i] = d[1];
        z[i] = d[2];
        valid[i] = i < count ? -1 : 0;
    }
    for (int i = 0; i < TRACE_PACKET; i++) {
        const int from = first + i;
        rays.org_x[i] = b->origin[0][from];
        rays.org_y[i] = b->origin[1][from];
        rays.org_z[i] = b->origin[2][from];
        rays.dir_x[i] = x[i] * b->u[0][from] + y[i] * b->v[0][from] + z[i] * b->normal[0][from];
        rays.dir_y[i] = x[i] * b->u[1][from] + y[i] * b->v[1][from] + z[i] * b->normal[1][from];
        rays.dir_z[i] = x[i] * b->u[2][from] + y[i] * b->v[2][from] + z[i] * b->normal[2][from];
        rays.tnear[i] = 0;
        rays.tfar[i] = p->radius;
        rays.time[i] = 0;
        rays.mask[i] = UINT32_MAX;
        rays.id[i] = (unsigned)i;
        rays.flags[i] = 0;
    }
    embree_occluded(p->trace->world, &query.embree, valid, &rays);
    for (int i = 0; i < count; i++)
        b->blocked[first + i] += rays.tfar[i] < 0;
}

/* Fills the block with the texels that get rays. Those with one place in their 4 x 4 follow each other, since their
 * rays point nearly the same way; where counts differ, those with most rays come first. Copies of any texel fill up the
 * last packet, whose lanes are not all valid. */
static void fill_block(const trace_picture *p, int left, int bottom, trace_block *b)
{
    uint8_t counts[BLOCK_TEXELS];
    int most = 0, least = MOST_RAYS, texels = 0;
    for (int y = bottom; y < bottom + BLOCK && y < p->height; y++)
        for (int x = left; x < left + BLOCK && x < p->width; x++) {
            const int rays = rays_of(p, x, y);
            counts[(y - bottom) * BLOCK + x - left] = (uint8_t)rays;
            most = rays > most ? rays : most;
            least = rays > 0 && rays < least ? rays : least;
            texels += rays > 0;
        }
    b->count = 0;
    for (int rays = most; rays >= least && b->count < texels; rays--)
        for (int place = 0; place < 16; place++)
            for (int y = bottom + place / 4; y < bottom + BLOCK && y < p->height; y += 4)
                for (int x = left + place % 4; x < left + BLOCK && x < p->width; x += 4)
                    if (counts[(y - bottom) * BLOCK + x - left] == rays)
                        set_texel(p, x, y, rays, b->count++, b);
    for (int i = b->count; i % TRACE_PACKET; i++)
        set_texel(p, b->texel[0] % p->width, b->texel[0] / p->width, 0, i, b);
}

/* Whether the first `rays` rays of all texels of a block say the same. More of them would hardly say anything else: 256
 * rays agree by chance where one in 256 does not, in one case of three, and a mean is off by 0.0014 at most. */
static bool do_agree(trace_block *b, int rays)
{
    int blocked = 0;
    for (int i = 0; i < b->count; i++)
        blocked += b->blocked[i];
    const bool agree = b->count >= LEAST_ALIKE && (blocked == 0 || blocked == rays * b->count);
    for (int i = 0; agree && i < b->count; i++)
        b->rays[i] = rays;
    return agree;
}

uint64_t trace_block_run(const trace_picture *p, int number)
{
    trace_block b;
    uint64_t rays = 0;
    fill_block(p, number % p->blocks_across * BLOCK, number / p->blocks_across * BLOCK, &b);
    const int lanes = (b.count + TRACE_PACKET - 1) / TRACE_PACKET * TRACE_PACKET;
    trace_lens_place(&p->lens, p->radius, lanes, &b);
    const int first = p->pattern.rays < 8 ? 1 : p->pattern.rays / 4;
    int count = b.count;
    for (int k = 0; count > 0; k++) {
        while (count > 0 && b.rays[count - 1] <= k)
            count--;
        for (int i = 0; i < count; i += TRACE_PACKET)
            trace_packet(p, &b, i, count - i < TRACE_PACKET ? count - i : TRACE_PACKET, k);
        if (p->adaptive && k + 1 == first && do_agree(&b, first))
            break;
    }
    for (int i = 0; i < b.count; i++) {
        p->out[b.texel[i]] = 1 - (float)b.blocked[i] / (float)b.rays[i];
        rays += (uint64_t)b.rays[i];
    }
    return rays;
}
