/* SPDX-License-Identifier: MIT
 *
 * The command line of glssao-bake.
 */
#include "bake.h"
#include "option.h"

#include <glssao/glssao.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define AT(member) offsetof(bake_options, member)
static const option table[] = {
    {'o', "output", "FILE.glb", "the scene with COLOR_0 multiplied by accessibility", OPTION_FILE, AT(output), 0, 0,
     ".glb", 0},
    {0, "in-place", NULL, "replaces the scene, a .glb file, by the result; without it the scene is never overwritten",
     OPTION_FLAG, AT(in_place), 0, 0, NULL, 0},
    {0, "rays", "N", "rays a triangle, vertex or point, 1 to 65536 (32)", OPTION_INT, AT(rays), 1, 65536,
     "a whole number from 1 to 65536", 0},
    {0, "distance", "R", "hits farther away do not block, scene units (no limit)", OPTION_FLOAT, AT(distance), 0,
     FLT_MAX, "a number, 0 or more", 0},
    {0, "cosine", NULL, "rays cosine-weighted about the normal (uniform over the hemisphere)", OPTION_FLAG, AT(cosine),
     0, 0, NULL, 0},
    {0, "vertices", NULL, "casts from the vertices (from each triangle's centroid)", OPTION_FLAG, AT(vertices), 0, 0,
     NULL, 0},
    {0, "fit", NULL, "casts from points all over the triangles, and fits the vertices' values to them", OPTION_FLAG,
     AT(fit), 0, 0, NULL, 0},
    {0, "offset", "D", "rays start this far off the surface, scene units (suits the scene)", OPTION_FLOAT, AT(offset),
     0, FLT_MAX, "a number, 0 or more", 0},
    {0, "floor", "V", "raises lower accessibility to V, 0 to 1 (0)", OPTION_FLOAT, AT(floor_value), 0, 1,
     "a number from 0 to 1", 0},
    {0, "accessibility-only", NULL, "leaves out the colours that the vertices have", OPTION_FLAG,
     AT(accessibility_only), 0, 0, NULL, 0},
    {0, "seed", "N", "of every random input (0)", OPTION_SEED, AT(seed), 0, 4294967295.0,
     "a whole number from 0 to 4294967295", 0},
    {0, "threads", "N", "1 to 256 (as many as there are cores)", OPTION_INT, AT(threads), 1, 256,
     "a whole number from 1 to 256", 0},
    {0, "gltf-scene", "N", "the file's N-th scene (the one that the file shows)", OPTION_INT, AT(file.scene), 1, 1e9,
     "a whole number from 1", 0},
    {0, "root", "DIR", "files that the scene names may lie below DIR, too (only below the scene's own folder)",
     OPTION_FILE, AT(file.root), 0, 0, "", 0},
    {0, "strict", NULL, "refuses a scene for which there would be a warning", OPTION_FLAG, AT(file.strict), 0, 0, NULL,
     0},
    {0, "memory", "MIB", "the most memory that loading the scene may take (half of the machine's)", OPTION_INT,
     AT(memory_mib), 1, 1e9, "a whole number from 1", 0},
    {'h', "help", NULL, "prints this", OPTION_FLAG, AT(help), 0, 0, NULL, 0},
    {0, "version", NULL, "prints the version", OPTION_FLAG, AT(version), 0, 0, NULL, 0},
};

bake_result bake_parse_options(int argc, char **argv, bake_options *out, char *error, size_t error_size)
{
    const option_set set = {table, sizeof table / sizeof table[0], NULL, "scene", AT(input)};
    *out = (bake_options){.rays = 32, .distance = INFINITY, .offset = -1};
    if (!option_parse(&set, argc, argv, out, &(fault){.text = error, .size = error_size}))
        return BAKE_WRONG;
    if (out->help) {
        puts("usage: glssao-bake [options] -o FILE.glb scene.gltf|scene.glb\n"
             "Bakes ambient accessibility into the vertices' colours, by ray casting, and keeps all else.\n");
        option_print(&set);
        puts("\nExit code: 0 done, 1 could not bake, 2 wrong usage.");
        return BAKE_DONE;
    }
    if (out->version) {
        printf("glssao-bake %d.%d.%d\n", GLSSAO_VERSION_MAJOR, GLSSAO_VERSION_MINOR, GLSSAO_VERSION_PATCH);
        return BAKE_DONE;
    }
    if (out->vertices && out->fit) {
        snprintf(error, error_size, "--vertices and --fit exclude each other");
        return BAKE_WRONG;
    }
    if (out->input && strcmp(out->input, "-") == 0) {
        snprintf(error, error_size, "-: the scene is read three times, which standard input can't be; name a file");
        return BAKE_WRONG;
    }
    if (out->in_place && out->input && !out->output) {
        const char *end = strrchr(out->input, '.');
        if (!end || strcmp(end, ".glb") != 0) {
            snprintf(error, error_size, "--in-place: the result is a .glb file, and %s is none", out->input);
            return BAKE_WRONG;
        }
        out->output = out->input;
    }
    if (!out->input || !out->output) {
        snprintf(error, error_size, "%s (-h lists all)", !out->input ? "no scene file" : "no -o FILE.glb");
        return BAKE_WRONG;
    }
    out->method = out->fit ? BAKE_FIT : out->vertices ? BAKE_VERTICES : BAKE_TRIANGLES;
    return BAKE_RUN;
}
