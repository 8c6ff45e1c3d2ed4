/* SPDX-License-Identifier: MIT
 *
 * Splits the text of a list into jobs.
 */
#define _POSIX_C_SOURCE 200809L /* strdup */
#include "batch_list.h"

#include "read_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_LIST_BYTES = 1 << 30 };

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/* Splits a line into words, in place. Blanks separate words; '...', "..." and \ quote as in a shell; # before a word
 * starts a comment. `words` has room for half as many words as the line has characters, plus one. -1, with the fault,
 * if a quote does not end. */
static int split_line(char *line, char **words, const char **out_fault)
{
    const char *in = line;
    char *out = line; /* is never ahead of `in` */
    int count = 0;
    for (;;) {
        while (is_blank(*in))
            in++;
        if (*in == '\0' || *in == '#')
            return count;
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
        if (is_last)
            return count;
    }
}

/* Reads standard input, a FIFO or a regular file. NULL, with the reason, on failure. */
static char *read_text(const char *path, size_t *out_size, const char **out_reason)
{
    const bool is_standard = strcmp(path, "-") == 0;
    const int file = is_standard ? STDIN_FILENO : open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0) {
        *out_reason = strerror(errno);
        return NULL;
    }
    char *text = (char *)read_stream(file, MOST_LIST_BYTES, out_size, out_reason);
    if (!is_standard)
        close(file);
    return text;
}

/* False if memory is short. */
static bool add_job(batch_list *list, const options *defaults, int number, char *line)
{
    char error[8192];
    const char *reason = NULL;
    batch_job job = {.line = number};
    char **words = malloc((strlen(line) / 2 + 3) * sizeof *words);
    if (!words)
        return false;
    words[0] = line; /* in the place of the program's name */
    const int count = split_line(line, words + 1, &reason);
    if (count < 0)
        job.error = strdup(reason);
    else if (count > 0 && !options_parse_job(defaults, count + 1, words, &job.options, FAULT(error)))
        job.error = strdup(error);
    free(words);
    if (count == 0)
        return true;
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

bool batch_list_read(batch_list *list, const options *defaults, failure *why)
{
    size_t size = 0;
    *list = (batch_list){.count = 0};
    const char *reason;
    list->text = read_text(defaults->batch, &size, &reason);
    if (!list->text)
        return fault_set(why, "%s: %s", defaults->batch, reason);
    if (strlen(list->text) != size)
        return fault_set(why, "%s: contains a zero byte, so it is not text", defaults->batch);
    static const char byte_order_mark[] = "\xef\xbb\xbf"; /* as Windows editors write it */
    const size_t skipped = strncmp(list->text, byte_order_mark, 3) == 0 ? 3 : 0;
    int number = 1;
    bool room = true;
    for (char *line = list->text + skipped; room && *line; number++) {
        char *end = line + strcspn(line, "\n");
        char *next = *end ? end + 1 : end;
        *end = '\0';
        room = add_job(list, defaults, number, line);
        line = next;
    }
    if (!room || !batch_find_clashes(list))
        return fault_set(why, "%s: out of memory", defaults->batch);
    return true;
}

void batch_list_free(batch_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        free(list->jobs[i].error);
    free(list->jobs);
    free(list->text);
    *list = (batch_list){.count = 0};
}
