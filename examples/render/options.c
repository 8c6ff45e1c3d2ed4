/* SPDX-License-Identifier: MIT
 *
 * Parses command lines, and the lines of a batch, by option_table.c.
 */
#include "options.h"

#include "option_table.h"

#include <stdio.h>
#include <string.h>

/* One option with its value, which may be the next argument; *at moves past what was read. */
static bool parse_option(int argc, char **argv, int *at, options_program program, options *out, char *error,
                         size_t error_size)
{
    const char *argument = argv[(*at)++];
    const bool is_long = argument[1] == '-';
    const size_t name_length = is_long ? strcspn(argument + 2, "=") : 1;
    const option *o = is_long ? option_find(argument + 2, name_length) : option_find_letter(argument[1]);
    if (!o) {
        snprintf(error, error_size, "unknown option %s", argument);
        return false;
    }
    if (program == OPTIONS_VIEWER && !option_is_viewers(o)) {
        snprintf(error, error_size, "--%s: glssao-render takes it, glssao-view does not", o->name);
        return false;
    }
    if (program == OPTIONS_JOB && o->scope >= SCOPE_RUN) {
        snprintf(error, error_size, "--%s: of the whole run, not of a job in a list", o->name);
        return false;
    }
    const char *rest = is_long ? argument + 2 + name_length : argument + 2;
    const char *value = NULL;
    if (*rest) {
        value = is_long ? rest + 1 : rest;
    }
    if (o->kind == KIND_FLAG && value) {
        snprintf(error, error_size, "--%s takes no value, but got \"%s\"", o->name, value);
        return false;
    }
    if (o->kind != KIND_FLAG && !value) {
        if (*at >= argc) {
            snprintf(error, error_size, "--%s: its value %s is missing", o->name, o->value);
            return false;
        }
        value = argv[(*at)++];
    }
    if (!option_take(o, value, out)) {
        const char *form = o->kind == KIND_FILE && o->wanted[0] ? "a file name ending in "
                           : o->kind == KIND_FILE               ? "a file name"
                           : o->kind == KIND_WORD               ? "one of "
                                                                : "";
        snprintf(error, error_size, "--%s \"%s\": must be %s%s", o->name, value, form, o->wanted);
        return false;
    }
    return true;
}

static bool parse_all(int argc, char **argv, options_program program, options *out, char *error, size_t error_size)
{
    bool options_end = false;
    for (int at = 1; at < argc;) {
        if (!options_end && argv[at][0] == '-' && argv[at][1] != '\0') {
            if (strcmp(argv[at], "--") == 0) {
                options_end = true;
                at++;
            } else if (!parse_option(argc, argv, &at, program, out, error, error_size)) {
                return false;
            }
        } else if (out->scene_path) {
            snprintf(error, error_size, "two scene files, %s and %s", out->scene_path, argv[at]);
            return false;
        } else {
            out->scene_path = argv[at++];
        }
    }
    return true;
}

static options_result parse(int argc, char **argv, options_program program, options *out, char *error,
                            size_t error_size)
{
    const bool viewer = program == OPTIONS_VIEWER;
    *out = (options){.width = 1280,
                     .height = 720,
                     .quality = GLSSAO_HIGH,
                     .technique = GLSSAO_HORIZON,
                     .blur_rounds = -1,
                     .cache_mib = 1024};
    if (!parse_all(argc, argv, program, out, error, error_size)) {
        return OPTIONS_WRONG;
    }
    if (out->help) {
        option_print_help(
            viewer
                ? "usage: glssao-view [options] [scene.gltf|scene.glb]\n"
                  "Shows a glTF scene, or a built-in one, with screen-space ambient occlusion, in a window. F1 there "
                  "shows\nthe keys. The options mean what they mean to glssao-render; --output is where pictures are "
                  "saved.\n"
                : "usage: glssao-render [options] [scene.gltf|scene.glb]\n"
                  "       glssao-render [options] --batch LIST [--shard I/N]\n"
                  "Renders a glTF scene, or a built-in one, with screen-space ambient occlusion, without a display.\n",
            viewer ? "\nExit code: 0 done, 1 no window or no scene, 2 wrong usage."
                   : "\nExit code: 0 done, 1 could not render (of a batch: all of it), 2 wrong usage.",
            viewer);
        return OPTIONS_DONE;
    }
    if (out->version) {
        const uint32_t v = glssao_version();
        printf("%s %d.%d.%d (library %u.%u.%u)\n", viewer ? "glssao-view" : "glssao-render", GLSSAO_VERSION_MAJOR,
               GLSSAO_VERSION_MINOR, GLSSAO_VERSION_PATCH, v >> 16, v >> 8 & 255, v & 255);
        return OPTIONS_DONE;
    }
    if (!options_check(out, program, error, error_size)) {
        return OPTIONS_WRONG;
    }
    if (!out->scene_path && !out->scene_name) {
        out->scene_name = "columns";
    }
    return OPTIONS_RUN;
}

options_result options_parse(int argc, char **argv, options *out, char *error, size_t error_size)
{
    return parse(argc, argv, OPTIONS_RENDER, out, error, error_size);
}

options_result options_parse_for_viewer(int argc, char **argv, options *out, char *error, size_t error_size)
{
    return parse(argc, argv, OPTIONS_VIEWER, out, error, error_size);
}

bool options_parse_job(const options *defaults, int argc, char **argv, options *out, char *error, size_t error_size)
{
    *out = *defaults;
    out->scene_path = out->scene_name = NULL;
    if (!parse_all(argc, argv, OPTIONS_JOB, out, error, error_size)) {
        return false;
    }
    if (!out->scene_path && !out->scene_name) {
        out->scene_path = defaults->scene_path;
        out->scene_name = defaults->scene_name;
    }
    return options_check(out, OPTIONS_JOB, error, error_size);
}
