/* SPDX-License-Identifier: MIT
 *
 * Pictures whose surfaces a rasteriser found. Threads take blocks of 16 x 16 texels from the bottom up, as far as
 * texels have come. All in single precision, and in packets that are full but for the last of a block.
 */
#define _POSIX_C_SOURCE 200809L
#include "clock.h"
#include "trace_internal.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { BLOCK = 16, BLOCK_TEXELS = BLOCK * BLOCK, MOST_RAYS = 64, MOST_THREADS = 256, LEAST_ALIKE = 64 /* texels */ };

/* How a texel leads to a point in the world, and how far off that may be. */
typedef struct lens {
    float ndc[2][2];          /* x: ndc = column * [0] + [1]; y the same */
    float scale[2];           /* view x = scale (ndc w - shift[0] + shift[1] distance); y the same */
    float shift[2][2];        /* [x or y] */
    float w[2];               /* clip w = w[0] - w[1] distance */
    float depth_error;        /* view distance, per w^2 */
    float view_from_world[9]; /* rotation, columns of three */
    float eye[3];             /* in the world */
    float perspective;        /* 1, or 0 in an orthographic projection */
} lens;

struct trace_picture {
    const trace_scene *trace;
    lens lens;
    trace_seen seen;
    const uint8_t *counts;
    int width, height; /* texels */
    int blocks_across;
    float radius;
    float *out;
    trace_pattern pattern, more; /* more: where a texel gets more rays than options->samples */
    bool adaptive;
    bool (*stopped)(void *user);
    void *stopped_user;
    double start_ms;
    pthread_mutex_t lock; /* of the members below */
    pthread_cond_t fed;
    int rows, next, rays_known;
    bool is_stopped, is_ending;
    uint64_t rays;
    pthread_t threads[MOST_THREADS];
    int thread_count;
};

/* The texels of a block that show a surface. Arrays of one number each, so that compilers make vector code. */
typedef struct block {
    int count;
    int texel[BLOCK_TEXELS]; /* index in the picture */
    float (*directions[BLOCK_TEXELS])[3], (*more[BLOCK_TEXELS])[3];
    int rays[BLOCK_TEXELS], blocked[BLOCK_TEXELS];
    float x[BLOCK_TEXELS], y[BLOCK_TEXELS], distance[BLOCK_TEXELS];
    float origin[3][BLOCK_TEXELS], normal[3][BLOCK_TEXELS]; /* the normal in view space, then a unit one in the world */
    float u[3][BLOCK_TEXELS], v[3][BLOCK_TEXELS];           /* a frame with the normal */
} block;

static bool open_lens(const scene_view *view, const trace_seen *seen, lens *out)
{
    const float *c = view->clip_from_view, *v = view->view_from_world;
    const int size[2] = {view->width, view->height};
    for (int i = 0; i < 2; i++) {
        out->ndc[i][0] = (float)(2.0 * seen->step / size[i]);
        out->ndc[i][1] = (float)(1.0 / size[i] - 1);
        out->scale[i] = 1 / c[5 * i];
        out->shift[i][0] = c[12 + i];
        out->shift[i][1] = c[8 + i];
    }
    out->w[0] = c[15];
    out->w[1] = c[11];
    out->perspective = fabsf(c[11]) > 0;
    /* ndc z = (c10 z + c14) / w: its derivative is (c10 w - c11 (c10 z + c14)) / w^2, and depth is half of it. A
     * rasteriser rounds depth more than once: measured, the surface lies up to four steps from it. */
    const double slope = (double)c[10] * (double)c[15] - (double)c[11] * (double)c[14];
    out->depth_error = (float)(4 * 2 * seen->depth_step / fabs(slope));
    for (int k = 0; k < 3; k++) {
        double eye = 0;
        for (int r = 0; r < 3; r++) {
            out->view_from_world[3 * k + r] = v[4 * k + r];
            eye -= (double)v[4 * k + r] * (double)v[12 + r];
        }
        out->eye[k] = (float)eye;
    }
    return isfinite(out->depth_error) && isfinite(out->scale[0] * out->scale[1]);
}

static inline float least(float a, float b)
{
    return a < b ? a : b;
}

