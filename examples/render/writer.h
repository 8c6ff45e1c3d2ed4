/* SPDX-License-Identifier: MIT
 *
 * Encodes and writes pictures on threads of its own, while the next ones are drawn.
 */
#ifndef GLSSAO_EXAMPLES_WRITER_H
#define GLSSAO_EXAMPLES_WRITER_H

#include "pixel_kind.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct writer writer;

/* What becomes of the pictures of one job; zero before the first. To be read after writer_wait, or once writer_is_done:
 * until then the writer's threads change it. */
typedef struct writer_slip {
    int pending, written;
    bool failed;
    double ms;        /* spent, summed over the pictures */
    char error[4352]; /* one line: of the first failure */
} writer_slip;

/* NULL where memory is short. */
writer *writer_create(void);
/* Waits, frees; NULL is fine. */
void writer_destroy(writer *w);

/* Says that a picture of the slip's job will come: writer_submit or writer_give_up must follow. */
void writer_expect(writer *w, writer_slip *slip);

/* Takes `pixels` (of malloc, bottom to top) over, also on failure. Waits where too many pictures are in the queue, so
 * that memory stays bounded. */
void writer_submit(writer *w, writer_slip *slip, const char *path, int width, int height, pixel_kind kind,
                   void *pixels);

/* The picture expected will not come; the slip fails with this line. */
void writer_give_up(writer *w, writer_slip *slip, const char *error);

/* Waits for all pictures expected. False where one failed. */
bool writer_wait(writer *w, writer_slip *slip);
bool writer_is_done(writer *w, writer_slip *slip);
/* True as soon as one failed. */
bool writer_has_failed(writer *w, writer_slip *slip);

#endif
