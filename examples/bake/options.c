/* SPDX-License-Identifier: MIT
 *
 * The command line of glssao-bake.
 */
#include "bake.h"
#include "option.h"
#include "words.h"

#include <glssao/glssao.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define AT(member) offsetof(bake_options, member)
static const option table[] = {
    {'o', "output", "FILE.glb", "write the scene with COLOR_0 multiplied by accessibility", OPTION_FILE, AT(output), 0,
     0, ".glb", 0},
    {0, "in-place", NULL,
     "replace the scene, a .glb file, by the result; without this option the scene is never overwritten", OPTION_FLAG,
     AT(in_place), 0, 0, NULL, 0},
    {0, "rays", "N", "rays for each triangle, vertex or point, 1 to 65536 (default 32)", OPTION_INT, AT(rays), 1, 65536,
     "a whole number from 1 to 65536", 0},
    {0, "distance", "R", "ignore hits farther away, in scene units (default: no limit)", OPTION_FLOAT, AT(distance), 0,
     FLT_MAX, "a number, 0 or more", 0},
    {0, "cosine", NULL, "distribute rays by the cosine to the normal (default: uniformly over the hemisphere)",
     OPTION_FLAG, AT(cosine), 0, 0, NULL, 0},
    {0, "vertices", NULL, "cast rays from the vertices (default: from each triangle's centroid)", OPTION_FLAG,
     AT(vertices), 0, 0, NULL, 0},
    {0, "fit", NULL, "cast rays from points all over the triangles and fit the vertices' values to them", OPTION_FLAG,
     AT(fit), 0, 0, NULL, 0},
    {0, "offset", "D", "start rays this far off the surface, in scene units (default: suits the scene)", OPTION_FLOAT,
     AT(offset), 0, FLT_MAX, "a number, 0 or more", 0},
    {0, "floor", "V", "raise lower accessibility to V, 0 to 1 (default 0)", OPTION_FLOAT, AT(floor_value), 0, 1,
     "a number from 0 to 1", 0},
    {0, "accessibility-only", NULL, "ignore the colours that the vertices have", OPTION_FLAG, AT(accessibility_only), 0,
     0, NULL, 0},
    {0, "seed", "N", "seed of all random inputs (default 0)", OPTION_SEED, AT(seed), 0, 4294967295.0,
     "a whole number from 0 to 4294967295", 0},
    {0, "threads", "N", "number of threads, 1 to 256 (default: one for each core)", OPTION_INT, AT(threads), 1, 256,
     "a whole number from 1 to 256", 0},
    {0, "gltf-scene", "N", "bake the file's N-th scene (default: the scene that the file names)", OPTION_INT,
     AT(file.scene), 1, 1e9, "a whole number from 1", 0},
    {0, "root", "DIR", "allow the scene to refer to files below DIR (default: only below the scene's own folder)",
     OPTION_FILE, AT(file.root), 0, 0, "", 0},
    {0, "strict", NULL, "refuse a scene that would cause a warning", OPTION_FLAG, AT(file.strict), 0, 0, NULL, 0},
    {0, "flat-normals", NULL, "ignore the file's normals: every triangle has its own", OPTION_FLAG,
     AT(file.flat_normals), 0, 0, NULL, 0},
    {0, "memory", "MIB", "memory limit for loading the scene (default: half of the machine's memory)", OPTION_INT,
     AT(memory_mib), 1, 1e9, "a whole number from 1", 0},
    {'h', "help", NULL, "print this help", OPTION_FLAG, AT(help), 0, 0, NULL, 0},
    {0, "version", NULL, "print the version", OPTION_FLAG, AT(version), 0, 0, NULL, 0},
};

bake_result bake_parse_options(int argc, char **argv, bake_options *out, char *error, size_t error_size)
{
    const option_set set = {table, sizeof table / sizeof table[0], NULL, "scene", AT(input)};
    *out = (bake_options){.rays = 32, .distance = INFINITY, .offset = -1};
    if (!option_parse(&set, argc, argv, out, &(failure){.text = error, .size = error_size}))
        return BAKE_WRONG;
    if (out->help) {
        puts("usage: glssao-bake [options] -o FILE.glb scene.gltf|scene.glb\n"
             "Casts rays and multiplies ambient accessibility into the vertices' colours. Everything else is kept.\n");
        option_print(&set);
        puts("\nExit code: 0 success, 1 the scene could not be baked, 2 wrong usage.");
        return BAKE_DONE;
    }
    if (out->version) {
        printf("glssao-bake %d.%d.%d\n", GLSSAO_VERSION_MAJOR, GLSSAO_VERSION_MINOR, GLSSAO_VERSION_PATCH);
        return BAKE_DONE;
    }
    if (out->vertices && out->fit) {
        snprintf(error, error_size, "--vertices and --fit cannot be used together");
        return BAKE_WRONG;
    }
    if (out->input && strcmp(out->input, "-") == 0) {
        snprintf(error, error_size,
                 "-: standard input can be read only once, and the scene is read three times; name a file");
        return BAKE_WRONG;
    }
    if (out->in_place && out->input && !out->output) {
        if (words_find_ending(".glb", out->input) < 0) {
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
