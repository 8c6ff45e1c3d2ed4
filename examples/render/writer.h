/* SPDX-License-Identifier: MIT
 *
 * Encodes and writes pictures on other threads, while the next ones are drawn.
 */
#pragma once

#include "pixel_kind.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct writer writer;

/* The result of one job's pictures. Set it to 0 before the first. Read it only after writer_wait or when
 * writer_is_done: until then the writer's threads change it. */
typedef struct writer_slip {
    int pending, written;
    bool failed;
    double ms;        /* sum over the pictures */
    char error[4352]; /* one line about the first failure */
} writer_slip;

/* NULL if memory is short. */
writer *writer_create(void);
/* Waits for all pictures and frees the writer. NULL is allowed. */
void writer_destroy(writer *w);

/* Announces a picture of the slip's job. writer_submit or writer_give_up must follow. */
void writer_expect(writer *w, writer_slip *slip);

/* Writes a picture. Takes ownership of `pixels` (from malloc, rows bottom to top), also on failure. Waits while too
 * many pictures are queued, so that memory stays bounded. */
void writer_submit(writer *w, writer_slip *slip, const char *path, int width, int height, pixel_kind kind,
                   void *pixels);

/* Cancels a picture that was announced. The slip fails with this line. */
void writer_give_up(writer *w, writer_slip *slip, const char *error);

/* Waits for all pictures that were announced. False if one failed. */
bool writer_wait(writer *w, writer_slip *slip);
bool writer_is_done(writer *w, writer_slip *slip);
/* True as soon as one picture has failed. */
bool writer_has_failed(writer *w, writer_slip *slip);
