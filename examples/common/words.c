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

int words_find_ending(const char *endings, const char *path)
{
    word lower = {""};
    const char *dot = strrchr(path, '.');
    if (!dot || dot == path || strlen(dot) >= sizeof lower.text)
        return -1;
    for (size_t i = 0; dot[i]; i++)
        lower.text[i] = dot[i] >= 'A' && dot[i] <= 'Z' ? (char)(dot[i] - 'A' + 'a') : dot[i];
    return words_find(endings, lower.text);
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
