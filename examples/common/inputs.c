/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L /* strdup */
#include "inputs.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

struct input {
    char *path;
    dev_t device;
    ino_t number;
};

static _Thread_local inputs *recording;

void inputs_record(inputs *to)
{
    recording = to;
}

void inputs_note(int descriptor, const char *path)
{
    struct stat about;
    inputs *in = recording;
    if (!in || fstat(descriptor, &about) != 0 || !S_ISREG(about.st_mode))
        return;
    char *copy = strdup(path);
    struct input *grown = copy ? realloc(in->files, (in->count + 1) * sizeof *grown) : NULL;
    if (!grown) {
        free(copy);
        in->full = true;
        return;
    }
    grown[in->count++] = (struct input){copy, about.st_dev, about.st_ino};
    in->files = grown;
}

void inputs_free(inputs *in)
{
    for (size_t i = 0; i < in->count; i++)
        free(in->files[i].path);
    free(in->files);
    *in = (inputs){0};
}

void inputs_forget(inputs *in, const char *path)
{
    struct stat about;
    for (size_t i = 0; i < in->count && stat(path, &about) == 0; i++)
        if (in->files[i].device == about.st_dev && in->files[i].number == about.st_ino) {
            free(in->files[i].path);
            in->files[i--] = in->files[--in->count];
        }
}

bool inputs_spare(const inputs *in, const char *also, const char *path, fault *why)
{
    struct stat about, other;
    if (stat(path, &about) != 0 || !S_ISREG(about.st_mode))
        return true; /* there is nothing to overwrite */
    if (in->full)
        return fault_set(why, "%s: not enough memory to tell whether it is an input", path);
    const char *input =
        also && stat(also, &other) == 0 && about.st_dev == other.st_dev && about.st_ino == other.st_ino ? also : NULL;
    for (size_t i = 0; i < in->count && !input; i++)
        if (about.st_dev == in->files[i].device && about.st_ino == in->files[i].number)
            input = in->files[i].path;
    return !input || fault_set(why, "%s: would overwrite %s, which this job reads", path,
                               strcmp(path, input) == 0 ? "the file" : input);
}
