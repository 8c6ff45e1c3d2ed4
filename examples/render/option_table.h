/* SPDX-License-Identifier: MIT
 *
 * What options.c, option_value.c and options_check.c share: the table of options. Nobody else includes it.
 */
#ifndef GLSSAO_EXAMPLES_OPTION_TABLE_H
#define GLSSAO_EXAMPLES_OPTION_TABLE_H

#include "options.h"

#include <stddef.h>

typedef enum option_kind {
    KIND_FLAG,   /* bool */
    KIND_INT,    /* int, min to max */
    KIND_SEED,   /* uint32_t */
    KIND_NUMBER, /* options_number, min to max */
    KIND_VECTOR, /* options_vector */
    KIND_SIZE,   /* width, and height behind it */
    KIND_SHARD,  /* index, and count behind it, min to max */
    KIND_WORD,   /* int: index into the words that `wanted` lists */
    KIND_TEXT,   /* const char * */
    KIND_FILE    /* const char *, ending as `wanted` lists; "" is any */
} option_kind;

typedef enum option_scope {
    SCOPE_PICTURE,     /* of one picture: also in a batch's lines */
    SCOPE_RENDERED,    /* the same, and not the viewer's */
    SCOPE_RUN,         /* of the whole run: on the command line alone */
    SCOPE_RENDERED_RUN /* the same, and not the viewer's */
} option_scope;

typedef struct option {
    char letter; /* 0: none */
    const char *name;
    const char *value; /* how the help calls it; NULL for a flag */
    const char *help;
    option_kind kind;
    size_t offset; /* into struct options */
    double min, max;
    const char *wanted; /* what the value must be, for the message */
    option_scope scope;
} option;

extern const option option_table[];
extern const int option_count;

bool option_is_viewers(const option *o);

/* NULL: none. */
const option *option_find(const char *name, size_t length);
const option *option_find_letter(char letter);

/* To stdout. */
void option_print_help(const char *usage, const char *end, bool for_viewer);

/* option_value.c: sets the option's member of *out. False where `text` is not what the option wants. */
bool option_take(const option *o, const char *text, options *out);
/* Index of `text` among words separated by '|', -1: none. */
int option_find_word(const char *words, const char *text);

/* options_check.c: what no value alone tells, and --set. False, with one line in `error`. */
bool options_check(const options *o, options_program program, char *error, size_t error_size);

#endif
