/* SPDX-License-Identifier: MIT
 *
 * glssao-render: renders scenes to pictures without a display. One picture or turntable here, where the file is loaded
 * on a second thread while the context is made; lists of them in batch.c.
 */
#include "batch.h"
#include "clock.h"
#include "options.h"
#include "outputs.h"
#include "session.h"

#include <pthread.h>
#include <stdio.h>
#include <string.h>

enum { EXIT_DONE = 0, EXIT_NOT_RENDERED = 1, EXIT_USAGE = 2, ERROR_LENGTH = 8192 };

typedef struct loader {
    pthread_t thread;
    bool running;
    const options *options;
    scene *scene;
    double ms;
    char error[ERROR_LENGTH];
} loader;

typedef struct run {
    options options;
    loader loader;
    stage stage;
    session session;
    writer_slip slip;
    char error[ERROR_LENGTH];
} run;

static void *load_scene(void *argument)
{
    loader *l = argument;
    const double start = clock_wall_ms();
    l->scene = stage_load_scene(l->options, FAULT(l->error));
    l->ms = clock_wall_ms() - start;
    return NULL;
}

/* Scene and context side by side. */
static bool open_scene_and_context(run *r)
{
    loader *l = &r->loader;
    stopwatch *times = &r->session.times;
    l->options = &r->options;
    l->running = pthread_create(&l->thread, NULL, load_scene, l) == 0;
    if (!l->running) /* no more threads: then here */
        load_scene(l);
    stopwatch_start(times);
    const bool opened = session_open(&r->session, &r->options, FAULT(r->error));
    times->ms[PHASE_CONTEXT] = clock_wall_ms() - times->last_ms;
    if (l->running)
        pthread_join(l->thread, NULL);
    times->ms[PHASE_LOAD] = l->ms;
    if (opened && !l->scene)
        memcpy(r->error, l->error, sizeof r->error);
    return opened && l->scene;
}

/* All but the command line. False, with r->error, where it could not render. */
static bool render(run *r, double start_ms)
{
    const options *o = &r->options;
    session *s = &r->session;
    if (!outputs_check(o, FAULT(r->error)) || !open_scene_and_context(r))
        return false;
    stopwatch_start(&s->times);
    if (!stage_open(&r->stage, r->loader.scene, NULL, FAULT(r->error)))
        return false;
    stopwatch_lap(&s->times, PHASE_SETUP);
    if (!session_begin(s, o, &r->stage, FAULT(r->error)) || (o->bench && !session_bench(s, FAULT(r->error))))
        return false;
    const bool wants_frame = o->output || o->ao || o->normals || o->depth || (o->stats && !o->bench);
    if (wants_frame && !session_draw(s, true, &r->slip, FAULT(r->error)))
        return false;
    return session_finish(s, &r->slip, FAULT(r->error)) &&
           (!o->stats || session_write_stats(s, start_ms, 0, FAULT(r->error)));
}

int main(int argc, char **argv)
{
    const double start_ms = clock_wall_ms();
    static run r; /* large, and zero */
    switch (options_parse(argc, argv, &r.options, FAULT(r.error))) {
    case OPTIONS_DONE:
        return EXIT_DONE;
    case OPTIONS_WRONG:
        fprintf(stderr, "glssao-render: %s\n", r.error);
        return EXIT_USAGE;
    case OPTIONS_RUN:
        break;
    }
    if (r.options.batch)
        return batch_run(&r.options) ? EXIT_DONE : EXIT_NOT_RENDERED;
    const bool done = render(&r, start_ms);
    if (r.stage.scene)
        stage_close(&r.stage);
    session_close(&r.session);
    scene_destroy(r.loader.scene);
    if (!done)
        fprintf(stderr, "glssao-render: %s\n", r.error);
    return done ? EXIT_DONE : EXIT_NOT_RENDERED;
}
