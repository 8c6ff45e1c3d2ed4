/* SPDX-License-Identifier: MIT
 *
 * Finds jobs of a list that write the same file, under any name. It looks at the whole list, whatever the shard, so
 * that all shards agree on the job that fails.
 */
#define _XOPEN_SOURCE 700 /* realpath, strdup */
#include "batch_list.h"

#include "outputs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

typedef struct written {
    char *name; /* without links and dots, if the file or its folder exists */
    size_t job;
} written;

typedef struct written_list {
    written *files;
    size_t count, room;
    size_t job;
} written_list;

/* The caller frees it. NULL if memory is short. */
static char *plain_name(const char *path)
{
    char *name = realpath(path, NULL);
    if (name)
        return name;
    const char *slash = strrchr(path, '/');
    char *folder = slash ? strdup(path) : strdup(".");
    if (!folder)
        return NULL;
    if (slash)
        folder[slash == path ? 1 : slash - path] = '\0';
    char *real = realpath(folder, NULL);
    free(folder);
    if (!real)
        return strdup(path); /* the file cannot be written, and the job will say so */
    const char *file = slash ? slash + 1 : path;
    const size_t size = strlen(real) + strlen(file) + 2;
    name = malloc(size);
    if (name)
        snprintf(name, size, "%s/%s", real, file);
    free(real);
    return name;
}

static bool add_file(const char *path, void *user)
{
    written_list *list = user;
    struct stat status;
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode))
        return true; /* several jobs may write to the same device */
    if (list->count == list->room) {
        const size_t room = list->room ? 2 * list->room : 256;
        written *grown = realloc(list->files, room * sizeof *grown);
        if (!grown)
            return false;
        list->files = grown;
        list->room = room;
    }
    written w = {plain_name(path), list->job};
    if (w.name)
        list->files[list->count++] = w;
    return w.name;
}

static int compare(const void *a, const void *b)
{
    const written *x = a, *y = b;
    const int order = strcmp(x->name, y->name);
    return order ? order : (x->job > y->job) - (x->job < y->job);
}

static bool mark(batch_list *list, const written_list *files)
{
    bool room = true;
    for (size_t first = 0, i = 1; i < files->count; i++) {
        const written *a = &files->files[first], *b = &files->files[i];
        if (strcmp(a->name, b->name) != 0) {
            first = i;
            continue;
        }
        batch_job *job = &list->jobs[b->job];
        if (!job->error) {
            char error[4352];
            snprintf(error, sizeof error, "%.4096s: line %d also writes this file", b->name, list->jobs[a->job].line);
            job->error = strdup(error);
            room = room && job->error;
        }
    }
    return room;
}

bool batch_find_clashes(batch_list *list)
{
    written_list files = {.count = 0};
    bool room = true;
    for (size_t i = 0; room && i < list->count; i++) {
        const batch_job *job = &list->jobs[i];
        files.job = i;
        room = job->error || (outputs_each(&job->options, add_file, &files) &&
                              (!job->options.stats || add_file(job->options.stats, &files)));
    }
    if (room && files.count) {
        qsort(files.files, files.count, sizeof *files.files, compare);
        room = mark(list, &files);
    }
    for (size_t i = 0; i < files.count; i++)
        free(files.files[i].name);
    free(files.files);
    return room;
}
