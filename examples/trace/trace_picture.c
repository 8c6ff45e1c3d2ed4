/* SPDX-License-Identifier: MIT
 *
 * Pictures whose surfaces a rasteriser found. Threads take blocks of texels from the bottom up, as far as texels have
 * come.
 */
#define _POSIX_C_SOURCE 200809L
#include "trace_picture.h"

#include "clock.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/* Takes blocks until none is left; waits for texels if `patient`. */
static void take_blocks(trace_picture *p, bool patient)
{
    const int blocks = p->blocks_across * ((p->height + BLOCK - 1) / BLOCK);
    pthread_mutex_lock(&p->lock);
    for (;;) {
        const int beyond = (p->next / p->blocks_across + 1) * BLOCK + (p->adaptive ? 2 : 0),
                  needed = beyond < p->height ? beyond : p->height;
        if (p->next >= blocks || p->is_stopped)
            break;
        if (p->rows < needed) {
            if (!patient || p->is_ending)
                break;
            pthread_cond_wait(&p->fed, &p->lock);
            continue;
        }
        const int number = p->next++;
        pthread_mutex_unlock(&p->lock);
        const bool stop = p->stopped && p->stopped(p->stopped_user);
        const uint64_t rays = stop ? 0 : trace_block_run(p, number);
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
                                   const uint8_t *counts, const trace_options *options, float *out, failure *fault)
{
    const int most = options->adaptive ? MOST_RAYS / 4 : MOST_RAYS;
    if (options->samples < 1 || options->samples > most || !(options->radius >= 0)) {
        fault_set(fault, "%d rays within a radius of %g: out of range", options->samples, (double)options->radius);
        return NULL;
    }
    trace_picture *p = calloc(1, sizeof *p);
    const int more = options->adaptive ? 3 * options->samples : 0;
    if (!p || !trace_pattern_open(&p->pattern, options->samples, options->seed) ||
        (more > 0 && !trace_pattern_open(&p->more, more, ~options->seed))) {
        fault_set_memory(fault);
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
    if (!trace_lens_open(view, seen, &p->lens)) {
        fault_set(fault, "the view's matrices have no inverse");
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
    for (int i = 0; i < p->thread_count; i++)
        pthread_join(p->threads[i], NULL);
    const bool done = !p->is_stopped;
    if (out_stats)
        *out_stats = (trace_stats){.rays = p->rays, .seconds = (clock_wall_ms() - p->start_ms) * 1e-3};
    pthread_cond_destroy(&p->fed);
    pthread_mutex_destroy(&p->lock);
    trace_pattern_close(&p->pattern);
    trace_pattern_close(&p->more);
    free(p);
    return done;
}
