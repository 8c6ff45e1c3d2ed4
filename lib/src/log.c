/* SPDX-License-Identifier: MIT
 *
 * The log, and the public functions that need no effect.
 */
#include "log.h"

#include <stdarg.h>
#include <stdio.h>

static void write_line(const glssao__log *log, glssao_log_level level, const char *format, va_list arguments)
{
    if (!log->write)
        return;
    char message[512];
    vsnprintf(message, sizeof message, format, arguments);
    log->write(level, message, log->user);
}

void glssao__log_write(const glssao__log *log, glssao_log_level level, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    write_line(log, level, format, arguments);
    va_end(arguments);
}

glssao_result glssao__log_refuse(const glssao__log *log, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    write_line(log, GLSSAO_LOG_ERROR, format, arguments);
    va_end(arguments);
    return GLSSAO_INVALID_ARGUMENT;
}

void glssao_log_to_stderr(glssao_log_level level, const char *message, void *user)
{
    (void)user;
    static const char *const names[] = {"error", "warning", "info"};
    fprintf(stderr, "glssao: %s: %s\n", (unsigned)level < 3 ? names[level] : "message", message ? message : "");
}

const char *glssao_result_string(glssao_result result)
{
    switch (result) {
    case GLSSAO_OK:
        return "ok";
    case GLSSAO_INVALID_ARGUMENT:
        return "invalid argument";
    case GLSSAO_UNSUPPORTED_CONTEXT:
        return "the context is not OpenGL 3.3 or later";
    case GLSSAO_OUT_OF_MEMORY:
        return "out of memory";
    case GLSSAO_SHADER_ERROR:
        return "the driver rejects a shader";
    case GLSSAO_FRAMEBUFFER_ERROR:
        return "the driver rejects a framebuffer";
    }
    return "unknown result";
}

uint32_t glssao_version(void)
{
    return (uint32_t)GLSSAO_VERSION_MAJOR << 16 | (uint32_t)GLSSAO_VERSION_MINOR << 8 | (uint32_t)GLSSAO_VERSION_PATCH;
}
