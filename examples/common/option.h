/* SPDX-License-Identifier: MIT
 *
 * Parses command lines with tables. A row says which member of a structure an option sets and what its value may be.
 * Long options are "--name value" or "--name=value", short ones "-n value" or "-nvalue". "--" ends the options.
 */
#pragma once

#include "fault.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct option_number {
    bool given;
    float value;
} option_number;

typedef struct option_vector {
    bool given;
    double value[3];
} option_vector;

typedef struct option_pair {
    bool given;
    double value[2];
} option_pair;

typedef struct option_matrix {
    bool given;
    double value[16];
} option_matrix;

/* The type of the member that an option sets. */
typedef enum option_kind {
    OPTION_FLAG,        /* bool */
    OPTION_INT,         /* int, min to max */
    OPTION_INT_OR_NONE, /* the same, or -1 for "none" */
    OPTION_SEED,        /* uint32_t, min to max */
    OPTION_FLOAT,       /* float, min to max */
    OPTION_NUMBER,      /* option_number, min to max */
    OPTION_VECTOR,      /* option_vector */
    OPTION_PAIR,        /* option_pair: two numbers with a comma between them, both min to max */
    OPTION_MATRIX,      /* option_matrix: 16 numbers with commas between them */
    OPTION_SIZE,        /* int[2], both min to max: "640x480" */
    OPTION_SHARD,       /* int[2], the second min to max, the first below it: "0/4" */
    OPTION_WORD,        /* int: index into the words that `wanted` lists */
    OPTION_TEXT,        /* const char * */
    OPTION_FILE         /* const char *, a file name with one of the endings that `wanted` lists; "": any. The
                                   word "-" in the list allows the name "-" */
} option_kind;

typedef struct option {
    char letter; /* 0: none */
    const char *name;
    const char *value; /* name of the value in the help; NULL for a flag */
    const char *help;
    option_kind kind;
    size_t offset; /* of the member that it sets */
    double min, max;
    const char *wanted; /* completes "must be ..."; NULL: the kind's own words with min and max */
    int scope;          /* index into option_set.refused */
} option;

typedef struct option_set {
    const option *table;
    int count;
    const char *const *refused; /* for each scope, why its options are refused, or NULL; NULL: none are */
    const char *operand;        /* "scene": what an argument names that is no option; NULL: no such argument */
    size_t operand_offset;      /* of a const char * */
} option_set;

/* Parses the arguments from argv[1] on into the structure at `out`. Its strings live as long as argv. False, with one
 * line in `why` that names the option and the value, if one is wrong. */
bool option_parse(const option_set *set, int argc, char **argv, void *out, failure *why);

/* Whether two of these structures differ in the member that the option sets. Texts are compared as pointers. */
bool option_differs(const option *o, const void *a, const void *b);

/* Prints each option that is not refused to stdout. */
void option_print(const option_set *set);
/* Prints a name and its help in the same columns, in lines of at most 100 characters. */
void option_print_line(const char *left, const char *help);
