/* SPDX-License-Identifier: MIT
 *
 * From the list's text to its jobs.
 */
#define _POSIX_C_SOURCE 200809L /* strdup */
#include "batch_list.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/* Splits a line into words, in place: blanks separate; '...', "..." and \ quote as in a shell; # before a word starts a
 * comment. `words` has room for half as many as the line has characters, and one more. -1, with the fault, where a
 * quote has no end. */
static int split_line(char *line, char **words, const char **out_fault)
{
    const char *in = line;
    char *out = line; /* never overtakes `in` */
    int count = 0;
    for (;;) {
        while (is_blank(*in)) {
            in++;
        }
        if (*in == '\0' || *in == '#') {
            return count;
        }
        words[count++] = out;
        while (*in && !is_blank(*in)) {
            const char quote = *in == '\'' || *in == '"' ? *in : '\0';
            in += quote != '\0' || *in == '\\';
            if (!quote) {
                if (*in == '\0') {
                    *out_fault = "a \\ at its end quotes nothing";
                    return -1;
                }
                *out++ = *in++;
                continue;
            }
            while (*in && *in != quote) {
                in += quote == '"' && *in == '\\' && in[1] && strchr("\"\\$`", in[1]);
                *out++ = *in++;
            }
            if (*in == '\0') {
                *out_fault = quote == '"' ? "a \" without its other one" : "a ' without its other one";
                return -1;
            }
            in++;
        }
        const bool is_last = *in == '\0';
        in += !is_last;
        *out++ = '\0';
        if (is_last) {
            return count;
        }
    }
}

/* Of malloc, with a 0 behind it; NULL, with errno, on failure. */
static char *read_text(const char *path, size_t *out_size)
{
    FILE *file = strcmp(path, "-") == 0 ? stdin : fopen(path, "rb");
    char *text = NULL;
    size_t size = 0, room = 0;
    bool done = !file;
    while (!done) {
        if (room - size < 2) {
            room = room ? 2 * room : 65536;
            char *grown = realloc(text, room);
            if (!grown) {
                errno = ENOMEM;
                break;
            }
            text = grown;
        }
        const size_t got = fread(text + size, 1, room - size - 1, file);
        size += got;
        done = got == 0;
    }
    const int code = errno;
    const bool whole = file && done && !ferror(file);
    if (file && file != stdin) {
        fclose(file);
    }
    if (!whole) {
        free(text);
        errno = code;
        return NULL;
    }
    text[size] = '\0';
    *out_size = size;
    return text;
}

/* False where memory is short. */
static bool add_job(batch_list *list, const options *defaults, int number, char *line)
{
    char error[8192];
    const char *fault = NULL;
    batch_job job = {.line = number};
    char **words = malloc((strlen(line) / 2 + 3) * sizeof *words);
    if (!words) {
        return false;
    }
    words[0] = line; /* where a program's name would stand */
    const int count = split_line(line, words + 1, &fault);
    if (count < 0) {
        job.error = strdup(fault);
    } else if (count > 0 && !options_parse_job(defaults, count + 1, words, &job.options, error, sizeof error)) {
        job.error = strdup(error);
    }
    free(words);
    if (count == 0) {
        return true;
    }
    if (list->count % 64 == 0) {
        batch_job *grown = realloc(list->jobs, (list->count + 64) * sizeof *grown);
        if (!grown) {
            free(job.error);
            return false;
        }
        list->jobs = grown;
    }
    list->jobs[list->count++] = job;
    return true;
}

bool batch_list_read(batch_list *list, const options *defaults, char *error, size_t error_size)
{
    size_t size = 0;
    *list = (batch_list){.count = 0};
    errno = 0;
    list->text = read_text(defaults->batch, &size);
    if (!list->text) {
        snprintf(error, error_size, "%s: %s", defaults->batch, strerror(errno));
        return false;
    }
    if (strlen(list->text) != size) {
        snprintf(error, error_size, "%s: holds a byte of 0: it is no text", defaults->batch);
        return false;
    }
    int number = 1;
    bool room = true;
    for (char *line = list->text; room && *line; number++) {
        char *end = line + strcspn(line, "\n");
        char *next = *end ? end + 1 : end;
        *end = '\0';
        room = add_job(list, defaults, number, line);
        line = next;
    }
    if (!room || !batch_find_clashes(list)) {
        snprintf(error, error_size, "%s: out of memory", defaults->batch);
        return false;
    }
    return true;
}

void batch_list_free(batch_list *list)
{
    for (size_t i = 0; i < list->count; i++) {
        free(list->jobs[i].error);
    }
    free(list->jobs);
    free(list->text);
    *list = (batch_list){.count = 0};
}
