/* SPDX-License-Identifier: MIT */
#include "words.h"

#include <string.h>

int words_find_span(const char *words, const char *text, size_t length)
{
    for (int i = 0; *words; i++) {
        const size_t here = strcspn(words, "|");
        if (here == length && memcmp(words, text, length) == 0)
            return i;
        words += here + (words[here] == '|');
    }
    return -1;
}

int words_find(const char *words, const char *text)
{
    return words_find_span(words, text, strlen(text));
}

word words_at(const char *words, int index)
{
    word w = {""};
    for (int i = 0; i < index; i++)
        words += strcspn(words, "|") + 1;
    const size_t length = strcspn(words, "|");
    memcpy(w.text, words, length < sizeof w.text ? length : sizeof w.text - 1);
    return w;
}
