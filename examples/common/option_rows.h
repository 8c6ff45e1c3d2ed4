/* SPDX-License-Identifier: MIT
 *
 * Rows of an option table, for the file that defines it. AT(member) must be the offset in the options' structure. A
 * file name's `endings` are as in option.wanted.
 */
#pragma once

#include "option.h"

#define ROW(letter, name, value, kind, scope, member, min, max, wanted, help)                                          \
    {                                                                                                                  \
        letter, name, value, help, OPTION_##kind, AT(member), min, max, wanted, scope                                  \
    }
#define FLAG(letter, name, scope, member, help) ROW(letter, name, NULL, FLAG, scope, member, 0, 0, NULL, help)
#define TEXT(name, value, scope, member, help) ROW(0, name, value, TEXT, scope, member, 0, 0, NULL, help)
#define WORD(name, value, scope, member, words, help) ROW(0, name, value, WORD, scope, member, 0, 0, words, help)
#define VECTOR(name, scope, member, help) ROW(0, name, "X,Y,Z", VECTOR, scope, member, 0, 0, NULL, help)
#define FILE_NAME(name, value, scope, member, endings, help)                                                           \
    ROW(0, name, value, FILE, scope, member, 0, 0, endings, help)
#define RANGE(kind, name, value, scope, member, min, max, help)                                                        \
    ROW(0, name, value, kind, scope, member, min, max, NULL, help)
