/* SPDX-License-Identifier: MIT
 *
 * Jobs are drawn one after the other. A job that is drawn is in flight until its pictures are read back, encoded and
 * written; then it lands. Jobs land, and are reported, in the order of the list.
 */
#define _POSIX_C_SOURCE 200809L /* strsignal */
#include "batch.h"

#include "batch_isolated.h"
#include "batch_list.h"
#include "clock.h"
#include "depth_map.h"
#include "outputs.h"
#include "progress.h"
#include "session.h"
#include "stage_cache.h"
#include "stop.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FLIGHTS = 64, ERROR_LENGTH = 8192, LOOK_AHEAD = 32 };

typedef struct flight {
    const batch_job *job;
    writer_slip slip;
    bool failed;
    char error[ERROR_LENGTH]; /* only if failed */
} flight;

typedef struct batch {
    const options *options;
    batch_list list;
    session session;
    stage_cache *stages;
    depth_mapper mapper;
    flight flights[FLIGHTS]; /* ring buffer */
    int first, count;
    progress shown;
    size_t mine; /* number of jobs in the shard */
    size_t done, failed, pictures;
} batch;

static bool is_mine(const batch *b, size_t index)
{
    const size_t count = b->options->shard_count ? (size_t)b->options->shard_count : 1;
    return index % count == (size_t)b->options->shard_index;
}

static const char *list_name(const batch *b)
{
    return strcmp(b->options->batch, "-") == 0 ? "standard input" : b->options->batch;
}

/* Counts a job, and prints its error if it failed. */
static void record(batch *b, const batch_job *job, size_t pictures, const char *error)
{
    b->pictures += pictures;
    b->done += !error;
    b->failed += error != NULL;
    if (error) {
        progress_clear();
        fprintf(stderr, "glssao-render: %s:%d: %s\n", list_name(b), job->line, error);
    }
}

static void land_first(batch *b)
{
    flight *f = &b->flights[b->first];
    if (!writer_wait(b->session.writer, &f->slip) && !f->failed) {
        f->failed = true;
        memcpy(f->error, f->slip.error, sizeof f->slip.error);
    }
    record(b, f->job, (size_t)f->slip.written, f->failed ? f->error : NULL);
    b->first = (b->first + 1) % FLIGHTS;
    b->count--;
}

static void land_those_done(batch *b)
{
    readback_poll(b->session.readback);
    while (b->count && writer_is_done(b->session.writer, &b->flights[b->first].slip))
        land_first(b);
}

static void land_all(batch *b)
{
    readback_drain(b->session.readback);
    while (b->count)
        land_first(b);
}

static flight *take_off(batch *b, const batch_job *job)
{
    if (b->count == FLIGHTS) {
        readback_drain(b->session.readback);
        land_first(b);
    }
    flight *f = &b->flights[(b->first + b->count++) % FLIGHTS];
    *f = (flight){.job = job};
    return f;
}

/* Starts to load the scene of the next job that needs another one. */
static void load_ahead(batch *b, size_t from)
{
    bool started = false;
    for (size_t i = from, looked = 0; i < b->list.count && looked < LOOK_AHEAD && !started; i++) {
        if (is_mine(b, i) && !b->list.jobs[i].error && !b->list.jobs[i].options.depth_in) {
            started = stage_cache_load_ahead(b->stages, &b->list.jobs[i].options);
            looked++;
        }
    }
}

