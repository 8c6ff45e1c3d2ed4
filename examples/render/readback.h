/* SPDX-License-Identifier: MIT
 *
 * Reads frames back without waiting for the GPU. Each frame is copied into a pixel buffer object, followed by a fence.
 * Once the fence is signalled, the pixels go to the writer, while later frames are drawn. The context is current in all
 * calls.
 */
#pragma once

#include "fault.h"
#include "pipeline.h"
#include "writer.h"

typedef struct readback readback;

/* NULL if memory is short. The writer must outlive it. */
readback *readback_create(writer *w);
/* Drains it first. NULL is allowed. */
void readback_destroy(readback *r);

/* Reads an output of the last frame and writes it to `path`. The slip tells the result; it must live until then. False,
 * with one line in `why`, if the output cannot be read. */
bool readback_take(readback *r, pipeline *p, pipeline_output output, pixel_kind kind, const scene_view *view,
                   const char *path, writer_slip *slip, failure *why);

/* Passes the frames that the GPU has finished to the writer. */
void readback_poll(readback *r);
/* Waits for the other frames too. */
void readback_drain(readback *r);
