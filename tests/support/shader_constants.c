/* SPDX-License-Identifier: MIT */
#include "shader_constants.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DEPTH = 8, MAX_MACROS = 64 };

typedef struct scanner {
    struct {
        char name[48];
        bool value;
    } macros[MAX_MACROS];
    int macro_count;
    /* For each open #if: whether its lines count now, and whether a branch was taken. */
    bool active[MAX_DEPTH], taken[MAX_DEPTH];
    int depth;
    const char *name;
    double value;
    int found;
    bool broken;
} scanner;

static bool is_active(const scanner *s)
{
    bool active = true;
    for (int i = 0; i < s->depth; ++i)
        active = active && s->active[i];
    return active;
}

static size_t identifier(const char *at)
{
    size_t length = 0;
    while (isalnum((unsigned char)at[length]) || at[length] == '_')
        ++length;
    return length;
}

static const char *skip_space(const char *at)
{
    return at + strspn(at, " \t");
}

/* A macro, possibly negated. */
static bool operand(scanner *s, const char **at)
{
    *at = skip_space(*at);
    const bool negated = **at == '!';
    *at = skip_space(*at + negated);
    const size_t length = identifier(*at);
    const char *name = *at;
    *at = skip_space(*at + length);
    for (int i = s->macro_count - 1; i >= 0; --i)
        if (strlen(s->macros[i].name) == length && memcmp(s->macros[i].name, name, length) == 0)
            return s->macros[i].value != negated;
    s->broken = true;
    return false;
}

static bool condition(scanner *s, const char *at)
{
    bool any = false;
    for (;;) {
        bool all = operand(s, &at);
        while (strncmp(at, "&&", 2) == 0) {
            at += 2;
            all = operand(s, &at) && all;
        }
        any = any || all;
        if (strncmp(at, "||", 2) != 0)
            break;
        at += 2;
    }
    s->broken = s->broken || *at != '\0';
    return any;
}

static void define(scanner *s, const char *at)
{
    at = skip_space(at);
    const size_t length = identifier(at);
    const char *value = skip_space(at + length);
    if ((value[0] != '0' && value[0] != '1') || value[1] != '\0')
        return; /* no flag */
    if (s->macro_count == MAX_MACROS || length >= sizeof s->macros[0].name) {
        s->broken = true;
        return;
    }
    memcpy(s->macros[s->macro_count].name, at, length);
    s->macros[s->macro_count].name[length] = '\0';
    s->macros[s->macro_count++].value = value[0] == '1';
}

static void branch(scanner *s, bool now)
{
    if (s->depth == 0) {
        s->broken = true;
        return;
    }
    s->active[s->depth - 1] = now && !s->taken[s->depth - 1];
    s->taken[s->depth - 1] = s->taken[s->depth - 1] || now;
}

static void read_line(scanner *s, const char *line)
{
    if (strncmp(line, "#if ", 4) == 0) {
        if (s->depth == MAX_DEPTH) {
            s->broken = true;
            return;
        }
        s->active[s->depth] = s->taken[s->depth] = is_active(s) && condition(s, line + 4);
        ++s->depth;
    } else if (strncmp(line, "#elif ", 6) == 0) {
        branch(s, condition(s, line + 6));
    } else if (strncmp(line, "#else", 5) == 0) {
        branch(s, true);
    } else if (strncmp(line, "#endif", 6) == 0) {
        --s->depth;
        s->broken = s->broken || s->depth < 0;
    } else if (is_active(s) && strncmp(line, "#define ", 8) == 0) {
        define(s, line + 8);
    } else if (is_active(s) && strncmp(line, "const float ", 12) == 0) {
        const char *at = line + 12;
        const size_t length = identifier(at);
        if (strlen(s->name) != length || memcmp(s->name, at, length) != 0)
            return;
        char *end;
        const char *value = skip_space(at + length);
        s->value = strtod(value + (*value == '='), &end);
        s->broken = s->broken || *value != '=' || *end != ';';
        ++s->found;
    }
}

bool shader_constant(const char *const *pieces, int count, const char *name, double *out_value)
{
    scanner s = {.name = name};
    char line[512];
    size_t length = 0;
    for (int i = 0; i < count; ++i)
        for (const char *at = pieces[i]; *at && s.depth >= 0; ++at) {
            if (*at != '\n') {
                s.broken = s.broken || length + 1 == sizeof line;
                length += length + 1 < sizeof line;
                line[length - 1] = *at;
                continue;
            }
            line[length] = '\0';
            read_line(&s, line);
            length = 0;
        }
    *out_value = s.value;
    return !s.broken && s.depth == 0 && s.found == 1;
}
