/* SPDX-License-Identifier: MIT
 *
 * A text transformation: knows as much of GLSL as the form of one loop.
 */
#include "frame/unroll.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_LENGTH = 32 };

typedef struct loop {
    char counter[NAME_LENGTH];
    int first, end, step; /* end: the first value that no turn has */
    const char *body;     /* from its brace on ... */
    const char *after;    /* ... to behind the one that closes it */
} loop;

/* In the order in which they are looked for. */
static const char *const markers[] = {"UNROLL for (int ", "UNROLL_IF_SHORT for (int "};

static const char *read_name(const char *at, char out[NAME_LENGTH])
{
    int length = 0;
    while ((isalnum((unsigned char)at[length]) || at[length] == '_') && length + 1 < NAME_LENGTH)
        ++length;
    memcpy(out, at, (size_t)length);
    out[length] = '\0';
    return at + length;
}

static int value_of(const char *source, const char *macro)
{
    char define[NAME_LENGTH + 16];
    snprintf(define, sizeof define, "#define %s ", macro);
    const char *found = strstr(source, define);
    return found ? atoi(found + strlen(define)) : 0;
}

/* A number, a macro, or a macro plus or minus a number. */
static const char *read_bound(const char *source, const char *at, int *out)
{
    char *end;
    *out = (int)strtol(at, &end, 10);
    if (end != at)
        return end;
    char name[NAME_LENGTH];
    at = read_name(at, name);
    *out = value_of(source, name);
    if (strncmp(at, " - ", 3) == 0 || strncmp(at, " + ", 3) == 0) {
        const int by = (int)strtol(at + 3, &end, 10);
        *out += at[1] == '-' ? -by : by;
        at = end;
    }
    return at;
}

/* Behind the brace that closes the one at `at`; NULL where none does. */
static const char *behind_block(const char *at)
{
    int depth = 0;
    do {
        depth += (*at == '{') - (*at == '}');
        if (*at++ == '\0')
            return NULL;
    } while (depth > 0);
    return at;
}

/* The next loop to write out, or `end`; *out_head is where its marker ends. */
static const char *find_loop(const char *at, const char *end, bool is_short, const char **out_head)
{
    const char *next = end;
    *out_head = end;
    for (int i = 0; i < 1 + is_short; ++i) {
        const char *found = strstr(at, markers[i]);
        if (!found || found >= next)
            continue;
        next = found;
        *out_head = found + strlen(markers[i]);
    }
    return next;
}

/* Reads the loop from behind its marker on. */
static bool read_loop(const char *source, const char *at, loop *out)
{
    at = read_name(at, out->counter);
    if (strncmp(at, " = ", 3) != 0)
        return false;
    at = read_bound(source, at + 3, &out->first);
    const char *compare = strpbrk(at, "<>");
    if (!compare)
        return false;
    out->step = *compare == '<' ? 1 : -1;
    at = read_bound(source, compare + (compare[1] == '=' ? 3 : 2), &out->end);
    out->end += compare[1] == '=' ? out->step : 0;
    out->body = strchr(at, '{');
    out->after = out->body ? behind_block(out->body) : NULL;
    return out->after != NULL;
}

/* Copies the text up to `end` to `out`, NULL: only counts; returns its length. Loops within loops are written out too.
 */
static size_t copy(const char *source, const char *at, const char *end, bool is_short, char *out)
{
    size_t length = 0;
    while (at < end) {
        const char *head = at, *next = find_loop(at, end, is_short, &head);
        loop l;
        if (next < end && !read_loop(source, head, &l))
            next = end;
        if (out)
            memcpy(out + length, at, (size_t)(next - at));
        length += (size_t)(next - at);
        at = next;
        if (next == end)
            break;
        for (int i = l.first; i != l.end; i += l.step) {
            char opening[NAME_LENGTH + 32];
            const int opening_length = snprintf(opening, sizeof opening, "{ const int %s = %d; ", l.counter, i);
            if (out)
                memcpy(out + length, opening, (size_t)opening_length);
            length += (size_t)opening_length;
            length += copy(source, l.body, l.after, is_short, out ? out + length : NULL);
            if (out)
                memcpy(out + length, " }\n", 3);
            length += 3;
        }
        at = l.after;
    }
    return length;
}

char *glssao__unroll(const char *source, bool is_short)
{
    const char *const end = source + strlen(source);
    const size_t length = copy(source, source, end, is_short, NULL);
    char *out = malloc(length + 1);
    if (!out)
        return NULL;
    copy(source, source, end, is_short, out);
    out[length] = '\0';
    return out;
}
