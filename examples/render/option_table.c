/* SPDX-License-Identifier: MIT
 *
 * Every option, once: the parser and the help text read this.
 */
#include "option_table.h"

#include "setting_table.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

#define AT(member) offsetof(options, member)
const option option_table[] = {
    {'o', "output", "FILE.png", "shaded picture", KIND_FILE, AT(output), 0, 0, ".png", SCOPE_PICTURE},
    {0, "ao", "FILE.png|.pfm", "accessibility (pfm: float32, linear), full size", KIND_FILE, AT(ao), 0, 0, ".png|.pfm",
     SCOPE_RENDERED},
    {0, "normals", "FILE.png", "view-space normals, n * 0.5 + 0.5", KIND_FILE, AT(normals), 0, 0, ".png",
     SCOPE_RENDERED},
    {0, "depth", "FILE.pfm", "view distance, 0 where nothing is", KIND_FILE, AT(depth), 0, 0, ".pfm", SCOPE_RENDERED},
    {'s', "size", "WxH", "picture size in pixels (1280x720)", KIND_SIZE, AT(width), 1, 16384,
     "WxH with sides from 1 to 16384", SCOPE_PICTURE},
    {'q', "quality", "NAME", "low, medium, high or ultra (high)", KIND_WORD, AT(quality), 0, 0, "low|medium|high|ultra",
     SCOPE_PICTURE},
    {'t', "technique", "NAME", "classic, hemisphere, horizon or raytrace (horizon)", KIND_WORD, AT(technique), 0, 0,
     "classic|hemisphere|horizon|raytrace", SCOPE_PICTURE},
    {0, "radius", "R", "occlusion radius in scene units (suits the scene)", KIND_NUMBER, AT(radius), 0, 1e11,
     "a number from 0 to 1e11", SCOPE_PICTURE},
    {0, "power", "P", "contrast, 0 to 64", KIND_NUMBER, AT(power), 0, 64, "a number from 0 to 64", SCOPE_PICTURE},
    {0, "samples", "N", "classic 1 to 14, hemisphere 1 to 64, horizon 12, 16, 24, 32, 48 or 64, raytrace rays (512)",
     KIND_INT, AT(sample_count), 1, 65536, "a whole number from 1 to 65536", SCOPE_PICTURE},
    {0, "blur-rounds", "N", "0 to 16", KIND_INT, AT(blur_rounds), 0, 16, "a whole number from 0 to 16", SCOPE_PICTURE},
    {0, "error", "E", "horizon: adds up estimates until their sampling error is at most E", KIND_NUMBER, AT(error),
     1e-6, 1, "a number from 0.000001 to 1", SCOPE_PICTURE},
    {0, "budget", "MS", "horizon: adds up estimates for MS milliseconds a frame", KIND_NUMBER, AT(budget_ms), 0.001,
     1e9, "a number of milliseconds above 0", SCOPE_PICTURE},
    {0, "margin", "N", "draws N pixels more on each side, even, for occluders beyond the edge (0)", KIND_INT,
     AT(margin), 0, 4096, "an even whole number from 0 to 4096", SCOPE_RENDERED},
    {0, "layers", "N", "horizon: 2 also draws what lies behind the surfaces seen, to read thickness from (1)", KIND_INT,
     AT(layers), 1, 2, "1 or 2", SCOPE_PICTURE},
    {0, "set", "NAME=V,...", "any of the settings that --help lists at its end", KIND_TEXT, AT(set), 0, 0, "",
     SCOPE_PICTURE},
    {0, "eye", "X,Y,Z", "where the camera stands (default: frames the scene)", KIND_VECTOR, AT(eye), 0, 0,
     "three numbers X,Y,Z", SCOPE_PICTURE},
    {0, "target", "X,Y,Z", "what it looks at", KIND_VECTOR, AT(target), 0, 0, "three numbers X,Y,Z", SCOPE_PICTURE},
    {0, "up", "X,Y,Z", "which way is up", KIND_VECTOR, AT(up), 0, 0, "three numbers X,Y,Z", SCOPE_PICTURE},
    {0, "fov", "DEGREES", "vertical field of view", KIND_NUMBER, AT(fov_deg), 0.01, 179, "a number from 0.01 to 179",
     SCOPE_PICTURE},
    {0, "near", "N", "near plane in scene units (fitted to the scene)", KIND_NUMBER, AT(near_plane), FLT_MIN, FLT_MAX,
     "a number above 0", SCOPE_PICTURE},
    {0, "far", "F", "far plane in scene units (fitted to the scene)", KIND_NUMBER, AT(far_plane), FLT_MIN, FLT_MAX,
     "a number above 0", SCOPE_PICTURE},
    {0, "camera", "N", "the scene's N-th camera (the first, where it has one)", KIND_INT, AT(camera), 1, 1e9,
     "a whole number from 1", SCOPE_PICTURE},
    {0, "time", "SECONDS", "the file's first animation at this time (the file as it stands)", KIND_NUMBER, AT(time_s),
     0, 1e9, "a number of seconds from 0 to 1e9", SCOPE_PICTURE},
    {0, "scene", "NAME", "built-in scene: columns, cornell, steps or plane (columns)", KIND_TEXT, AT(scene_name), 0, 0,
     "", SCOPE_PICTURE},
    {0, "context", "KIND", "auto, egl or osmesa (auto)", KIND_WORD, AT(context), 0, 0, "auto|egl|osmesa",
     SCOPE_RENDERED_RUN},
    {0, "path", "WAY", "compute or fragment shaders: auto, fragment or compute (auto)", KIND_WORD, AT(path), 0, 0,
     "auto|fragment|compute", SCOPE_PICTURE},
    {0, "frames", "N", "turntable: N pictures a full turn, FILE-0001.png and so on", KIND_INT, AT(frames), 1, 100000,
     "a whole number from 1 to 100000", SCOPE_RENDERED},
    {0, "bench", "N", "draws N frames and prints their times", KIND_INT, AT(bench), 1, 100000,
     "a whole number from 1 to 100000", SCOPE_RENDERED_RUN},
    {0, "stats", "FILE.json", "what was drawn and where the time went", KIND_FILE, AT(stats), 0, 0, "", SCOPE_RENDERED},
    {0, "plan", NULL, "prints which passes run, and why", KIND_FLAG, AT(plan), 0, 0, NULL, SCOPE_RENDERED},
    {0, "no-ao", NULL, "no occlusion pass at all", KIND_FLAG, AT(no_ao), 0, 0, NULL, SCOPE_PICTURE},
    {0, "no-shadows", NULL, "direct light goes through everything", KIND_FLAG, AT(no_shadows), 0, 0, NULL,
     SCOPE_PICTURE},
    {0, "shadow-size", "N", "side of the shadow map in texels (2048)", KIND_INT, AT(shadow_size), 1, 16384,
     "a whole number from 1 to 16384", SCOPE_PICTURE},
    {0, "mapped-normals", NULL, "occlusion sees normal maps (it sees the mesh alone)", KIND_FLAG, AT(mapped_normals), 0,
     0, NULL, SCOPE_PICTURE},
    {0, "specular-occlusion", NULL, "occlusion darkens reflections by their lobe", KIND_FLAG, AT(specular_occlusion), 0,
     0, NULL, SCOPE_PICTURE},
    {0, "multi-bounce", NULL, "occluded light takes on the surface's colour", KIND_FLAG, AT(multi_bounce), 0, 0, NULL,
     SCOPE_PICTURE},
    {0, "environment", "FILE", "equirectangular picture (.hdr, .png, .jpg) that lights the scene, and its sky",
     KIND_FILE, AT(environment), 0, 0, ".hdr|.pic|.png|.jpg|.jpeg", SCOPE_PICTURE},
    {0, "debug-map", "NAME", "in the picture's lower right: ao, normals, depth, random, shadow or tiles", KIND_WORD,
     AT(debug_map), 0, 0, "none|ao|normals|depth|random|shadow|tiles", SCOPE_PICTURE},
    {0, "batch", "LIST", "renders each line of LIST (-: standard input), which holds options and a scene as here",
     KIND_FILE, AT(batch), 0, 0, "", SCOPE_RENDERED_RUN},
    {0, "shard", "I/N", "of a batch, every N-th job from the I-th on, which counts from 0", KIND_SHARD, AT(shard_index),
     1, 1000000, "I/N with I from 0 to N-1", SCOPE_RENDERED_RUN},
    {0, "cache", "MIB", "of a batch, how large scenes kept for later jobs may be (1024)", KIND_INT, AT(cache_mib), 0,
     1048576, "a whole number from 0 to 1048576", SCOPE_RENDERED_RUN},
    {0, "program-cache", "DIR", "a folder where the effect's linked programs are kept for the next run", KIND_FILE,
     AT(program_cache), 0, 0, "", SCOPE_RUN},
    {0, "seed", "N", "of every random input (0)", KIND_SEED, AT(seed), 0, 4294967295.0,
     "a whole number from 0 to 4294967295", SCOPE_PICTURE},
    {'h', "help", NULL, "prints this", KIND_FLAG, AT(help), 0, 0, NULL, SCOPE_RUN},
    {0, "version", NULL, "prints the version", KIND_FLAG, AT(version), 0, 0, NULL, SCOPE_RUN},
};
const int option_count = sizeof option_table / sizeof option_table[0];

