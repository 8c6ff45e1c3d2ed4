/* SPDX-License-Identifier: MIT
 *
 * What renders jobs, one after the other, on one context: a job is what one command line, or one line of a batch, asks
 * for.
 */
#ifndef GLSSAO_EXAMPLES_SESSION_H
#define GLSSAO_EXAMPLES_SESSION_H

#include "context.h"
#include "fault.h"
#include "options.h"
#include "pipeline.h"
#include "readback.h"
#include "report.h"
#include "viewpoint.h"
#include "writer.h"

typedef struct session {
    context *context;
    writer *writer;
    readback *readback;
    pipeline pipeline;
    /* Of the job: */
    const options *options;
    const scene *scene;
    viewpoint viewpoint;
    stopwatch times;
    bench bench;
    int frames_drawn;
} session;

/* Makes the context, and leaves it current; prints what it is to stderr unless it is `quiet`. False, with one line in
 * `why`; session_close is due in either case. */
bool session_open(session *s, const options *o, bool quiet, fault *why);
/* Waits for the pictures that are on their way. */
void session_close(session *s);

/* Makes the pipeline fit a job and the scene that it draws; prints the plan where that is asked for. False, with one
 * line in `error`: the job can't be drawn, another one can. */
bool session_begin(session *s, const options *o, stage *st, fault *why);

/* Draws the job's frames, or its turntable with progress on stderr where `shows_progress`, and has them written: the
 * slip, which must live until then, tells what becomes of them. */
bool session_draw(session *s, bool shows_progress, writer_slip *slip, fault *why);

/* Whole frames, each waited for, without read-back; prints their times. */
bool session_bench(session *s, fault *why);

/* Waits until the pictures of the slip's job are written. False, with one line in `why`, where one could not be. */
bool session_finish(session *s, writer_slip *slip, fault *why);

/* The file of --stats, after session_finish. start_ms, start_cpu_ms: when the job began, by clock.h. */
bool session_write_stats(session *s, double start_ms, double start_cpu_ms, fault *why);

#endif
