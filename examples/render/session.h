/* SPDX-License-Identifier: MIT
 *
 * Renders jobs, one after the other, in one context. A job is a command line or a line of a batch.
 */
#pragma once

#include "animation.h"
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
    /* These belong to the job that is being drawn. */
    const options *options;
    const scene *scene;
    stage *stage;
    animation animation; /* only with --fps, from the second frame on */
    viewpoint viewpoint;
    stopwatch times;
    bench bench;
    int frames_drawn;
} session;

/* Makes a context and leaves it current. Prints its description to stderr unless `quiet`. False, with one line in
 * `why`; session_close is due in either case. */
bool session_open(session *s, const options *o, bool quiet, failure *why);
/* Waits until all pictures are written. */
void session_close(session *s);

/* Prepares the pipeline for a job and its scene, and prints the plan if the job asks for it. False, with one line in
 * `why`, if the job cannot be drawn; other jobs still can. */
bool session_begin(session *s, const options *o, stage *st, failure *why);

/* Draws the frames of the job and passes them to the writer. The slip tells the result; it must live until the pictures
 * are written. `shows_progress`: print the progress of a turntable to stderr. */
bool session_draw(session *s, bool shows_progress, writer_slip *slip, failure *why);

/* Draws whole frames, waits for each, reads nothing back, and prints the times. */
bool session_bench(session *s, failure *why);

/* Waits until the pictures of the slip are written. False, with one line in `why`, if one could not be written. */
bool session_finish(session *s, writer_slip *slip, failure *why);

/* Writes the file of --stats, after session_finish. start_ms and start_cpu_ms: when the job began (clock.h). */
bool session_write_stats(session *s, double start_ms, double start_cpu_ms, failure *why);
