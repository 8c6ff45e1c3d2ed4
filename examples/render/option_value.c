/* SPDX-License-Identifier: MIT
 *
 * From an option's text to its value. Numbers must match in full.
 */
#include "option_table.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* strtod takes leading blanks, hexadecimal, "nan" and "inf"; a command line should not. */
static bool parse_number(const char *text, const char **out_end, double *out)
{
    if (!strchr("+-.0123456789", text[0]) || text[0] == '\0' || text[strcspn(text, "xXnN")] != '\0') {
        return false;
    }
    char *end;
    *out = strtod(text, &end);
    *out_end = end;
    return end != text && isfinite(*out) && fabs(*out) <= (double)FLT_MAX;
}

static bool parse_whole(const char *text, double min, double max, long long *out)
{
    if (text[0] == '\0' || text[strspn(text, "0123456789")] != '\0') {
        return false;
    }
    errno = 0;
    *out = strtoll(text, NULL, 10);
    return errno == 0 && (double)*out >= min && (double)*out <= max;
}

static bool parse_vector(const char *text, options_vector *out)
{
    for (int i = 0; i < 3; i++) {
        double value;
        if (!parse_number(text, &text, &value) || *text != (i < 2 ? ',' : '\0')) {
            return false;
        }
        out->value[i] = (float)value;
        text++;
    }
    out->given = true;
    return true;
}

/* Two whole numbers: a size, a shard. */
static bool parse_pair(const char *text, char between, const double min[2], double max, int out[2])
{
    char first[8];
    const char *x = strchr(text, between);
    if (!x || (size_t)(x - text) >= sizeof first) {
        return false;
    }
    memcpy(first, text, (size_t)(x - text));
    first[x - text] = '\0';
    long long a, b;
    if (!parse_whole(first, min[0], max, &a) || !parse_whole(x + 1, min[1], max, &b)) {
        return false;
    }
    out[0] = (int)a;
    out[1] = (int)b;
    return true;
}

int option_find_word(const char *words, const char *text)
{
    const size_t length = strlen(text);
    for (int i = 0; *words; i++) {
        const size_t word_length = strcspn(words, "|");
        if (word_length == length && memcmp(words, text, length) == 0) {
            return i;
        }
        words += word_length + (words[word_length] == '|');
    }
    return -1;
}

static bool ends_as_wanted(const char *path, const char *endings)
{
    const char *dot = strrchr(path, '.');
    return path[0] != '\0' && (endings[0] == '\0' || (dot && dot != path && option_find_word(endings, dot) >= 0));
}

bool option_take(const option *o, const char *text, options *out)
{
    void *target = (char *)out + o->offset;
    const char *end;
    double number;
    long long whole;
    switch (o->kind) {
    case KIND_FLAG:
        *(bool *)target = true;
        return true;
    case KIND_INT:
        if (!parse_whole(text, o->min, o->max, &whole)) {
            return false;
        }
        *(int *)target = (int)whole;
        return true;
    case KIND_SEED:
        if (!parse_whole(text, o->min, o->max, &whole)) {
            return false;
        }
        *(uint32_t *)target = (uint32_t)whole;
        return true;
    case KIND_NUMBER:
        if (!parse_number(text, &end, &number) || *end != '\0' || number < o->min || number > o->max) {
            return false;
        }
        *(options_number *)target = (options_number){true, (float)number};
        return true;
    case KIND_VECTOR:
        return parse_vector(text, target);
    case KIND_SIZE:
        return parse_pair(text, 'x', (double[]){o->min, o->min}, o->max, target);
    case KIND_SHARD:
        return parse_pair(text, '/', (double[]){0, o->min}, o->max, target) && ((int *)target)[0] < ((int *)target)[1];
    case KIND_WORD:
        *(int *)target = option_find_word(o->wanted, text);
        return *(int *)target >= 0;
    case KIND_FILE:
        if (!ends_as_wanted(text, o->wanted)) {
            return false;
        }
        break;
    case KIND_TEXT:
        break;
    }
    *(const char **)target = text;
    return true;
}
