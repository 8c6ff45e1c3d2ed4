/* SPDX-License-Identifier: MIT
 *
 * Tables of tab-separated values, one row a line. The first line is the command that made them, the second the machine
 * and what all rows share, the third the names of the columns. A cell that was not measured is empty.
 */
#pragma once

#include "context.h"
#include "options.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef struct table {
    FILE *file;
    char path[1024];
    bool row_begun;
} table;

/* Starts NAME.tsv in the output folder. `columns` are separated by spaces. False, with one line in `error`. */
bool table_begin(table *t, const options *o, const context *c, const char *name, const char *columns, failure *fault);
void table_text(table *t, const char *value);
void table_number(table *t, double value); /* not finite: an empty cell */
void table_numbers(table *t, const double *values, size_t count);
void table_end_row(table *t);
/* A cell for each of these numbers; the second macro ends the row after them. */
#define TABLE_NUMBERS(t, ...)                                                                                          \
    table_numbers(t, (const double[]){__VA_ARGS__}, sizeof((const double[]){__VA_ARGS__}) / sizeof(double))
#define TABLE_END_ROW(t, ...) (TABLE_NUMBERS(t, __VA_ARGS__), table_end_row(t))
/* Closes it; false, with one line in `error`, where it could not be written in full. */
bool table_end(table *t, failure *fault);
