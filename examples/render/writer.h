/* SPDX-License-Identifier: MIT
 *
 * Encodes and writes pictures on threads of their own, while the next one is drawn or the context is torn down.
 */
#ifndef GLSSAO_EXAMPLES_WRITER_H
#define GLSSAO_EXAMPLES_WRITER_H

#include <stdbool.h>
#include <stddef.h>

typedef enum pixel_kind {
    PIXELS_RGBA8, /* written as RGB: alpha means nothing here */
    PIXELS_GREY8,
    PIXELS_FLOAT
} pixel_kind;

typedef struct writer writer;

/* NULL where memory is short. */
writer *writer_create(void);

/* Takes `pixels` (of malloc, bottom to top) over, also on failure. False, with one line in `error`, once a picture
 * handed over earlier could not be written. */
bool writer_submit(writer *w, const char *path, int width, int height, pixel_kind kind, void *pixels, char *error,
                   size_t error_size);

/* Waits for all pictures. The same result; *out_ms (may be NULL) is the time spent, summed over the pictures. */
bool writer_finish(writer *w, double *out_ms, char *error, size_t error_size);

/* Waits, frees; NULL is fine. */
void writer_destroy(writer *w);

#endif
