/* SPDX-License-Identifier: MIT */
#include "option.h"

#include "words.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Refuses leading blanks, hexadecimal, "nan" and "inf", which strtod accepts. */
static bool parse_number(const char *text, const char **out_end, double *out)
{
    if (!strchr("+-.0123456789", text[0]) || text[0] == '\0' || text[strcspn(text, "xXnN")] != '\0')
        return false;
    char *end;
    *out = strtod(text, &end);
    *out_end = end;
    return end != text && isfinite(*out) && fabs(*out) <= (double)FLT_MAX;
}

static bool parse_in_range(const option *o, const char *text, float *out)
{
    const char *end;
    double number;
    if (!parse_number(text, &end, &number) || *end != '\0' || number < o->min || number > o->max)
        return false;
    *out = (float)number;
    return true;
}

static bool parse_whole(const char *text, double min, double max, long long *out)
{
    if (text[0] == '\0' || text[strspn(text, "0123456789")] != '\0')
        return false;
    errno = 0;
    *out = strtoll(text, NULL, 10);
    return errno == 0 && (double)*out >= min && (double)*out <= max;
}

static bool parse_numbers(const char *text, int count, double *out)
{
    for (int i = 0; i < count; i++) {
        if (!parse_number(text, &text, &out[i]) || *text != (i < count - 1 ? ',' : '\0'))
            return false;
        text++;
    }
    return true;
}

/* Two whole numbers with a character between them. */
static bool parse_pair(const char *text, char between, double first_min, double min, double max, int out[2])
{
    char first[8];
    const char *x = strchr(text, between);
    if (!x || (size_t)(x - text) >= sizeof first)
        return false;
    memcpy(first, text, (size_t)(x - text));
    first[x - text] = '\0';
    long long a, b;
    if (!parse_whole(first, first_min, max, &a) || !parse_whole(x + 1, min, max, &b))
        return false;
    out[0] = (int)a;
    out[1] = (int)b;
    return true;
}

static bool ends_as_wanted(const char *path, const char *endings)
{
    if (strcmp(path, "-") == 0)
        return words_find(endings, path) >= 0 || endings[0] == '\0';
    return path[0] != '\0' && (endings[0] == '\0' || words_find_ending(endings, path) >= 0);
}

/* Sets the member of the option. False if `text` is no valid value. */
static bool take(const option *o, const char *text, void *out)
{
    void *target = (char *)out + o->offset;
    long long whole;
    switch (o->kind) {
    case OPTION_FLAG:
        *(bool *)target = true;
        return true;
    case OPTION_INT_OR_NONE:
        if (strcmp(text, "none") == 0) {
            *(int *)target = -1;
            return true;
        } /* fall through */
    case OPTION_INT:
        if (!parse_whole(text, o->min, o->max, &whole))
            return false;
        *(int *)target = (int)whole;
        return true;
    case OPTION_SEED:
        if (!parse_whole(text, o->min, o->max, &whole))
            return false;
        *(uint32_t *)target = (uint32_t)whole;
        return true;
    case OPTION_FLOAT:
        return parse_in_range(o, text, target);
    case OPTION_NUMBER:
        ((option_number *)target)->given = true;
        return parse_in_range(o, text, &((option_number *)target)->value);
    case OPTION_VECTOR:
        ((option_vector *)target)->given = true;
        return parse_numbers(text, 3, ((option_vector *)target)->value);
    case OPTION_PAIR: {
        option_pair *pair = target;
        pair->given = true;
        return parse_numbers(text, 2, pair->value) && fmin(pair->value[0], pair->value[1]) >= o->min &&
               fmax(pair->value[0], pair->value[1]) <= o->max;
    }
    case OPTION_MATRIX:
        ((option_matrix *)target)->given = true;
        return parse_numbers(text, 16, ((option_matrix *)target)->value);
    case OPTION_SIZE:
        return parse_pair(text, 'x', o->min, o->min, o->max, target);
    case OPTION_SHARD:
        return parse_pair(text, '/', 0, o->min, o->max, target) && ((int *)target)[0] < ((int *)target)[1];
    case OPTION_WORD:
        *(int *)target = words_find(o->wanted, text);
        return *(int *)target >= 0;
    case OPTION_TEXT:
    case OPTION_FILE:
        *(const char **)target = text;
        return o->kind == OPTION_TEXT || ends_as_wanted(text, o->wanted);
    }
    return false;
}

static const char *refusal(const option_set *set, const option *o)
{
    return set->refused ? set->refused[o->scope] : NULL;
}

/* Finds the option of an argument such as "--name=value" or "-nvalue"; *rest is the text after the name. */
static const option *find(const option_set *set, const char *argument, const char **rest)
{
    const bool is_long = argument[1] == '-';
    const size_t length = is_long ? strcspn(argument + 2, "=") : 1;
    *rest = argument + (is_long ? 2 : 1) + length;
    for (int i = 0; i < set->count; i++) {
        const option *o = &set->table[i];
        const bool is_same = is_long ? strlen(o->name) == length && memcmp(o->name, argument + 2, length) == 0
                                     : o->letter && o->letter == argument[1];
        if (is_same)
            return o;
    }
    return NULL;
}

