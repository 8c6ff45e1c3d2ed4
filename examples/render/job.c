/* SPDX-License-Identifier: MIT
 *
 * Loads the file on a second thread while the context is made.
 */
#include "job.h"

#include "clock.h"
#include "depth_map.h"
#include "outputs.h"
#include "session.h"

#include <pthread.h>

enum { ERROR_LENGTH = 8192 };

typedef struct loader {
    pthread_t thread;
    bool running;
    const options *options;
    scene *scene;
    inputs inputs;
    double ms;
    char error[ERROR_LENGTH];
} loader;

typedef struct job {
    const options *options;
    bool quiet;
    loader loader;
    stage stage;
    session session;
    writer_slip slip;
} job;

static void *load_scene(void *argument)
{
    loader *l = argument;
    const double start = clock_wall_ms();
    l->scene = stage_load_scene(l->options, &l->inputs, FAULT(l->error));
    l->ms = clock_wall_ms() - start;
    return NULL;
}

/* Loads the scene and makes the context at the same time. */
static bool open_scene_and_context(job *j, failure *why)
{
    loader *l = &j->loader;
    stopwatch *times = &j->session.times;
    l->options = j->options;
    l->running = pthread_create(&l->thread, NULL, load_scene, l) == 0;
    if (!l->running) /* without a second thread, load on this one */
        load_scene(l);
    stopwatch_start(times);
    const bool opened = session_open(&j->session, j->options, j->quiet, why);
    times->ms[PHASE_CONTEXT] = clock_wall_ms() - times->last_ms;
    if (l->running)
        pthread_join(l->thread, NULL);
    times->ms[PHASE_LOAD] = l->ms;
    return opened && (l->scene || fault_set(why, "%s", l->error));
}

static bool render(job *j, double start_ms, failure *why)
{
    const options *o = j->options;
    session *s = &j->session;
    if (!outputs_check(o, why) || !open_scene_and_context(j, why))
        return false;
    stopwatch_start(&s->times);
    if (!stage_open_spending(&j->stage, j->loader.scene, NULL, o, why))
        return false;
    j->stage.inputs = &j->loader.inputs;
    stopwatch_lap(&s->times, PHASE_SETUP);
    if (!session_begin(s, o, &j->stage, why) || (o->bench && !session_bench(s, why)))
        return false;
    const bool wants_frame = o->output || o->ao || o->normals || o->depth || (o->stats && !o->bench);
    if (wants_frame && !session_draw(s, !j->quiet, &j->slip, why))
        return false;
    return session_finish(s, &j->slip, why) && (!o->stats || session_write_stats(s, start_ms, 0, why));
}

/* A depth map needs neither a scene nor this thread's context. */
static bool run_depth_map(const options *o, bool quiet, writer_slip *slip, failure *why)
{
    depth_mapper d = {0};
    writer *w = writer_create();
    bool done = w ? depth_mapper_run(&d, o, quiet, w, slip, why) : fault_set(why, "out of memory");
    if (w && !writer_wait(w, slip) && done)
        done = fault_set(why, "%s", slip->error);
    writer_destroy(w);
    depth_mapper_close(&d);
    return done;
}

bool job_run(const options *o, bool quiet, double start_ms, size_t *out_pictures, failure *why)
{
    static job j; /* too large for the stack */
    j = (job){.options = o, .quiet = quiet};
    const bool done = o->depth_in ? run_depth_map(o, quiet, &j.slip, why) : render(&j, start_ms, why);
    if (j.stage.scene)
        stage_close(&j.stage);
    session_close(&j.session);
    scene_destroy(j.loader.scene);
    inputs_free(&j.loader.inputs);
    *out_pictures = (size_t)j.slip.written;
    return done;
}
