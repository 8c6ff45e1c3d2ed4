/* SPDX-License-Identifier: MIT
 *
 * The one line of error text.
 */
#include "scene_fault.h"

#include <stdarg.h>
#include <stdio.h>

/* Runs of white space become one space, other control characters a question mark. */
static void make_one_line(char *text)
{
    char *out = text;
    for (const char *in = text; *in; ++in) {
        const unsigned char c = (unsigned char)*in;
        if (c == ' ' || (c >= '\t' && c <= '\r')) {
            if (out != text && out[-1] != ' ')
                *out++ = ' ';
        } else {
            *out++ = c < 0x20 || c == 0x7f ? '?' : *in;
        }
    }
    while (out != text && (out[-1] == ' ' || out[-1] == '.'))
        --out;
    *out = '\0';
}

bool scene_fail(scene_fault *fault, const char *format, ...)
{
    const bool first = !fault->set;
    fault->set = true;
    if (!first || !fault->size)
        return false;
    char message[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    snprintf(fault->text, fault->size, "%s: %s", fault->file, message);
    make_one_line(fault->text);
    return false;
}

bool scene_fail_memory(scene_fault *fault)
{
    return scene_fail(fault, "not enough memory");
}
