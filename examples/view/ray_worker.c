/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "ray_worker.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct ray_worker {
    const scene *scene;
    void (*wake)(void);
    pthread_t thread;
    atomic_uint asked;    /* number of the newest request; every change ends the tracing for an older one */
    pthread_mutex_t lock; /* protects the members below */
    pthread_cond_t changed;
    ray_request next;
    bool has_next, is_ending;
    int rounds;  /* of the current request; -1: failed */
    float *mean; /* of them */
    size_t count;
    char error[512];
};

/* What the thread works at. */
typedef struct round_job {
    ray_worker *worker;
    unsigned number;
    ray_request request;
    const float (**rows)[4];
    float *values;
    int width, height;
} round_job;

static bool is_outdated(void *user)
{
    const round_job *j = user;
    return atomic_load(&j->worker->asked) != j->number;
}

static void fail(ray_worker *w, const char *error)
{
    pthread_mutex_lock(&w->lock);
    w->rounds = -1;
    snprintf(w->error, sizeof w->error, "%s", error);
    pthread_mutex_unlock(&w->lock);
    w->wake();
}

static bool trace_from_surfaces(round_job *j, const trace_scene *t, const trace_options *options, failure *fault)
{
    const trace_seen seen = {.rows = (const float(*const *)[4])j->rows, .step = j->request.step, .depth_step = 0x1p-24};
    trace_picture *p = trace_picture_begin(t, &j->request.view, &seen, NULL, options, j->values, fault);
    if (!p)
        return false;
    trace_picture_feed(p, j->height);
    return trace_picture_end(p, NULL);
}

/* False where the request is outdated or failed. */
static bool trace_round(round_job *j, const trace_scene *t, int round)
{
    ray_worker *w = j->worker;
    char error[512];
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    const trace_options options = {.radius = j->request.radius,
                                   .samples = j->request.rays,
                                   .adaptive = j->request.adaptive,
                                   .seed = j->request.seed + (uint32_t)round * 7919u,
                                   .threads = cores > 2 ? (int)cores - 1 : 1, /* one is left for the window */
                                   .stopped = is_outdated,
                                   .stopped_user = j};
    if (!(j->request.surfaces
              ? trace_from_surfaces(j, t, &options, FAULT(error))
              : trace_accessibility(t, &j->request.view, &options, j->values, NULL, &(trace_stats){0}, FAULT(error)))) {
        if (!is_outdated(j))
            fail(w, error);
        return false;
    }
    pthread_mutex_lock(&w->lock);
    const bool is_wanted = !is_outdated(j);
    for (size_t i = 0; is_wanted && i < (size_t)j->width * (size_t)j->height; i++)
        w->mean[i] = round == 0 ? j->values[i] : w->mean[i] + (j->values[i] - w->mean[i]) / (float)(round + 1);
    if (is_wanted)
        w->rounds = round + 1;
    pthread_mutex_unlock(&w->lock);
    if (is_wanted)
        w->wake();
    return is_wanted;
}

static void trace_request(round_job *j, const trace_scene *t)
{
    ray_worker *w = j->worker;
    j->width = (j->request.view.width + j->request.step - 1) / j->request.step;
    j->height = (j->request.view.height + j->request.step - 1) / j->request.step;
    const size_t count = (size_t)j->width * (size_t)j->height;
    j->values = malloc(count * sizeof *j->values);
    j->rows = malloc((size_t)j->height * sizeof *j->rows);
    float *mean = malloc(count * sizeof *mean);
    if (!j->values || !j->rows || !mean) {
        free(mean);
        fail(w, "out of memory");
    } else {
        pthread_mutex_lock(&w->lock);
        free(w->mean);
        w->mean = mean;
        w->count = count;
        pthread_mutex_unlock(&w->lock);
        for (int y = 0; j->request.surfaces && y < j->height; y++)
            j->rows[y] = (const float(*)[4])(j->request.surfaces + (size_t)y * (size_t)j->width);
        for (int round = 0; round < RAY_ROUNDS && trace_round(j, t, round); round++) {
        }
    }
    free(j->values);
    free(j->rows);
    free(j->request.surfaces);
}

static void *run(void *argument)
{
    ray_worker *w = argument;
    char error[512];
    trace_scene *t = trace_scene_create(w->scene, FAULT(error));
    if (!t)
        fail(w, error);
    pthread_mutex_lock(&w->lock);
    while (t && !w->is_ending) {
        if (!w->has_next) {
            pthread_cond_wait(&w->changed, &w->lock);
            continue;
        }
        round_job j = {.worker = w, .number = atomic_load(&w->asked), .request = w->next};
        w->next.surfaces = NULL;
        w->has_next = false;
        pthread_mutex_unlock(&w->lock);
        trace_request(&j, t);
        pthread_mutex_lock(&w->lock);
    }
    pthread_mutex_unlock(&w->lock);
    trace_scene_destroy(t);
    return NULL;
}

ray_worker *ray_worker_start(const scene *s, void (*wake)(void))
{
    ray_worker *w = calloc(1, sizeof *w);
    if (!w)
        return NULL;
    w->scene = s;
    w->wake = wake;
    pthread_mutex_init(&w->lock, NULL);
    pthread_cond_init(&w->changed, NULL);
    if (pthread_create(&w->thread, NULL, run, w) == 0)
        return w;
    pthread_cond_destroy(&w->changed);
    pthread_mutex_destroy(&w->lock);
    free(w);
    return NULL;
}

static void replace(ray_worker *w, const ray_request *request, bool is_ending)
{
    pthread_mutex_lock(&w->lock);
    atomic_fetch_add(&w->asked, 1);
    free(w->next.surfaces);
    w->next = request ? *request : (ray_request){.surfaces = NULL};
    w->has_next = request != NULL;
    w->is_ending = is_ending;
    w->rounds = w->rounds > 0 ? 0 : w->rounds;
    pthread_cond_signal(&w->changed);
    pthread_mutex_unlock(&w->lock);
}

void ray_worker_ask(ray_worker *w, const ray_request *request)
{
    replace(w, request, false);
}

void ray_worker_forget(ray_worker *w)
{
    replace(w, NULL, false);
}

int ray_worker_read(ray_worker *w, float *out, failure *why)
{
    pthread_mutex_lock(&w->lock);
    const int rounds = w->rounds;
    if (rounds > 0 && out)
        memcpy(out, w->mean, w->count * sizeof *out);
    if (rounds < 0)
        fault_set(why, "%s", w->error);
    pthread_mutex_unlock(&w->lock);
    return rounds;
}

void ray_worker_stop(ray_worker *w)
{
    if (!w)
        return;
    replace(w, NULL, true);
    pthread_join(w->thread, NULL);
    pthread_cond_destroy(&w->changed);
    pthread_mutex_destroy(&w->lock);
    free(w->mean);
    free(w);
}
