/* SPDX-License-Identifier: MIT
 *
 * One thread a picture and at most JOBS_AT_ONCE of them, so that memory stays bounded on a long turntable.
 */
#define _POSIX_C_SOURCE 200809L
#include "writer.h"

#include "clock.h"
#include "picture.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { JOBS_AT_ONCE = 4, PATH_LENGTH = 4096, ERROR_LENGTH = PATH_LENGTH + 256 };

typedef struct job {
    pthread_t thread;
    bool running; /* to be joined */
    char path[PATH_LENGTH];
    int width, height;
    pixel_kind kind;
    void *pixels;
    bool ok;
    double ms;
    char error[ERROR_LENGTH];
} job;

struct writer {
    job jobs[JOBS_AT_ONCE]; /* a ring: the next one is the oldest */
    int next;
    double ms;
    bool failed;
    char error[ERROR_LENGTH]; /* of the first failure */
};

static void *run_job(void *argument)
{
    job *j = argument;
    const double start = clock_wall_ms();
    if (j->kind == PIXELS_FLOAT) {
        j->ok = picture_write_pfm(j->path, j->width, j->height, 1, j->pixels, j->error, sizeof j->error);
    } else if (j->kind == PIXELS_GREY8) {
        j->ok = picture_write_png(j->path, j->width, j->height, 1, j->pixels, j->error, sizeof j->error);
    } else {
        uint8_t *pixels = j->pixels;
        const size_t count = (size_t)j->width * (size_t)j->height;
        for (size_t i = 1; i < count; i++) { /* in place: writing never overtakes reading */
            pixels[3 * i] = pixels[4 * i];
            pixels[3 * i + 1] = pixels[4 * i + 1];
            pixels[3 * i + 2] = pixels[4 * i + 2];
        }
        j->ok = picture_write_png(j->path, j->width, j->height, 3, pixels, j->error, sizeof j->error);
    }
    free(j->pixels);
    j->ms = clock_wall_ms() - start;
    return NULL;
}

static void take_result(writer *w, job *j)
{
    w->ms += j->ms;
    if (!j->ok && !w->failed) {
        w->failed = true;
        memcpy(w->error, j->error, sizeof w->error);
    }
}

static void join_job(writer *w, job *j)
{
    if (j->running) {
        pthread_join(j->thread, NULL);
        j->running = false;
        take_result(w, j);
    }
}

static bool result(const writer *w, char *error, size_t error_size)
{
    if (w->failed) {
        snprintf(error, error_size, "%s", w->error);
    }
    return !w->failed;
}

writer *writer_create(void)
{
    return calloc(1, sizeof(writer));
}

bool writer_submit(writer *w, const char *path, int width, int height, pixel_kind kind, void *pixels, char *error,
                   size_t error_size)
{
    job *j = &w->jobs[w->next];
    join_job(w, j);
    if (w->failed) {
        free(pixels);
        return result(w, error, error_size);
    }
    if (strlen(path) >= sizeof j->path) {
        free(pixels);
        snprintf(error, error_size, "%.100s...: the file name is too long", path);
        return false;
    }
    w->next = (w->next + 1) % JOBS_AT_ONCE;
    memcpy(j->path, path, strlen(path) + 1);
    j->width = width;
    j->height = height;
    j->kind = kind;
    j->pixels = pixels;
    j->running = pthread_create(&j->thread, NULL, run_job, j) == 0;
    if (!j->running) { /* no more threads: then here */
        run_job(j);
        take_result(w, j);
    }
    return result(w, error, error_size);
}

bool writer_finish(writer *w, double *out_ms, char *error, size_t error_size)
{
    for (int i = 0; i < JOBS_AT_ONCE; i++) {
        join_job(w, &w->jobs[(w->next + i) % JOBS_AT_ONCE]);
    }
    if (out_ms) {
        *out_ms = w->ms;
    }
    return result(w, error, error_size);
}

void writer_destroy(writer *w)
{
    if (w) {
        for (int i = 0; i < JOBS_AT_ONCE; i++) {
            join_job(w, &w->jobs[i]);
        }
        free(w);
    }
}
