/* SPDX-License-Identifier: MIT
 *
 * The command line of glssao-bake.
 */
#include "bake.h"
#include "option_rows.h"
#include "words.h"

#include <glssao/glssao.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define AT(member) offsetof(bake_options, member)
static const option table[] = {
    ROW('o', "output", "FILE.glb", FILE, 0, output, 0, 0, ".glb",
        "write the scene with COLOR_0 multiplied by accessibility"),
    FLAG(0, "in-place", 0, in_place,
         "replace the scene, a .glb file, by the result; without this option the scene is never overwritten"),
    RANGE(INT, "rays", "N", 0, rays, 1, 65536, "rays for each triangle, vertex or point, 1 to 65536 (default 32)"),
    RANGE(FLOAT, "distance", "R", 0, distance, 0, FLT_MAX,
          "ignore hits farther away, in scene units (default: no limit)"),
    FLAG(0, "cosine", 0, cosine,
         "distribute rays by the cosine to the normal (default: uniformly over the hemisphere)"),
    FLAG(0, "vertices", 0, vertices, "cast rays from the vertices (default: from each triangle's centroid)"),
    FLAG(0, "fit", 0, fit, "cast rays from points all over the triangles and fit the vertices' values to them"),
    RANGE(FLOAT, "offset", "D", 0, offset, 0, FLT_MAX,
          "start rays this far off the surface, in scene units (default: suits the scene)"),
    RANGE(FLOAT, "floor", "V", 0, floor_value, 0, 1, "raise lower accessibility to V, 0 to 1 (default 0)"),
    FLAG(0, "accessibility-only", 0, accessibility_only, "ignore the colours that the vertices have"),
    RANGE(SEED, "seed", "N", 0, seed, 0, 4294967295.0, "seed of all random inputs (default 0)"),
    RANGE(INT, "threads", "N", 0, threads, 1, 256, "number of threads, 1 to 256 (default: one for each core)"),
    RANGE(INT, "gltf-scene", "N", 0, file.scene, 1, 1e9,
          "bake the file's N-th scene (default: the scene that the file names)"),
    FILE_NAME("root", "DIR", 0, file.root, "",
              "allow the scene to refer to files below DIR (default: only below the scene's own folder)"),
    FLAG(0, "strict", 0, file.strict, "refuse a scene that would cause a warning"),
    FLAG(0, "flat-normals", 0, file.flat_normals, "ignore the file's normals: every triangle has its own"),
    RANGE(INT, "memory", "MIB", 0, memory_mib, 1, 1e9,
          "memory limit for loading the scene (default: half of the machine's memory)"),
    FLAG('h', "help", 0, help, "print this help"),
    FLAG(0, "version", 0, version, "print the version"),
};

bake_result bake_parse_options(int argc, char **argv, bake_options *out, failure *fault)
{
    const option_set set = {table, sizeof table / sizeof table[0], NULL, "scene", AT(input)};
    *out = (bake_options){.rays = 32, .distance = INFINITY, .offset = -1};
    if (!option_parse(&set, argc, argv, out, fault))
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
        fault_set(fault, "--vertices and --fit cannot be used together");
        return BAKE_WRONG;
    }
    if (out->input && strcmp(out->input, "-") == 0) {
        fault_set(fault, "-: standard input can be read only once, and the scene is read three times; name a file");
        return BAKE_WRONG;
    }
    if (out->in_place && out->input && !out->output) {
        if (words_find_ending(".glb", out->input) < 0) {
            fault_set(fault, "--in-place: the result is a .glb file, and %s is none", out->input);
            return BAKE_WRONG;
        }
        out->output = out->input;
    }
    if (!out->input || !out->output) {
        fault_set(fault, "%s (-h lists all)", !out->input ? "no scene file" : "no -o FILE.glb");
        return BAKE_WRONG;
    }
    out->method = out->fit ? BAKE_FIT : out->vertices ? BAKE_VERTICES : BAKE_TRIANGLES;
    return BAKE_RUN;
}
