/* SPDX-License-Identifier: MIT
 *
 * Parses command lines and lines of a batch with the table in options_table.c.
 */
#include "options.h"

#include "options_internal.h"
#include "setting_table.h"

#include <stdio.h>

const char *options_name(options_program program)
{
    return program == OPTIONS_VIEWER ? "glssao-view" : "glssao-render";
}

/* Prints the options, and the settings of --set. */
static void print_help(options_program program)
{
    const option_set set = options_set(program);
    puts(program == OPTIONS_VIEWER
             ? "usage: glssao-view [options] [scene.gltf|scene.glb]\n"
               "Shows a glTF scene or a built-in scene with screen-space ambient occlusion in a window. F1 lists the "
               "keys.\n--output names the file for Ctrl+S; all other options mean the same as for glssao-render.\n"
             : "usage: glssao-render [options] [scene.gltf|scene.glb]\n"
               "       glssao-render [options] --batch LIST [--shard I/N]\n"
               "Renders a glTF scene or a built-in scene with screen-space ambient occlusion. It needs no display.\n"
               "The scene - reads a glTF file from standard input.\n"
               "With --depth-in, it estimates the occlusion of a depth map instead.\n");
    option_print(&set);
    puts("\nSettings for --set, such as --set blur=none,half=off:");
    for (int i = 0; i < setting_count; i++) {
        const setting *s = &setting_table[i];
        const char *words = s->words ? s->words : s->kind == SETTING_SWITCH ? "off|on" : "";
        char help[256];
        snprintf(help, sizeof help, "%s%s%s%s%s%s", s->help, s->unit[0] ? " (" : "", s->unit, s->unit[0] ? ")" : "",
                 words[0] ? ": " : "", words);
        option_print_line(s->name, help);
    }
    puts(program == OPTIONS_VIEWER ? "\nExit code: 0 success, 1 no window or no scene, 2 wrong usage."
                                   : "\nExit code: 0 success, 1 a picture could not be rendered, 2 wrong usage.");
}

static options_result parse(int argc, char **argv, options_program program, options *out, failure *why)
{
    *out = (options){.width = 1280,
                     .height = 720,
                     .quality = GLSSAO_HIGH,
                     .technique = GLSSAO_HORIZON,
                     .blur_rounds = -1,
                     .history = -1,
                     .cache_mib = 1024};
    const options start = *out;
    const option_set set = options_set(program);
    if (!option_parse(&set, argc, argv, out, why))
        return OPTIONS_WRONG;
    if (out->help) {
        print_help(program);
        return OPTIONS_DONE;
    }
    if (out->version) {
        const uint32_t v = glssao_version();
        printf("%s %d.%d.%d (library %u.%u.%u)\n", options_name(program), GLSSAO_VERSION_MAJOR, GLSSAO_VERSION_MINOR,
               GLSSAO_VERSION_PATCH, v >> 16, v >> 8 & 255, v & 255);
        return OPTIONS_DONE;
    }
    if (!options_check_depth_map(&start, out, program, why) || !options_check(out, program, why))
        return OPTIONS_WRONG;
    if (!out->scene_path && !out->scene_name && !out->depth_in)
        out->scene_name = "columns";
    return OPTIONS_RUN;
}

options_result options_parse(int argc, char **argv, options *out, failure *why)
{
    return parse(argc, argv, OPTIONS_RENDER, out, why);
}

options_result options_parse_for_viewer(int argc, char **argv, options *out, failure *why)
{
    const options_result result = parse(argc, argv, OPTIONS_VIEWER, out, why);
    out->history = out->history < 0 ? 16 : out->history;
    return result;
}

bool options_parse_job(const options *defaults, int argc, char **argv, options *out, failure *why)
{
    *out = *defaults;
    out->scene_path = out->scene_name = NULL;
    const option_set set = options_set(OPTIONS_JOB);
    if (!option_parse(&set, argc, argv, out, why))
        return false;
    if (out->scene_path || out->scene_name) {
        out->depth_in = out->depth_in == defaults->depth_in ? NULL : out->depth_in;
    } else if (!out->depth_in) {
        out->scene_path = defaults->scene_path;
        out->scene_name = defaults->scene_name;
    }
    return options_check_depth_map(defaults, out, OPTIONS_JOB, why) && options_check(out, OPTIONS_JOB, why);
}