/* What a value must be, to complete "must be ...". */
static void describe(const option *o, char out[256])
{
    const bool above_0 = o->min > 0 && o->min<1e-30, endless = o->max> 1e30;
    if (o->wanted)
        snprintf(out, 256, "%s%s",
                 o->kind == OPTION_WORD                    ? "one of "
                 : o->kind == OPTION_FILE && !o->wanted[0] ? "a file name"
                 : o->kind == OPTION_FILE                  ? "a file name ending in "
                                                           : "",
                 o->wanted);
    else if (o->kind == OPTION_INT && o->max >= 1e9)
        snprintf(out, 256, "a whole number from %.0f", o->min);
    else if (o->kind == OPTION_INT || o->kind == OPTION_SEED)
        snprintf(out, 256, "a whole number from %.0f to %.0f", o->min, o->max);
    else if (o->kind == OPTION_INT_OR_NONE)
        snprintf(out, 256, "a whole number from %.0f, or none", o->min);
    else if (o->kind == OPTION_VECTOR)
        snprintf(out, 256, "three numbers %s", o->value);
    else if (o->kind == OPTION_MATRIX)
        snprintf(out, 256, "16 numbers with commas between them");
    else if (o->kind == OPTION_PAIR)
        snprintf(out, 256, "two numbers %s from %g to %g", o->value, o->min, o->max);
    else if (o->kind == OPTION_SIZE)
        snprintf(out, 256, "%s with sides from %.0f to %.0f", o->value, o->min, o->max);
    else if (o->kind == OPTION_SHARD)
        snprintf(out, 256, "I/N with I from 0 to N-1");
    else if (endless)
        snprintf(out, 256, above_0 ? "a number above 0" : "a number, %g or more", o->min);
    else
        snprintf(out, 256, "a number from %g to %g", o->min, o->max);
}

/* Parses an option and its value, which may be the next argument. *at moves behind them. */
static bool parse_option(const option_set *set, int argc, char **argv, int *at, void *out, failure *why)
{
    const char *argument = argv[(*at)++], *rest;
    const option *o = find(set, argument, &rest);
    const char *value = *rest ? rest + (argument[1] == '-') : NULL;
    if (!o)
        fault_set(why, "unknown option %s", argument);
    else if (refusal(set, o))
        fault_set(why, "--%s: %s", o->name, refusal(set, o));
    else if (o->kind == OPTION_FLAG && value)
        fault_set(why, "--%s takes no value, but got \"%s\"", o->name, value);
    else if (o->kind != OPTION_FLAG && !value && *at >= argc)
        fault_set(why, "--%s: the value %s is missing", o->name, o->value);
    else {
        value = value || o->kind == OPTION_FLAG ? value : argv[(*at)++];
        if (take(o, value, out))
            return true;
        char wanted[256];
        describe(o, wanted);
        fault_set(why, "--%s \"%s\": must be %s", o->name, value, wanted);
    }
    return false;
}

bool option_parse(const option_set *set, int argc, char **argv, void *out, failure *why)
{
    bool options_end = false;
    for (int at = 1; at < argc;) {
        const char **operand = (const char **)((char *)out + set->operand_offset);
        if (!options_end && strcmp(argv[at], "--") == 0) {
            options_end = true;
            at++;
        } else if (!options_end && argv[at][0] == '-' && argv[at][1] != '\0') {
            if (!parse_option(set, argc, argv, &at, out, why))
                return false;
        } else if (!set->operand) {
            return fault_set(why, "%s is no option", argv[at]);
        } else if (*operand) {
            return fault_set(why, "two %s files, %s and %s", set->operand, *operand, argv[at]);
        } else {
            *operand = argv[at++];
        }
    }
    return true;
}

bool option_differs(const option *o, const void *a, const void *b)
{
    static const size_t sizes[] = {
        [OPTION_FLAG] = sizeof(bool),         [OPTION_INT] = sizeof(int),         [OPTION_INT_OR_NONE] = sizeof(int),
        [OPTION_SEED] = sizeof(uint32_t),     [OPTION_FLOAT] = sizeof(float),     [OPTION_NUMBER] = sizeof(float),
        [OPTION_VECTOR] = 3 * sizeof(double), [OPTION_PAIR] = 2 * sizeof(double), [OPTION_MATRIX] = 16 * sizeof(double),
        [OPTION_SIZE] = 2 * sizeof(int),      [OPTION_SHARD] = 2 * sizeof(int),   [OPTION_WORD] = sizeof(int),
        [OPTION_TEXT] = sizeof(char *),       [OPTION_FILE] = sizeof(char *),
    };
    /* Structures with `given` are compared without the padding between it and the value. */
    const size_t value = o->kind == OPTION_NUMBER   ? offsetof(option_number, value)
                         : o->kind == OPTION_VECTOR ? offsetof(option_vector, value)
                         : o->kind == OPTION_PAIR   ? offsetof(option_pair, value)
                         : o->kind == OPTION_MATRIX ? offsetof(option_matrix, value)
                                                    : 0;
    const char *x = (const char *)a + o->offset, *y = (const char *)b + o->offset;
    return (value > 0 && *(const bool *)x != *(const bool *)y) || memcmp(x + value, y + value, sizes[o->kind]) != 0;
}

void option_print_line(const char *left, const char *help)
{
    enum { LEFT = 29, WIDTH = 100 };
    int column = printf("  %-*s", LEFT - 3, left);
    while (*help) {
        const int length = (int)strcspn(help, " ");
        if (column + 1 + length > WIDTH && column > LEFT)
            column = printf("\n%*s", LEFT - 1, "") - 1;
        column += printf(" %.*s", length, help);
        help += length + (help[length] == ' ');
    }
    putchar('\n');
}

void option_print(const option_set *set)
{
    for (int i = 0; i < set->count; i++) {
        const option *o = &set->table[i];
        char left[64];
        if (refusal(set, o))
            continue;
        snprintf(left, sizeof left, "%c%c%c --%s %s", o->letter ? '-' : ' ', o->letter ? o->letter : ' ',
                 o->letter ? ',' : ' ', o->name, o->value ? o->value : "");
        option_print_line(left, o->help);
    }
}
