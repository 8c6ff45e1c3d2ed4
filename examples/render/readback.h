/* SPDX-License-Identifier: MIT
 *
 * Brings drawn frames to the writer without waiting for them: each goes into a pixel buffer object with a fence behind
 * it, and is fetched once the fence has been passed, while later frames are drawn. The context is current throughout.
 */
#ifndef GLSSAO_EXAMPLES_READBACK_H
#define GLSSAO_EXAMPLES_READBACK_H

#include "fault.h"
#include "pipeline.h"
#include "writer.h"

typedef struct readback readback;

/* NULL where memory is short. The writer must outlive it. */
readback *readback_create(writer *w);
/* Drains first; NULL is fine. */
void readback_destroy(readback *r);

/* Has an output of the frame last drawn written to `path`; what becomes of it, the slip tells, which must live until it
 * is done. False, with one line in `why`, where it can't be read. */
bool readback_take(readback *r, pipeline *p, pipeline_output output, pixel_kind kind, const scene_view *view,
                   const char *path, writer_slip *slip, fault *why);

/* Hands over what the GPU is done with. */
void readback_poll(readback *r);
/* Waits for the rest too. */
void readback_drain(readback *r);

#endif
