/* SPDX-License-Identifier: MIT
 *
 * Keeps the projections that a program's matrices were made with, frame by frame, and chooses among them.
 */
#include "inject.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>

enum { CANDIDATES = 32, FRAMES_OF_PERSPECTIVE = 60, MOST_BUFFER = 65536 };
static const double SECONDS_OF_PERSPECTIVE = 1.0;

typedef struct candidate {
    inject_projection projection;
    inject_place place;
    bool anywhere; /* from a uniform buffer: whichever framebuffer is drawn with it */
    int count;     /* matrices; 0: unused */
    float weight;  /* depth written under it */
} candidate;

/* What a window keeps between frames. */
typedef struct window {
    struct window *next;
    void *context;
    candidate last;
    int frames; /* since its last frame with perspective */
    double time;
} window;

static candidate seen[CANDIDATES];
static int latest = -1; /* index of the candidate noted last; -1: none in this frame */
static window *windows;
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

static bool is_at(const candidate *c, inject_place place)
{
    return c->anywhere || (c->place.context == place.context && c->place.framebuffer == place.framebuffer);
}

/* `place` NULL: anywhere. */
static bool note(const float m[16], const inject_place *place)
{
    candidate found = {.anywhere = !place, .projection.zero_to_one = clip_zero_to_one};
    if (place)
        found.place = *place;
    if (!inject_perspective_of(m, clip_zero_to_one, found.projection.matrix) &&
        !inject_orthographic_of(m, clip_zero_to_one, found.projection.matrix))
        return false;
    for (int i = 0; i < CANDIDATES; ++i) {
        candidate *const c = &seen[i];
        if (c->count > 0 &&
            (c->anywhere != found.anywhere || !is_at(c, found.place) || !alike(&c->projection, &found.projection)))
            continue;
        found.count = c->count + 1;
        found.weight = c->weight;
        *c = found;
        latest = i;
        return true;
    }
    return true;
}

void inject_note_matrix(const float m[16], inject_place place)
{
    pthread_mutex_lock(&lock);
    note(m, &place);
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
        if (note(m, NULL) || note(turned, NULL))
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

void inject_note_draw(inject_place place, float weight)
{
    pthread_mutex_lock(&lock);
    if (latest >= 0 && is_at(&seen[latest], place))
        seen[latest].weight += weight;
    pthread_mutex_unlock(&lock);
}

static window *window_of(void *context)
{
    window *w = windows;
    while (w && w->context != context)
        w = w->next;
    if (!w && (w = calloc(1, sizeof *w))) {
        *w = (window){.next = windows, .context = context};
        windows = w;
    }
    return w;
}

/* By kind, then by the depth written, then by the number of matrices. */
static bool is_better(const candidate *a, const candidate *b)
{
    if (!b || is_perspective(a) != is_perspective(b))
        return !b || is_perspective(a);
    return a->weight != b->weight ? a->weight > b->weight : a->count > b->count;
}

bool inject_get_projection(inject_place place, inject_projection *out)
{
    pthread_mutex_lock(&lock);
    const candidate *best = NULL;
    bool elsewhere = false;
    for (int i = 0; i < CANDIDATES && seen[i].count > 0; ++i) {
        if (is_at(&seen[i], place))
            best = is_better(&seen[i], best) ? &seen[i] : best;
        else if (seen[i].place.context == place.context)
            elsewhere = true;
    }
    window *const w = place.framebuffer == 0 ? window_of(place.context) : NULL;
    if (w && w->last.count > 0) {
        const bool is_recent =
            w->frames <= FRAMES_OF_PERSPECTIVE && inject_seconds() - w->time < SECONDS_OF_PERSPECTIVE;
        if (best && is_perspective(&w->last) && !is_perspective(best) && is_recent)
            best = &w->last; /* an interface over a scene whose matrices stay the same */
        else if (!best && !elsewhere)
            best = &w->last;
    }
    if (w && best && best != &w->last) {
        w->last = *best;
        if (is_perspective(best)) {
            w->frames = 0;
            w->time = inject_seconds();
        }
    }
    if (best)
        *out = best->projection;
    pthread_mutex_unlock(&lock);
    return best != NULL;
}

void inject_end_frame(void)
{
    pthread_mutex_lock(&lock);
    for (window *w = windows; w; w = w->next)
        ++w->frames;
    memset(seen, 0, sizeof seen);
    latest = -1;
    pthread_mutex_unlock(&lock);
}

void inject_forget_projections(void *context)
{
    pthread_mutex_lock(&lock);
    for (window **at = &windows; *at; at = &(*at)->next)
        if ((*at)->context == context) {
            window *const gone = *at;
            *at = gone->next;
            free(gone);
            break;
        }
    for (int i = 0; i < CANDIDATES; ++i)
        if (seen[i].place.context == context)
            seen[i].weight = 0.0f; /* the rest is forgotten with the frame */
    pthread_mutex_unlock(&lock);
}
