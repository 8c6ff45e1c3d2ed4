/* SPDX-License-Identifier: MIT
 *
 * Reads whole files. The caller frees what is returned; a byte of 0, not counted in the size, follows the last one.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Opens a regular file. Refuses anything else, so that a FIFO cannot block the program. -1 on failure, with the reason
 * in words. */
int read_file_open(const char *path, const char **out_reason);

/* Reads a regular file of at most `limit` bytes. NULL on failure, with the reason in words. */
uint8_t *read_file(const char *path, size_t limit, size_t *out_size, const char **out_reason);

/* Reads an open file of any kind to its end: a regular file, a pipe, standard input. NULL on failure, with the reason.
 */
uint8_t *read_stream(int descriptor, size_t limit, size_t *out_size, const char **out_reason);

/* Recognises by their first bytes files that were fetched or packed wrongly, and says what they are; NULL for others.
 */
const char *read_file_find_mistake(const void *data, size_t size);

#ifdef __cplusplus
}
#endif
