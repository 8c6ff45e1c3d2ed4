/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "truth_job.h"

#include "trace.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct truth_job {
    const scene *scene;
    scene_view view;
    float radius;
    uint32_t seed;
    void (*wake)(void);
    pthread_t thread;
    atomic_bool stop;
    pthread_mutex_t lock; /* protects the members below */
    int rounds;           /* -1: failed */
    float *mean;
    char error[512];
};

static size_t pixel_count(const truth_job *j)
{
    return (size_t)j->view.width * (size_t)j->view.height;
}

static void fail(truth_job *j, const char *error)
{
    pthread_mutex_lock(&j->lock);
    j->rounds = -1;
    snprintf(j->error, sizeof j->error, "%s", error);
    pthread_mutex_unlock(&j->lock);
}

static bool is_stopped(void *job)
{
    return atomic_load(&((truth_job *)job)->stop);
}

static bool trace_round(truth_job *j, const trace_scene *t, int round, float *scratch)
{
    char error[512];
    trace_stats stats;
    /* Leaves one core for the window. */
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    const trace_options options = {.radius = j->radius,
                                   .samples = TRUTH_ROUND_RAYS,
                                   .seed = j->seed + (uint32_t)round * 7919u,
                                   .threads = cores > 2 ? (int)cores - 1 : 1,
                                   .stopped = is_stopped,
                                   .stopped_user = j};
    if (!trace_accessibility(t, &j->view, &options, scratch, NULL, &stats, error, sizeof error)) {
        fail(j, error);
        return false;
    }
    pthread_mutex_lock(&j->lock);
    for (size_t i = 0; i < pixel_count(j); i++)
        j->mean[i] += (scratch[i] - j->mean[i]) / (float)(round + 1);
    j->rounds = round + 1;
    pthread_mutex_unlock(&j->lock);
    return true;
}

static void *run(void *argument)
{
    truth_job *j = argument;
    char error[512];
    float *scratch = malloc(pixel_count(j) * sizeof *scratch);
    trace_scene *t = trace_scene_create(j->scene, error, sizeof error);
    if (!scratch || !t)
        fail(j, scratch ? error : "out of memory");
    for (int round = 0; scratch && t && round < TRUTH_ROUNDS && !atomic_load(&j->stop); round++) {
        if (!trace_round(j, t, round, scratch))
            break;
        j->wake();
    }
    trace_scene_destroy(t);
    free(scratch);
    j->wake();
    return NULL;
}

truth_job *truth_job_start(const scene *s, const scene_view *view, float radius, uint32_t seed, void (*wake)(void))
{
    truth_job *j = calloc(1, sizeof *j);
    if (!j)
        return NULL;
    j->scene = s;
    j->view = *view;
    j->radius = radius;
    j->seed = seed;
    j->wake = wake;
    j->mean = calloc(pixel_count(j), sizeof *j->mean);
    pthread_mutex_init(&j->lock, NULL);
    if (!j->mean || pthread_create(&j->thread, NULL, run, j) != 0) {
        pthread_mutex_destroy(&j->lock);
        free(j->mean);
        free(j);
        return NULL;
    }
    return j;
}

int truth_job_read(truth_job *j, float *out, fault *why)
{
    pthread_mutex_lock(&j->lock);
    const int rounds = j->rounds;
    if (rounds > 0 && out)
        memcpy(out, j->mean, pixel_count(j) * sizeof *out);
    if (rounds < 0)
        fault_set(why, "%s", j->error);
    pthread_mutex_unlock(&j->lock);
    return rounds;
}

void truth_job_stop(truth_job *j)
{
    if (!j)
        return;
    atomic_store(&j->stop, true);
    pthread_join(j->thread, NULL);
    pthread_mutex_destroy(&j->lock);
    free(j->mean);
    free(j);
}
