/* SPDX-License-Identifier: MIT
 *
 * The checks of what is handed in, and the thread that an engine lives on. A thread, because a context can only be
 * current on one at a time and must not take the place of a caller's own.
 */
#include "occlude.h"

#include "engine.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

typedef struct job {
    const occlude_input *input;
    const glssao_settings *settings;
    float *out_accessibility;
    char *error;
    size_t error_size;
    bool ok;
} job;

struct occlude {
    pthread_t thread;
    pthread_mutex_t callers; /* one at a time */
    sem_t wanted, done;      /* a job is there; the thread is through with it, or with starting */
    job *job;                /* NULL: the thread ends */
    engine *engine;          /* the thread's own */
    uint32_t seed;
    pid_t process;
};

static void wait_for(sem_t *semaphore)
{
    while (sem_wait(semaphore) != 0 && errno == EINTR) {
    }
}

static void *run_thread(void *argument)
{
    occlude *o = argument;
    o->engine = engine_create(o->seed, o->job->error, o->job->error_size);
    sem_post(&o->done);
    if (!o->engine)
        return NULL;
    for (wait_for(&o->wanted); o->job; wait_for(&o->wanted)) {
        job *j = o->job;
        j->ok = engine_compute(o->engine, j->input, j->settings, j->out_accessibility, j->error, j->error_size);
        sem_post(&o->done);
    }
    engine_destroy(o->engine);
    return NULL;
}

/* A forked child has none of its parent's threads, neither ours nor the driver's, so a call would wait for ever. */
static bool refuse_fork(pid_t process, char *error, size_t error_size)
{
    if (process == getpid())
        return false;
    snprintf(error, error_size,
             "OpenGL was opened before this process was forked: start the process anew (exec, spawn)");
    return true;
}

static void free_occlude(occlude *o)
{
    sem_destroy(&o->wanted);
    sem_destroy(&o->done);
    pthread_mutex_destroy(&o->callers);
    free(o);
}

static pid_t first_process;

static void remember_process(void)
{
    first_process = getpid();
}

occlude *occlude_create(uint32_t seed, char *error, size_t error_size)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, remember_process);
    if (refuse_fork(first_process, error, error_size))
        return NULL;
    occlude *o = calloc(1, sizeof *o);
    if (!o) {
        snprintf(error, error_size, "out of memory");
        return NULL;
    }
    job start = {.error = error, .error_size = error_size};
    o->job = &start;
    o->seed = seed;
    o->process = first_process;
    pthread_mutex_init(&o->callers, NULL);
    sem_init(&o->wanted, 0, 0);
    sem_init(&o->done, 0, 0);
    const int code = pthread_create(&o->thread, NULL, run_thread, o);
    if (code != 0) {
        snprintf(error, error_size, "no thread can be started");
        free_occlude(o);
        return NULL;
    }
    wait_for(&o->done);
    if (o->engine)
        return o;
    pthread_join(o->thread, NULL);
    free_occlude(o);
    return NULL;
}

void occlude_destroy(occlude *o)
{
    if (!o)
        return;
    if (o->process == getpid()) {
        o->job = NULL;
        sem_post(&o->wanted);
        pthread_join(o->thread, NULL);
    }
    free_occlude(o);
}

const char *occlude_description(const occlude *o)
{
    return engine_description(o->engine);
}

static bool check_depth(const occlude_input *input, char *error, size_t error_size)
{
    const float most = input->window_depth ? 1.0f : INFINITY;
    for (int y = 0; y < input->height; ++y)
        for (int x = 0; x < input->width; ++x) {
            const float value = input->depth[(size_t)y * (size_t)input->width + (size_t)x];
            if ((value >= 0.0f && value <= most) || (isnan(value) && !input->window_depth))
                continue;
            snprintf(error, error_size, "depth[%d, %d] = %g: %s", y, x, (double)value,
                     input->window_depth ? "window depth is 0 to 1"
                                         : "view distance is positive; no surface is 0, infinity or NaN");
            return false;
        }
    return true;
}

static bool check(const occlude_input *input, const glssao_settings *settings, const float *out, char *error,
                  size_t error_size)
{
    const char *missing = !input ? "input" : !settings ? "settings" : !out ? "out_accessibility" : NULL;
    if (!missing && !input->depth)
        missing = "input.depth";
    if (missing) {
        snprintf(error, error_size, "%s is NULL", missing);
        return false;
    }
    if (input->width < 1 || input->height < 1) {
        snprintf(error, error_size, "the depth map is %d x %d pixels: want 1 x 1 or more", input->width, input->height);
        return false;
    }
    if (input->estimates < 0 || input->estimates > 65536) {
        snprintf(error, error_size, "estimates = %d: want 0 to 65536", input->estimates);
        return false;
    }
    if (!(input->error >= 0.0f)) {
        snprintf(error, error_size, "error = %g: want 0 or more", (double)input->error);
        return false;
    }
    if (input->solid && input->window_depth) {
        snprintf(error, error_size, "input.solid needs view distance, not window depth");
        return false;
    }
    return check_depth(input, error, error_size);
}

bool occlude_compute(occlude *o, const occlude_input *input, const glssao_settings *settings, float *out_accessibility,
                     char *error, size_t error_size)
{
    if (!o) {
        snprintf(error, error_size, "occlude is NULL");
        return false;
    }
    if (refuse_fork(o->process, error, error_size) || !check(input, settings, out_accessibility, error, error_size))
        return false;
    job j = {input, settings, out_accessibility, error, error_size, false};
    pthread_mutex_lock(&o->callers);
    o->job = &j;
    sem_post(&o->wanted);
    wait_for(&o->done);
    pthread_mutex_unlock(&o->callers);
    return j.ok;
}
