/* SPDX-License-Identifier: MIT
 *
 * Keeps the projections that a program's matrices were made with, frame by frame, and chooses among them.
 */
#include "inject.h"

#include <math.h>
#include <pthread.h>

enum { CANDIDATES = 16, FRAMES_OF_PERSPECTIVE = 60, MOST_BUFFER = 65536 };

typedef struct candidate {
    inject_projection projection;
    unsigned framebuffer;
    int count;
} candidate;

static candidate seen[CANDIDATES];
static candidate last; /* the window's, of an earlier frame; count 0: none yet */
static int frames_without_perspective;
static bool clip_zero_to_one;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static bool is_perspective(const candidate *c)
{
    return c->projection.matrix[11] != 0.0f;
}

static bool alike(const inject_projection *a, const inject_projection *b)
{
    static const int numbers[] = {0, 5, 8, 9, 10, 11, 14};
    for (int i = 0; i < 7; ++i) {
        const float x = a->matrix[numbers[i]], y = b->matrix[numbers[i]];
        if (fabsf(x - y) > 2e-3f * (fabsf(x) + 1e-3f))
            return false;
    }
    return a->zero_to_one == b->zero_to_one;
}

static bool note(const float m[16], unsigned framebuffer)
{
    candidate found = {.framebuffer = framebuffer, .projection.zero_to_one = clip_zero_to_one};
    if (!inject_perspective_of(m, clip_zero_to_one, found.projection.matrix) &&
        !inject_orthographic_of(m, clip_zero_to_one, found.projection.matrix))
        return false;
    for (int i = 0; i < CANDIDATES; ++i) {
        if (seen[i].count > 0 && (seen[i].framebuffer != framebuffer || !alike(&seen[i].projection, &found.projection)))
            continue;
        found.count = seen[i].count + 1;
        seen[i] = found;
        break;
    }
    return true;
}

void inject_note_matrix(const float m[16], unsigned framebuffer)
{
    pthread_mutex_lock(&lock);
    note(m, framebuffer);
    pthread_mutex_unlock(&lock);
}

void inject_note_buffer(const void *data, size_t size)
{
    enum { COLUMN = 16, MATRIX = 64 }; /* bytes, by std140 */
    pthread_mutex_lock(&lock);
    for (size_t at = 0; at + MATRIX <= size && at < MOST_BUFFER; at += COLUMN) {
        float m[16], turned[16];
        memcpy(m, (const char *)data + at, MATRIX);
        for (int i = 0; i < 16; ++i)
            turned[i] = m[4 * (i % 4) + i / 4]; /* row_major */
        if (note(m, INJECT_ANY_FRAMEBUFFER) || note(turned, INJECT_ANY_FRAMEBUFFER))
            at += MATRIX - COLUMN;
    }
    pthread_mutex_unlock(&lock);
}

void inject_note_clip_control(bool zero_to_one)
{
    pthread_mutex_lock(&lock);
    clip_zero_to_one = zero_to_one;
    pthread_mutex_unlock(&lock);
}

/* By kind, then by how many matrices. */
static bool is_better(const candidate *a, const candidate *b)
{
    return !b || (is_perspective(a) != is_perspective(b) ? is_perspective(a) : a->count > b->count);
}

bool inject_get_projection(unsigned framebuffer, inject_projection *out)
{
    pthread_mutex_lock(&lock);
    const candidate *best = NULL;
    bool elsewhere = false;
    for (int i = 0; i < CANDIDATES && seen[i].count > 0; ++i) {
        if (seen[i].framebuffer != framebuffer && seen[i].framebuffer != INJECT_ANY_FRAMEBUFFER)
            elsewhere = true;
        else if (is_better(&seen[i], best))
            best = &seen[i];
    }
    const bool window = framebuffer == 0, has_last = window && last.count > 0;
    if (best && has_last && is_perspective(&last) && !is_perspective(best) &&
        frames_without_perspective < FRAMES_OF_PERSPECTIVE)
        best = &last; /* an interface over a scene whose matrices stay the same */
    if (best && window)
        last = *best;
    if (!best && has_last && !elsewhere)
        best = &last;
    if (best)
        *out = best->projection;
    pthread_mutex_unlock(&lock);
    return best != NULL;
}

void inject_end_frame(void)
{
    pthread_mutex_lock(&lock);
    ++frames_without_perspective;
    for (int i = 0; i < CANDIDATES && seen[i].count > 0; ++i)
        if (is_perspective(&seen[i]))
            frames_without_perspective = 0;
    memset(seen, 0, sizeof seen);
    pthread_mutex_unlock(&lock);
}
