/* SPDX-License-Identifier: MIT
 *
 * Where messages go: the host's log function, one line a call.
 */
#ifndef GLSSAO_LOG_H
#define GLSSAO_LOG_H

#include "glssao/glssao.h"

#if defined(__GNUC__)
#define GLSSAO_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define GLSSAO_PRINTF(text, first)
#endif

typedef struct glssao__log {
    glssao_log_fn write; /* may be NULL */
    void *user;
} glssao__log;

void glssao__log_write(const glssao__log *log, glssao_log_level level, const char *format, ...) GLSSAO_PRINTF(3, 4);

/* Logs an error and returns GLSSAO_INVALID_ARGUMENT, so that a check can end with it. */
glssao_result glssao__log_refuse(const glssao__log *log, const char *format, ...) GLSSAO_PRINTF(2, 3);

#endif