/* Unit normals, and frames about them: Duff et al., "Building an orthonormal basis, revisited", JCGT 2017. */
static void turn_normals(const lens *l, int count, block *b)
{
    const float *m = l->view_from_world;
    for (int i = 0; i < count; i++) {
        const float nx = b->normal[0][i], ny = b->normal[1][i], nz = b->normal[2][i];
        const float unit = 1 / sqrtf(nx * nx + ny * ny + nz * nz);
        const float x = unit * (m[0] * nx + m[1] * ny + m[2] * nz);
        const float y = unit * (m[3] * nx + m[4] * ny + m[5] * nz);
        const float z = unit * (m[6] * nx + m[7] * ny + m[8] * nz);
        const float sign = z < 0 ? -1.0f : 1.0f, a = -1 / (sign + z), xy = x * y * a;
        b->normal[0][i] = x;
        b->normal[1][i] = y;
        b->normal[2][i] = z;
        b->u[0][i] = 1 + sign * x * x * a;
        b->u[1][i] = sign * xy;
        b->u[2][i] = -sign * x;
        b->v[0][i] = xy;
        b->v[1][i] = sign + y * y * a;
        b->v[2][i] = -y;
    }
}

/* Where rays start: off the surface along the normal, by as much as the rasteriser's depth may be off along the ray
 * from the eye; by a 16th of a pixel, since corners are snapped to pixels' 256ths and shading normals are not the
 * triangles' own; and by what single precision loses. */
static void find_origins(const lens *l, float radius, int count, block *b)
{
    const float *m = l->view_from_world;
    for (int i = 0; i < count; i++) {
        const float t = b->distance[i], w = l->w[0] - l->w[1] * t;
        const float ndc_x = b->x[i] * l->ndc[0][0] + l->ndc[0][1], ndc_y = b->y[i] * l->ndc[1][0] + l->ndc[1][1];
        const float x = l->scale[0] * (ndc_x * w - l->shift[0][0] + l->shift[0][1] * t);
        const float y = l->scale[1] * (ndc_y * w - l->shift[1][0] + l->shift[1][1] * t);
        const float nx = b->normal[0][i], ny = b->normal[1][i], nz = b->normal[2][i];
        /* The ray from the surface to the eye, of view distance 1. */
        const float to_eye = l->perspective / t;
        const float toward = (nz - to_eye * (nx * x + ny * y)) / sqrtf(nx * nx + ny * ny + nz * nz);
        const float depth_error = l->depth_error * w * w * fabsf(toward);
        const float pixel = fabsf(l->ndc[1][0] * l->scale[1] * w);
        const float point[3] = {l->eye[0] + m[0] * x + m[1] * y - m[2] * t, l->eye[1] + m[3] * x + m[4] * y - m[5] * t,
                                l->eye[2] + m[6] * x + m[7] * y - m[8] * t};
        const float size = fabsf(point[0]) + fabsf(point[1]) + fabsf(point[2]) + fabsf(t);
        const float offset = least(depth_error + pixel / 16 + 0x1p-20f * size, 0.25f * radius);
        for (int k = 0; k < 3; k++) {
            b->origin[k][i] = point[k];
        }
        b->distance[i] = offset;
    }
}

static void move_origins(int count, block *b)
{
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < count; i++) {
            b->origin[k][i] += b->distance[i] * b->normal[k][i];
        }
    }
}

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
    if (rays == 0 || !has_surface(p->seen.rows[y][x])) {
        return 0;
    }
    if (!p->adaptive) {
        return rays < usual ? rays : usual;
    }
    const float share = count_beside(p, x, y, 1, 0) * count_beside(p, x, y, 0, 1) / 16;
    return usual * (share < 0.2f ? 4 : share < 0.5f ? 2 : 1);
}

static float (*directions_of(const trace_pattern *p, int x, int y))[3]
{
    return p->directions + (y % p->side * p->side + x % p->side) * p->rays;
}

static void set_texel(const trace_picture *p, int x, int y, int rays, int i, block *b)
{
    const float *texel = p->seen.rows[y][x];
    b->x[i] = (float)x;
    b->y[i] = (float)y;
    b->distance[i] = texel[3];
    for (int k = 0; k < 3; k++) {
        b->normal[k][i] = texel[k];
    }
    b->texel[i] = y * p->width + x;
    b->directions[i] = directions_of(&p->pattern, x, y);
    b->more[i] = p->adaptive ? directions_of(&p->more, x, y) : NULL;
    b->rays[i] = rays;
    b->blocked[i] = 0;
}