static bool draw_job(batch *b, size_t index, flight *f)
{
    session *s = &b->session;
    const options *o = &b->list.jobs[index].options;
    const double start_ms = clock_wall_ms(), start_cpu_ms = clock_cpu_ms();
    if (o->depth_in)
        return depth_mapper_run(&b->mapper, o, true, s->writer, &f->slip, FAULT(f->error));
    s->times = (stopwatch){.last_ms = start_ms};
    stage *st = stage_cache_get(b->stages, o,
                                FAULT(f->error)); /* before the outputs are checked: the scene may be loaded already */
    if (!st || !outputs_check(o, FAULT(f->error)))
        return false;
    stopwatch_lap(&s->times, PHASE_LOAD);
    load_ahead(b, index + 1);
    if (o->plan)
        printf("%s:%d:\n", list_name(b), f->job->line);
    if (!session_begin(s, o, st, FAULT(f->error)))
        return false;
    const bool wants_frame = o->output || o->ao || o->normals || o->depth || o->stats;
    if (wants_frame && !session_draw(s, false, &f->slip, FAULT(f->error)))
        return false;
    return !o->stats || (session_finish(s, &f->slip, FAULT(f->error)) &&
                         session_write_stats(s, start_ms, start_cpu_ms, FAULT(f->error)));
}

static void print_summary(const batch *b, double start_ms)
{
    const double seconds = (clock_wall_ms() - start_ms) / 1e3;
    char shard[48] = "";
    if (b->options->shard_count)
        snprintf(shard, sizeof shard, ", shard %d/%d", b->options->shard_index, b->options->shard_count);
    progress_clear();
    if (stop_signal())
        fprintf(stderr, "%s%s: stopped by signal %d (%s)\n", list_name(b), shard, stop_signal(),
                strsignal(stop_signal()));
    fprintf(stderr, "%s%s: %zu of %zu jobs done, %zu failed; %zu pictures in %.2f s, %.1f a second\n", list_name(b),
            shard, b->done, b->mine, b->failed, b->pictures, seconds, seconds > 0 ? (double)b->pictures / seconds : 0);
}

/* Runs all jobs in this process. False, with one line in `why`, if no job can be drawn. */
static bool run_together(batch *b, failure *why)
{
    int drawn = 0;
    if (b->mine && !session_open(&b->session, b->options, false, why))
        return false;
    b->stages = stage_cache_create((size_t)b->options->cache_mib << 20);
    if (!b->stages)
        return fault_set(why, "out of memory");
    for (size_t i = 0; i < b->list.count && !stop_signal(); i++) {
        const batch_job *job = &b->list.jobs[i];
        if (!is_mine(b, i))
            continue;
        flight *f = take_off(b, job);
        if (job->error)
            snprintf(f->error, sizeof f->error, "%s", job->error);
        f->failed = job->error || !draw_job(b, i, f);
        land_those_done(b);
        progress_count(&b->shown, ++drawn, (int)b->mine);
    }
    if (b->mine)
        land_all(b);
    return true;
}

static void run_isolated(batch *b)
{
    int run = 0;
    for (size_t i = 0; i < b->list.count && !stop_signal(); i++) {
        const batch_job *job = &b->list.jobs[i];
        char error[ERROR_LENGTH];
        size_t pictures = 0;
        if (!is_mine(b, i))
            continue;
        if (job->error)
            snprintf(error, sizeof error, "%s", job->error);
        const bool done = !job->error && batch_run_isolated(&job->options, run > 0, &pictures, FAULT(error));
        record(b, job, pictures, done ? NULL : error);
        progress_count(&b->shown, ++run, (int)b->mine);
    }
}

bool batch_run(const options *o)
{
    const double start_ms = clock_wall_ms();
    char error[ERROR_LENGTH];
    static batch b; /* too large for the stack; starts as 0 */
    b.options = o;
    stop_when_asked();
    bool ran = batch_list_read(&b.list, o, FAULT(error));
    for (size_t i = 0; ran && i < b.list.count; i++)
        b.mine += is_mine(&b, i);
    b.shown = progress_start("job");
    if (ran && (o->isolate || o->timeout_s.given))
        run_isolated(&b);
    else
        ran = ran && run_together(&b, FAULT(error));
    depth_mapper_close(&b.mapper);
    stage_cache_destroy(b.stages);
    session_close(&b.session);
    if (ran)
        print_summary(&b, start_ms);
    else
        fprintf(stderr, "glssao-render: %s\n", error);
    batch_list_free(&b.list);
    return ran && b.failed == 0;
}