bool option_is_viewers(const option *o)
{
    return o->scope != SCOPE_RENDERED && o->scope != SCOPE_RENDERED_RUN;
}

const option *option_find(const char *name, size_t length)
{
    for (int i = 0; i < option_count; i++) {
        if (strlen(option_table[i].name) == length && memcmp(option_table[i].name, name, length) == 0) {
            return &option_table[i];
        }
    }
    return NULL;
}

const option *option_find_letter(char letter)
{
    for (int i = 0; i < option_count; i++) {
        if (option_table[i].letter && option_table[i].letter == letter) {
            return &option_table[i];
        }
    }
    return NULL;
}

static void print_options(bool for_viewer)
{
    for (int i = 0; i < option_count; i++) {
        const option *o = &option_table[i];
        char left[64];
        if (for_viewer && !option_is_viewers(o)) {
            continue;
        }
        snprintf(left, sizeof left, "%c%c%c --%s %s", o->letter ? '-' : ' ', o->letter ? o->letter : ' ',
                 o->letter ? ',' : ' ', o->name, o->value ? o->value : "");
        printf("  %-28s %s\n", left, o->help);
    }
}

void option_print_help(const char *usage, const char *end, bool for_viewer)
{
    puts(usage);
    print_options(for_viewer);
    puts("\nSettings for --set, such as --set blur=none,half=off:");
    for (int i = 0; i < setting_count; i++) {
        const setting *s = &setting_table[i];
        printf("  %-28s %s%s%s%s%s\n", s->name, s->help, s->unit[0] ? ", " : "", s->unit, s->words ? ": " : "",
               s->words                    ? s->words
               : s->kind == SETTING_SWITCH ? ": off|on"
                                           : "");
    }
    puts(end);
}