/* Ray number `k` of up to 16 texels of a block, which follow each other. */
static void trace_packet(const trace_picture *p, block *b, int first, int count, int k)
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
    for (int i = 0; i < count; i++) {
        b->blocked[first + i] += rays.tfar[i] < 0;
    }
}

/* Fills the block with the texels that get rays. Those with one place in their 4 x 4 follow each other, since their
 * rays point nearly the same way; where counts differ, those with most rays come first. Copies of any texel fill up the
 * last packet, whose lanes are not all valid. */
static void fill_block(const trace_picture *p, int left, int bottom, block *b)
{
    uint8_t counts[BLOCK_TEXELS];
    int most = 0, least = MOST_RAYS, texels = 0;
    for (int y = bottom; y < bottom + BLOCK && y < p->height; y++) {
        for (int x = left; x < left + BLOCK && x < p->width; x++) {
            const int rays = rays_of(p, x, y);
            counts[(y - bottom) * BLOCK + x - left] = (uint8_t)rays;
            most = rays > most ? rays : most;
            least = rays > 0 && rays < least ? rays : least;
            texels += rays > 0;
        }
    }
    b->count = 0;
    for (int rays = most; rays >= least && b->count < texels; rays--) {
        for (int place = 0; place < 16; place++) {
            for (int y = bottom + place / 4; y < bottom + BLOCK && y < p->height; y += 4) {
                for (int x = left + place % 4; x < left + BLOCK && x < p->width; x += 4) {
                    if (counts[(y - bottom) * BLOCK + x - left] == rays) {
                        set_texel(p, x, y, rays, b->count++, b);
                    }
                }
            }
        }
    }
    for (int i = b->count; i % TRACE_PACKET; i++) {
        set_texel(p, b->texel[0] % p->width, b->texel[0] / p->width, 0, i, b);
    }
}

/* Whether the first `rays` rays of all texels of a block say the same. More of them would hardly say anything else: 256
 * rays agree by chance where one in 256 does not, in one case of three, and a mean is off by 0.0014 at most. */
static bool do_agree(block *b, int rays)
{
    int blocked = 0;
    for (int i = 0; i < b->count; i++) {
        blocked += b->blocked[i];
    }
    const bool agree = b->count >= LEAST_ALIKE && (blocked == 0 || blocked == rays * b->count);
    for (int i = 0; agree && i < b->count; i++) {
        b->rays[i] = rays;
    }
    return agree;
}

/* The number of rays that were traced. */
static uint64_t trace_block(const trace_picture *p, int number)
{
    block b;
    uint64_t rays = 0;
    fill_block(p, number % p->blocks_across * BLOCK, number / p->blocks_across * BLOCK, &b);
    const int lanes = (b.count + TRACE_PACKET - 1) / TRACE_PACKET * TRACE_PACKET;
    find_origins(&p->lens, p->radius, lanes, &b);
    turn_normals(&p->lens, lanes, &b);
    move_origins(lanes, &b);
    const int first = p->pattern.rays < 8 ? 1 : p->pattern.rays / 4;
    int count = b.count;
    for (int k = 0; count > 0; k++) {
        while (count > 0 && b.rays[count - 1] <= k) {
            count--;
        }
        for (int i = 0; i < count; i += TRACE_PACKET) {
            trace_packet(p, &b, i, count - i < TRACE_PACKET ? count - i : TRACE_PACKET, k);
        }
        if (p->adaptive && k + 1 == first && do_agree(&b, first)) {
            break;
        }
    }
    for (int i = 0; i < b.count; i++) {
        p->out[b.texel[i]] = 1 - (float)b.blocked[i] / (float)b.rays[i];
        rays += (uint64_t)b.rays[i];
    }
    return rays;
}

