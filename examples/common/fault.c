/* SPDX-License-Identifier: MIT */
#include "fault.h"

#include <stdarg.h>
#include <stdio.h>

/* Replaces each run of white space by one space, and other control characters by a question mark. */
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

bool fault_set(fault *f, const char *format, ...)
{
    const bool first = !f->set;
    f->set = true;
    if (!first || !f->size)
        return false;
    int length = f->file ? snprintf(f->text, f->size, "%s: ", f->file) : 0;
    if (length >= 0 && (size_t)length < f->size) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(f->text + length, f->size - (size_t)length, format, arguments);
        va_end(arguments);
    }
    make_one_line(f->text);
    return false;
}

bool fault_set_memory(fault *f)
{
    return fault_set(f, "not enough memory");
}
