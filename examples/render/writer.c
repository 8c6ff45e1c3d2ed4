/* SPDX-License-Identifier: MIT
 *
 * A queue with a limit on pictures and bytes. Threads are started as pictures wait, at most one for each core that this
 * process may use.
 */
#define _GNU_SOURCE /* sched_getaffinity */
#include "writer.h"

#include "clock.h"
#include "fault.h"
#include "picture.h"

#include <pthread.h>
#include <sched.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_THREADS = 64, QUEUE_LENGTH = 2 * MOST_THREADS };
static const size_t most_bytes = (size_t)512 << 20; /* a larger picture waits until the queue is empty */

typedef struct entry {
    char *path;
    int width, height;
    pixel_kind kind;
    void *pixels;
    writer_slip *slip;
} entry;

struct writer {
    pthread_mutex_t lock;
    pthread_cond_t changed; /* signals changes of the members below and of slips */
    entry queue[QUEUE_LENGTH];
    int first, length, limit;
    size_t bytes; /* pictures in the queue and in the threads */
    bool ending;
    pthread_t threads[MOST_THREADS];
    int thread_count, idle, wanted;
};

/* Slurm and container runtimes may give a job fewer cores than the machine has. */
static int count_cores(void)
{
    cpu_set_t set;
    const int count = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 2;
    return count < 1 ? 1 : count > MOST_THREADS ? MOST_THREADS : count;
}

static size_t pixel_bytes(const entry *e)
{
    return (size_t)e->width * (size_t)e->height * (e->kind == PIXELS_GREY8 ? 1 : 4);
}

static bool encode(const entry *e, failure *why)
{
    if (e->kind == PIXELS_FLOAT)
        return picture_write_pfm(e->path, e->width, e->height, 1, e->pixels, why);
    if (e->kind == PIXELS_GREY8)
        return picture_write(e->path, e->width, e->height, 1, e->pixels, why);
    if (e->kind == PIXELS_RGBA8_STRAIGHT)
        return picture_write(e->path, e->width, e->height, 4, e->pixels, why);
    uint8_t *pixels = e->pixels;
    const size_t count = (size_t)e->width * (size_t)e->height;
    for (size_t i = 1; i < count; i++) { /* in place: the write position is never ahead of the read position */
        pixels[3 * i] = pixels[4 * i];
        pixels[3 * i + 1] = pixels[4 * i + 1];
        pixels[3 * i + 2] = pixels[4 * i + 2];
    }
    return picture_write(e->path, e->width, e->height, 3, pixels, why);
}

/* Call with the lock held. */
static void note(writer *w, writer_slip *slip, bool ok, const char *error)
{
    slip->pending--;
    slip->written += ok;
    if (!ok && !slip->failed) {
        slip->failed = true;
        snprintf(slip->error, sizeof slip->error, "%s", error);
    }
    pthread_cond_broadcast(&w->changed);
}

/* Call with the lock held. It is released during the work and held again afterwards. */
static void work_on(writer *w, entry e)
{
    char error[sizeof e.slip->error] = "";
    pthread_mutex_unlock(&w->lock);
    const double start = clock_wall_ms();
    const bool ok = e.path && encode(&e, FAULT(error));
    const double ms = clock_wall_ms() - start;
    free(e.pixels);
    free(e.path);
    pthread_mutex_lock(&w->lock);
    w->bytes -= pixel_bytes(&e);
    e.slip->ms += ms;
    note(w, e.slip, ok, e.path ? error : "out of memory");
}

static entry take_first(writer *w)
{
    const entry e = w->queue[w->first];
    w->first = (w->first + 1) % QUEUE_LENGTH;
    w->length--;
    return e;
}

static void *run_thread(void *argument)
{
    writer *w = argument;
    pthread_mutex_lock(&w->lock);
    while (w->length || !w->ending) {
        if (w->length) {
            work_on(w, take_first(w));
        } else {
            w->idle++;
            pthread_cond_wait(&w->changed, &w->lock);
            w->idle--;
        }
    }
    pthread_mutex_unlock(&w->lock);
    return NULL;
}

writer *writer_create(void)
{
    writer *w = calloc(1, sizeof *w);
    if (!w)
        return NULL;
    pthread_mutex_init(&w->lock, NULL);
    pthread_cond_init(&w->changed, NULL);
    w->wanted = count_cores();
    w->limit = 2 * w->wanted;
    return w;
}

void writer_destroy(writer *w)
{
    if (!w)
        return;
    pthread_mutex_lock(&w->lock);
    w->ending = true;
    pthread_cond_broadcast(&w->changed);
    pthread_mutex_unlock(&w->lock);
    for (int i = 0; i < w->thread_count; i++)
        pthread_join(w->threads[i], NULL);
    pthread_cond_destroy(&w->changed);
    pthread_mutex_destroy(&w->lock);
    free(w);
}

void writer_expect(writer *w, writer_slip *slip)
{
    pthread_mutex_lock(&w->lock);
    slip->pending++;
    pthread_mutex_unlock(&w->lock);
}

void writer_submit(writer *w, writer_slip *slip, const char *path, int width, int height, pixel_kind kind, void *pixels)
{
    const size_t length = strlen(path) + 1;
    entry e = {.path = malloc(length), .width = width, .height = height, .kind = kind, .pixels = pixels, .slip = slip};
    if (e.path)
        memcpy(e.path, path, length);
    pthread_mutex_lock(&w->lock);
    while (w->thread_count && w->bytes && (w->length >= w->limit || w->bytes + pixel_bytes(&e) > most_bytes))
        pthread_cond_wait(&w->changed, &w->lock);
    w->bytes += pixel_bytes(&e);
    if (w->length >= w->idle && w->thread_count < w->wanted &&
        pthread_create(&w->threads[w->thread_count], NULL, run_thread, w) == 0)
        w->thread_count++;
    if (w->thread_count) {
        w->queue[(w->first + w->length++) % QUEUE_LENGTH] = e;
        pthread_cond_broadcast(&w->changed);
    } else { /* without another thread, work on this one */
        work_on(w, e);
    }
    pthread_mutex_unlock(&w->lock);
}

void writer_give_up(writer *w, writer_slip *slip, const char *error)
{
    pthread_mutex_lock(&w->lock);
    note(w, slip, false, error);
    pthread_mutex_unlock(&w->lock);
}

bool writer_wait(writer *w, writer_slip *slip)
{
    pthread_mutex_lock(&w->lock);
    while (slip->pending)
        pthread_cond_wait(&w->changed, &w->lock);
    const bool ok = !slip->failed;
    pthread_mutex_unlock(&w->lock);
    return ok;
}

bool writer_is_done(writer *w, writer_slip *slip)
{
    pthread_mutex_lock(&w->lock);
    const bool done = slip->pending == 0;
    pthread_mutex_unlock(&w->lock);
    return done;
}

bool writer_has_failed(writer *w, writer_slip *slip)
{
    pthread_mutex_lock(&w->lock);
    const bool failed = slip->failed;
    pthread_mutex_unlock(&w->lock);
    return failed;
}
