/* SPDX-License-Identifier: MIT
 *
 * Collects warnings.
 */
#include "scene_warnings.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_LINES = 32 };

/* Text from a file may hold anything: a line break would start another line of the log. */
static void make_one_line(char *text)
{
    for (; *text; ++text)
        if ((unsigned char)*text < 0x20 || *text == 0x7f)
            *text = '?';
}

bool scene_warn(scene_warnings *w, failure *fault, const char *format, ...)
{
    char line[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    make_one_line(line);
    if (w->strict)
        return fault_set(fault, "%s", line);
    for (size_t i = 0; i < w->count; ++i)
        if (!strcmp(w->lines[i], line))
            return true;
    if (w->count == MOST_LINES)
        return true;
    char **lines = realloc(w->lines, (w->count + 1) * sizeof *lines);
    if (!lines)
        return fault_set_memory(fault);
    w->lines = lines;
    const size_t size = strlen(line) + 1;
    lines[w->count] = malloc(size);
    if (!lines[w->count])
        return fault_set_memory(fault);
    memcpy(lines[w->count++], line, size);
    return true;
}

void scene_warnings_free(scene_warnings *w)
{
    for (size_t i = 0; i < w->count; ++i)
        free(w->lines[i]);
    free(w->lines);
    w->lines = NULL;
    w->count = 0;
}