/* Takes blocks until none is left; waits for texels if `patient`. */
static void take_blocks(trace_picture *p, bool patient)
{
    const int blocks = p->blocks_across * ((p->height + BLOCK - 1) / BLOCK);
    pthread_mutex_lock(&p->lock);
    for (;;) {
        const int beyond = (p->next / p->blocks_across + 1) * BLOCK + (p->adaptive ? 2 : 0),
                  needed = beyond < p->height ? beyond : p->height;
        if (p->next >= blocks || p->is_stopped) {
            break;
        }
        if (p->rows < needed) {
            if (!patient || p->is_ending) {
                break;
            }
            pthread_cond_wait(&p->fed, &p->lock);
            continue;
        }
        const int number = p->next++;
        pthread_mutex_unlock(&p->lock);
        const bool stop = p->stopped && p->stopped(p->stopped_user);
        const uint64_t rays = stop ? 0 : trace_block(p, number);
        pthread_mutex_lock(&p->lock);
        p->is_stopped |= stop;
        p->rays += rays;
    }
    pthread_mutex_unlock(&p->lock);
}

static void *run_thread(void *argument)
{
    take_blocks(argument, true);
    return NULL;
}

trace_picture *trace_picture_begin(const trace_scene *t, const scene_view *view, const trace_seen *seen,
                                   const uint8_t *counts, const trace_options *options, float *out, char *error,
                                   size_t error_size)
{
    const int most = options->adaptive ? MOST_RAYS / 4 : MOST_RAYS;
    if (options->samples < 1 || options->samples > most || !(options->radius >= 0)) {
        snprintf(error, error_size, "%d rays within a radius of %g: out of range", options->samples,
                 (double)options->radius);
        return NULL;
    }
    trace_picture *p = calloc(1, sizeof *p);
    const int more = options->adaptive ? 3 * options->samples : 0;
    if (!p || !trace_pattern_open(&p->pattern, options->samples, options->seed) ||
        (more > 0 && !trace_pattern_open(&p->more, more, ~options->seed))) {
        snprintf(error, error_size, "out of memory");
        free(p);
        return NULL;
    }
    p->adaptive = options->adaptive;
    p->trace = t;
    p->seen = *seen;
    p->counts = counts;
    p->out = out;
    p->width = (view->width + seen->step - 1) / seen->step;
    p->height = (view->height + seen->step - 1) / seen->step;
    p->blocks_across = (p->width + BLOCK - 1) / BLOCK;
    p->radius = options->radius;
    p->stopped = options->stopped;
    p->stopped_user = options->stopped_user;
    p->start_ms = clock_wall_ms();
    if (!open_lens(view, seen, &p->lens)) {
        snprintf(error, error_size, "the view's matrices have no inverse");
        trace_pattern_close(&p->pattern);
        trace_pattern_close(&p->more);
        free(p);
        return NULL;
    }
    pthread_mutex_init(&p->lock, NULL);
    pthread_cond_init(&p->fed, NULL);
    const int threads = options->threads > 0 ? options->threads : (int)sysconf(_SC_NPROCESSORS_ONLN);
    while (p->thread_count + 1 < threads && p->thread_count < MOST_THREADS &&
           pthread_create(&p->threads[p->thread_count], NULL, run_thread, p) == 0) {
        p->thread_count++;
    }
    return p;
}

void trace_picture_feed(trace_picture *p, int rows)
{
    pthread_mutex_lock(&p->lock);
    p->rows = rows;
    pthread_cond_broadcast(&p->fed);
    pthread_mutex_unlock(&p->lock);
}

bool trace_picture_end(trace_picture *p, trace_stats *out_stats)
{
    pthread_mutex_lock(&p->lock);
    p->is_ending = true; /* rows that have not come are not waited for */
    pthread_cond_broadcast(&p->fed);
    pthread_mutex_unlock(&p->lock);
    take_blocks(p, false);
    for (int i = 0; i < p->thread_count; i++) {
        pthread_join(p->threads[i], NULL);
    }
    const bool done = !p->is_stopped;
    if (out_stats) {
        *out_stats = (trace_stats){.rays = p->rays, .seconds = (clock_wall_ms() - p->start_ms) * 1e-3};
    }
    pthread_cond_destroy(&p->fed);
    pthread_mutex_destroy(&p->lock);
    trace_pattern_close(&p->pattern);
    trace_pattern_close(&p->more);
    free(p);
    return done;
}
