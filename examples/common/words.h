/* SPDX-License-Identifier: MIT
 *
 * Lists of words in one string, separated by '|', and the lists that several programs need.
 */
#pragma once

#include <stddef.h>

/* In the order of glssao_technique (those of screen space, and with rays), glssao_quality, glssao_blur, glssao_tiles
 * and glssao_path. */
#define TECHNIQUE_WORDS "classic|hemisphere|horizon"
#define ALL_TECHNIQUE_WORDS TECHNIQUE_WORDS "|rays"
#define QUALITY_WORDS "low|medium|high|ultra"
#define BLUR_WORDS "none|gaussian|bilateral|box|planar"
#define TILES_WORDS "auto|off|on"
#define PATH_WORDS "auto|fragment|compute"
#define CONTEXT_WORDS "auto|egl|osmesa" /* context_kind */
#define SCENE_WORDS "columns|cornell|steps|plane"

/* Index of the word that equals `text`; -1: none. */
int words_find(const char *words, const char *text);
/* The same for the first `length` characters of `text`. */
int words_find_span(const char *words, const char *text, size_t length);

/* Index of the ending (".png") that a file name has, in letters of either case; -1: none. */
int words_find_ending(const char *endings, const char *path);

typedef struct word {
    char text[32];
} word;

/* The word at that index, which must exist: printf("%s", words_at(QUALITY_WORDS, GLSSAO_LOW).text). */
word words_at(const char *words, int index);
