/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700 /* realpath, fdopen */
#include "whole_file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Names of temporary files for whole_file_abandon_all. A name belongs to the code that takes it out of the table. */
enum { MOST_OPEN = 256 };
static _Atomic(char *) open_files[MOST_OPEN];

static void enter(char *name)
{
    for (int i = 0; i < MOST_OPEN; i++) {
        char *none = NULL;
        if (atomic_compare_exchange_strong(&open_files[i], &none, name))
            return;
    }
}

/* Takes a name out of the table. False if whole_file_abandon_all has taken it. */
static bool leave(char *name)
{
    for (int i = 0; i < MOST_OPEN; i++) {
        char *same = name;
        if (atomic_compare_exchange_strong(&open_files[i], &same, NULL))
            return true;
    }
    return false;
}

void whole_file_abandon_all(void)
{
    for (int i = 0; i < MOST_OPEN; i++) {
        const char *name = atomic_exchange(&open_files[i], NULL);
        if (name)
            unlink(name);
    }
}

void whole_file_remove_left(const char *path, long process)
{
    char start[64], *real = realpath(path, NULL);
    const char *whole = real ? real : path, *slash = strrchr(whole, '/');
    const char *file = slash ? slash + 1 : whole;
    const size_t file_length = strlen(file);
    char *folder = slash ? strndup(whole, slash == whole ? 1 : (size_t)(slash - whole)) : strdup(".");
    const int start_length = snprintf(start, sizeof start, ".%ld-", process);
    DIR *entries = folder ? opendir(folder) : NULL;
    for (struct dirent *e; entries && (e = readdir(entries));) {
        const size_t length = strlen(e->d_name);
        if (strncmp(e->d_name, file, file_length) == 0 &&
            strncmp(e->d_name + file_length, start, (size_t)start_length) == 0 && length > 5 &&
            strcmp(e->d_name + length - 5, ".part") == 0)
            unlinkat(dirfd(entries), e->d_name, 0);
    }
    if (entries)
        closedir(entries);
    free(folder);
    free(real);
}

/* Opens a file with a name that no other thread or process of this machine uses. O_EXCL guards against other machines.
 */
static FILE *open_temporary(const char *path, char **out_name)
{
    static atomic_uint count;
    const size_t size = strlen(path) + 64;
    char *name = malloc(size);
    if (!name)
        return NULL;
    snprintf(name, size, "%s.%ld-%u.part", path, (long)getpid(), atomic_fetch_add(&count, 1));
    enter(name); /* before the file exists: a signal may arrive at any time */
    const int descriptor = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    FILE *file = descriptor >= 0 ? fdopen(descriptor, "wb") : NULL;
    if (!file) {
        if (descriptor >= 0) {
            close(descriptor);
            remove(name);
        }
        if (leave(name))
            free(name);
        return NULL;
    }
    *out_name = name;
    return file;
}

bool whole_file_open(whole_file *f, const char *path, failure *fault)
{
    struct stat status;
    const bool exists = stat(path, &status) == 0;
    *f = (whole_file){.name = path};
    if (strcmp(path, "-") == 0) {
        f->name = "standard output";
        f->file = stdout;
        return true;
    }
    f->path = exists ? realpath(path, NULL) : NULL;
    if (!f->path) {
        f->path = malloc(strlen(path) + 1);
        if (!f->path)
            return fault_set(fault, "%s: out of memory", path);
        memcpy(f->path, path, strlen(path) + 1);
    }
    const bool is_regular = !exists || S_ISREG(status.st_mode);
    const bool is_protected = exists && access(f->path, W_OK) != 0; /* renaming would replace it all the same */
    if (is_regular && !is_protected) {
        f->file = open_temporary(f->path, &f->temporary);
        if (f->file && exists)
            (void)fchmod(fileno(f->file), status.st_mode & 07777);
    }
    if (!f->file)
        f->file = fopen(path, "wb");
    if (!f->file) {
        fault_set(fault, "%s: %s", path, strerror(errno));
        free(f->path);
        *f = (whole_file){.file = NULL};
    }
    return f->file;
}

bool whole_file_close(whole_file *f, bool written, failure *fault)
{
    struct stat status;
    if (f->file == stdout) {
        if (fflush(stdout) == 0 || !written)
            return written;
        fault_set(fault, "%s: %s", f->name, strerror(errno));
        (void)!freopen("/dev/null", "w", stdout); /* the loss is told once */
        return false;
    }
    const bool is_regular = fstat(fileno(f->file), &status) == 0 && S_ISREG(status.st_mode);
    if (fclose(f->file) != 0 && written) {
        fault_set(fault, "%s: %s", f->name, strerror(errno));
        written = false;
    }
    if (written && f->temporary && rename(f->temporary, f->path) != 0) {
        fault_set(fault, "%s: %s", f->name, strerror(errno));
        written = false;
    }
    if (!written && is_regular)
        remove(f->temporary ? f->temporary : f->path);
    if (!f->temporary || leave(f->temporary))
        free(f->temporary);
    free(f->path);
    *f = (whole_file){.file = NULL};
    return written;
}
