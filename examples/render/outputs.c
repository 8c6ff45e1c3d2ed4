/* SPDX-License-Identifier: MIT
 *
 * Names and checks output files.
 */
#define _POSIX_C_SOURCE 200809L
#include "outputs.h"
#include "words.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PATH_LENGTH = 4096 };

/* "name.png" becomes "name-0012.png". */
static bool number_path(const char *path, int number, char *out, size_t out_size)
{
    const char *dot = strrchr(path, '.');
    const int stem = dot ? (int)(dot - path) : (int)strlen(path);
    const int length = number ? snprintf(out, out_size, "%.*s-%04d%s", stem, path, number, path + stem)
                              : snprintf(out, out_size, "%s", path);
    return length >= 0 && (size_t)length < out_size;
}

/* Returns 0, or the errno that writing the file would give. Creates no file. */
static int writing_error(const char *path)
{
    struct stat info;
    if (stat(path, &info) == 0) {
        if (S_ISDIR(info.st_mode))
            return EISDIR;
        return access(path, W_OK) == 0 ? 0 : errno;
    }
    char folder[PATH_LENGTH];
    const char *slash = strrchr(path, '/');
    const size_t length = slash ? (size_t)(slash - path) : 0;
    memcpy(folder, path, length);
    folder[length] = '\0';
    const char *name = length ? folder : slash ? "/" : ".";
    if (stat(name, &info) != 0)
        return errno;
    if (!S_ISDIR(info.st_mode))
        return ENOTDIR;
    return access(name, W_OK | X_OK) == 0 ? 0 : errno;
}

bool outputs_check(const options *o, failure *why)
{
    const char *const files[] = {o->output, o->ao, o->normals, o->depth, o->stats};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        if (!files[i] || strcmp(files[i], "-") == 0)
            continue;
        char path[PATH_LENGTH];
        const bool numbered = o->frames && files[i] != o->stats;
        const int code =
            number_path(files[i], numbered ? 1 : 0, path, sizeof path) ? writing_error(path) : ENAMETOOLONG;
        if (code)
            return fault_set(why, "%s: can't be written: %s", files[i], strerror(code));
    }
    return true;
}

bool outputs_take(const options *o, pipeline *p, const scene_view *view, int number, readback *r, writer_slip *slip,
                  failure *why)
{
    const pixel_kind ao_kind = o->ao && words_find_ending(".pfm", o->ao) >= 0 ? PIXELS_FLOAT : PIXELS_GREY8;
    const struct {
        const char *file;
        pipeline_output output;
        pixel_kind kind;
    } outputs[] = {{o->output, PIPELINE_PICTURE, p->transparent ? PIXELS_RGBA8_STRAIGHT : PIXELS_RGBA8},
                   {o->ao, PIPELINE_AO, ao_kind},
                   {o->normals, PIPELINE_NORMALS, PIXELS_RGBA8},
                   {o->depth, PIPELINE_VIEW_DISTANCE, PIXELS_FLOAT}};
    for (size_t i = 0; i < sizeof outputs / sizeof outputs[0]; i++) {
        char path[PATH_LENGTH];
        if (!outputs[i].file)
            continue;
        number_path(outputs[i].file, number, path, sizeof path); /* outputs_check made sure that it fits */
        if (!readback_take(r, p, outputs[i].output, outputs[i].kind, view, path, slip, why))
            return false;
    }
    return true;
}

bool outputs_each(const options *o, bool (*visit)(const char *path, void *user), void *user)
{
    const char *const files[] = {o->output, o->ao, o->normals, o->depth};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        const int last = o->frames ? o->frames : 1;
        for (int frame = 1; files[i] && frame <= last; frame++) {
            char path[PATH_LENGTH];
            if (number_path(files[i], o->frames ? frame : 0, path, sizeof path) && !visit(path, user))
                return false;
        }
    }
    return true;
}

typedef struct spare {
    const options *options;
    const inputs *read;
    failure *why;
} spare;

static bool spare_inputs(const char *path, void *user)
{
    const spare *s = user;
    static const inputs none = {0};
    return inputs_spare(s->read, s->options->environment, path, s->why) &&
           inputs_spare(&none, s->options->batch, path, s->why) &&
           inputs_spare(&none, s->options->depth_in, path, s->why) &&
           inputs_spare(&none, s->options->normals_in, path, s->why);
}

bool outputs_spare_inputs(const options *o, const inputs *read, failure *why)
{
    spare s = {o, read, why};
    return outputs_each(o, spare_inputs, &s) && (!o->stats || spare_inputs(o->stats, &s));
}
