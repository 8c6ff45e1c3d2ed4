/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700 /* realpath, fdopen */
#include "whole_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* A name that no other thread or process of this machine uses; O_EXCL sees to the rest. */
static FILE *open_temporary(const char *path, char **out_name)
{
    static atomic_uint count;
    const size_t size = strlen(path) + 64;
    char *name = malloc(size);
    if (!name) {
        return NULL;
    }
    snprintf(name, size, "%s.%ld-%u.part", path, (long)getpid(), atomic_fetch_add(&count, 1));
    const int descriptor = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    FILE *file = descriptor >= 0 ? fdopen(descriptor, "wb") : NULL;
    if (!file) {
        if (descriptor >= 0) {
            close(descriptor);
            remove(name);
        }
        free(name);
        return NULL;
    }
    *out_name = name;
    return file;
}

bool whole_file_open(whole_file *f, const char *path, char *error, size_t error_size)
{
    struct stat status;
    const bool exists = stat(path, &status) == 0;
    *f = (whole_file){.name = path};
    f->path = exists ? realpath(path, NULL) : NULL;
    if (!f->path) {
        f->path = malloc(strlen(path) + 1);
        if (!f->path) {
            snprintf(error, error_size, "%s: out of memory", path);
            return false;
        }
        memcpy(f->path, path, strlen(path) + 1);
    }
    if (!exists || S_ISREG(status.st_mode)) {
        f->file = open_temporary(f->path, &f->temporary);
        if (f->file && exists) {
            (void)fchmod(fileno(f->file), status.st_mode & 07777);
        }
    }
    if (!f->file) {
        f->file = fopen(path, "wb");
    }
    if (!f->file) {
        snprintf(error, error_size, "%s: %s", path, strerror(errno));
        free(f->path);
        *f = (whole_file){.file = NULL};
    }
    return f->file;
}

bool whole_file_close(whole_file *f, bool written, char *error, size_t error_size)
{
    struct stat status;
    const bool is_regular = fstat(fileno(f->file), &status) == 0 && S_ISREG(status.st_mode);
    if (fclose(f->file) != 0 && written) {
        snprintf(error, error_size, "%s: %s", f->name, strerror(errno));
        written = false;
    }
    if (written && f->temporary && rename(f->temporary, f->path) != 0) {
        snprintf(error, error_size, "%s: %s", f->name, strerror(errno));
        written = false;
    }
    if (!written && is_regular) {
        remove(f->temporary ? f->temporary : f->path);
    }
    free(f->temporary);
    free(f->path);
    *f = (whole_file){.file = NULL};
    return written;
}
