/* SPDX-License-Identifier: MIT
 *
 * The table of all options. The parser and the help text use it.
 */
#include "options_internal.h"
#include "viewpoint.h"
#include "words.h"

#include <float.h>

enum {
    SCOPE_PICTURE,      /* belongs to one picture: also allowed in the lines of a batch */
    SCOPE_RENDERED,     /* the same, but not for the viewer */
    SCOPE_RUN,          /* belongs to the whole run: only on the command line */
    SCOPE_RENDERED_RUN, /* the same, but not for the viewer */
    SCOPE_COUNT
};

#define AT(member) offsetof(options, member)
static const option table[] = {
    {'o', "output", "FILE",
     "write the shaded picture; the extension .png, .jpg or .webp sets the format; - writes a PNG to standard output",
     OPTION_FILE, AT(output), 0, 0, ".png|.jpg|.jpeg|.webp|-", SCOPE_PICTURE},
    {0, "ao", "FILE.png|.pfm", "write accessibility (1 open, 0 occluded) at full size; .pfm holds linear 32-bit floats",
     OPTION_FILE, AT(ao), 0, 0, ".png|.pfm", SCOPE_RENDERED},
    {0, "normals", "FILE.png", "write view-space normals as n * 0.5 + 0.5", OPTION_FILE, AT(normals), 0, 0, ".png",
     SCOPE_RENDERED},
    {0, "depth", "FILE.pfm", "write view distance in scene units; 0 where the picture shows no surface", OPTION_FILE,
     AT(depth), 0, 0, ".pfm", SCOPE_RENDERED},
    {'s', "size", "WxH", "picture size in pixels (default 1280x720)", OPTION_SIZE, AT(width), 1, 16384,
     "WxH with sides from 1 to 16384", SCOPE_PICTURE},
    {'q', "quality", "NAME", "low, medium, high or ultra (default high)", OPTION_WORD, AT(quality), 0, 0, QUALITY_WORDS,
     SCOPE_PICTURE},
    {'t', "technique", "NAME",
     "classic, hemisphere, horizon, rays (a few, denoised) or raytrace (many, in every pixel) (default horizon)",
     OPTION_WORD, AT(technique), 0, 0, ALL_TECHNIQUE_WORDS "|raytrace", SCOPE_PICTURE},
    {0, "radius", "R", "largest distance of an occluder, in scene units (default: 1/20 of the scene's diagonal)",
     OPTION_NUMBER, AT(radius), 0, 1e11, "a number from 0 to 1e11", SCOPE_PICTURE},
    {0, "power", "P", "contrast: raise accessibility to the power P, 0 to 64", OPTION_NUMBER, AT(power), 0, 64,
     "a number from 0 to 64", SCOPE_PICTURE},
    {0, "intensity", "F", "strength of occlusion in the shaded picture, 0 none to 1 full (default 1)", OPTION_NUMBER,
     AT(intensity), 0, 1, "a number from 0 to 1", SCOPE_PICTURE},
    {0, "samples", "N",
     "samples a pixel: classic 1 to 14, hemisphere 1 to 64, horizon 12, 16, 24, 32, 48 or 64, raytrace rays (512)",
     OPTION_INT, AT(sample_count), 1, 65536, "a whole number from 1 to 65536", SCOPE_PICTURE},
    {0, "rays", "N",
     "trace N rays from each pixel of the estimate, 1 to 64: all of it with -t rays (default 2 to 8, by quality), and "
     "a "
     "correction with another technique (default none)",
     OPTION_INT, AT(rays), 1, 64, "a whole number from 1 to 64", SCOPE_RENDERED},
    {0, "blur-rounds", "N", "rounds of blur, 0 to 16", OPTION_INT, AT(blur_rounds), 0, 16,
     "a whole number from 0 to 16", SCOPE_PICTURE},
    {0, "error", "E", "horizon: accumulate estimates until their sampling error is at most E", OPTION_NUMBER, AT(error),
     1e-6, 1, "a number from 0.000001 to 1", SCOPE_PICTURE},
    {0, "budget", "MS", "horizon: accumulate estimates for MS milliseconds a frame", OPTION_NUMBER, AT(budget_ms),
     0.001, 1e9, "a number of milliseconds above 0", SCOPE_PICTURE},
    {0, "margin", "N",
     "draw N more pixels on each side, an even number, so that occluders beyond the edge count (default 0)", OPTION_INT,
     AT(margin), 0, 4096, "an even whole number from 0 to 4096", SCOPE_RENDERED},
    {0, "layers", "N", "horizon: 2 also draws the surfaces behind the visible ones and measures thickness (default 1)",
     OPTION_INT, AT(layers), 1, 2, "1 or 2", SCOPE_PICTURE},
    {0, "set", "NAME=V,...", "change any of the settings listed at the end of this help", OPTION_TEXT, AT(set), 0, 0,
     "", SCOPE_PICTURE},
    {0, "camera", "N|none", "use the file's N-th camera (default 1); none fits the view to the scene",
     OPTION_INT_OR_NONE, AT(camera), 1, 1e9, "a whole number from 1, or none", SCOPE_PICTURE},
    {0, "view", "A,E|NAME",
     "fit the view to the scene, seen from A degrees right of its front and E degrees above it, or from a named "
     "side: " VIEW_WORDS,
     OPTION_TEXT, AT(view), 0, 0, "", SCOPE_PICTURE},
    {0, "ortho", NULL, "use a parallel projection", OPTION_FLAG, AT(orthographic), 0, 0, NULL, SCOPE_PICTURE},
    {0, "eye", "X,Y,Z", "place the camera there instead of fitting the view to the scene", OPTION_VECTOR, AT(eye), 0, 0,
     "three numbers X,Y,Z", SCOPE_PICTURE},
    {0, "target", "X,Y,Z", "point the camera there (default: the middle of the scene)", OPTION_VECTOR, AT(target), 0, 0,
     "three numbers X,Y,Z", SCOPE_PICTURE},
    {0, "up", "X,Y,Z", "direction that is up in the scene (default 0,1,0)", OPTION_VECTOR, AT(up), 0, 0,
     "three numbers X,Y,Z", SCOPE_PICTURE},
    {0, "sky-up", "X,Y,Z", "direction that is up for the sky, the environment and the built-in sun (default: as --up)",
     OPTION_VECTOR, AT(sky_up), 0, 0, "three numbers X,Y,Z", SCOPE_PICTURE},
    {0, "fov", "DEGREES", "vertical field of view (default 45)", OPTION_NUMBER, AT(fov_deg), 0.01, 179,
     "a number from 0.01 to 179", SCOPE_PICTURE},
    {0, "near", "N", "near plane in scene units (default: fits the scene)", OPTION_NUMBER, AT(near_plane), FLT_MIN,
     FLT_MAX, "a number above 0", SCOPE_PICTURE},
    {0, "far", "F", "far plane in scene units (default: fits the scene)", OPTION_NUMBER, AT(far_plane), FLT_MIN,
     FLT_MAX, "a number above 0", SCOPE_PICTURE},
    {0, "time", "SECONDS", "show the file's animation at this time (default: the file without animation)",
     OPTION_NUMBER, AT(time_s), 0, 1e9, "a number of seconds from 0 to 1e9", SCOPE_PICTURE},
    {0, "animation", "N", "with --time, use the file's N-th animation (default 1)", OPTION_INT, AT(file.animation), 1,
     1e9, "a whole number from 1", SCOPE_PICTURE},
    {0, "gltf-scene", "N", "draw the file's N-th scene (default: the scene that the file names)", OPTION_INT,
     AT(file.scene), 1, 1e9, "a whole number from 1", SCOPE_PICTURE},
    {0, "variant", "NAME|N", "apply the material variant with that name or number (default: none)", OPTION_TEXT,
     AT(file.variant), 0, 0, "", SCOPE_PICTURE},
    {0, "root", "DIR", "allow the scene to refer to files below DIR (default: only below the scene's own folder)",
     OPTION_FILE, AT(file.root), 0, 0, "", SCOPE_PICTURE},
    {0, "strict", NULL, "refuse a scene that would cause a warning", OPTION_FLAG, AT(file.strict), 0, 0, NULL,
     SCOPE_PICTURE},
    {0, "memory", "MIB", "memory limit for loading a scene (default: half of the machine's memory)", OPTION_INT,
     AT(memory_mib), 1, 1e9, "a whole number from 1", SCOPE_PICTURE},
    {0, "scene", "NAME", "draw a built-in scene: columns, cornell, steps or plane (default columns)", OPTION_TEXT,
     AT(scene_name), 0, 0, "", SCOPE_PICTURE},
    {0, "depth-in", "FILE",
     "estimate the occlusion of a depth map (.pfm, 16-bit .png, .npy, .exr) instead of drawing a scene; it needs one "
     "of "
     "--fov, --ortho-height, --projection and --heightmap",
     OPTION_FILE, AT(depth_in), 0, 0, "", SCOPE_RENDERED},
    {0, "depth-kind", "KIND",
     "what the depth map holds: view distance, or what a depth buffer stores under clip space of -1 to 1 or of 0 to 1: "
     "distance, window or window-0-1 (default distance)",
     OPTION_WORD, AT(depth_kind), 0, 0, OPTIONS_DEPTH_WORDS, SCOPE_RENDERED},
    {0, "depth-scale", "S", "multiply the depth map's values by S, such as 0.001 for a PNG of millimetres (default 1)",
     OPTION_NUMBER, AT(depth_scale), FLT_MIN, FLT_MAX, "a number above 0", SCOPE_RENDERED},
    {0, "normals-in", "FILE",
     "view-space normals of the depth map, in the same formats; a PNG holds n * 0.5 + 0.5 (default: rebuilt from "
     "depth)",
     OPTION_FILE, AT(normals_in), 0, 0, "", SCOPE_RENDERED},
    {0, "ortho-height", "H", "the depth map has a parallel projection and is H scene units high", OPTION_NUMBER,
     AT(ortho_height), FLT_MIN, FLT_MAX, "a number above 0", SCOPE_RENDERED},
    {0, "projection", "M0,...,M15", "the depth map's projection, 16 numbers in columns as OpenGL takes them",
     OPTION_MATRIX, AT(projection), 0, 0, "16 numbers with commas between them", SCOPE_RENDERED},
    {0, "heightmap", "SPACING", "the depth map holds heights of ground, that many scene units apart, seen from above",
     OPTION_NUMBER, AT(heightmap), FLT_MIN, FLT_MAX, "a number above 0", SCOPE_RENDERED},
    {0, "context", "KIND", "where the OpenGL context comes from: auto, egl or osmesa (default auto)", OPTION_WORD,
     AT(context), 0, 0, CONTEXT_WORDS, SCOPE_RENDERED_RUN},
    {0, "path", "WAY", "run occlusion in compute or fragment shaders: auto, fragment or compute (default auto)",
     OPTION_WORD, AT(path), 0, 0, PATH_WORDS, SCOPE_PICTURE},
    {0, "frames", "N", "turntable: write N pictures of a full turn about --up, named FILE-0001.png and so on",
     OPTION_INT, AT(frames), 1, 100000, "a whole number from 1 to 100000", SCOPE_RENDERED},
    {0, "bench", "N", "draw N frames and print their times", OPTION_INT, AT(bench), 1, 100000,
     "a whole number from 1 to 100000", SCOPE_RENDERED_RUN},
    {0, "stats", "FILE.json", "write what was drawn and where the time went; - writes to standard output", OPTION_FILE,
     AT(stats), 0, 0, "", SCOPE_RENDERED},
    {0, "plan", NULL, "print which passes run, and why", OPTION_FLAG, AT(plan), 0, 0, NULL, SCOPE_RENDERED},
    {0, "no-ao", NULL, "skip the occlusion passes", OPTION_FLAG, AT(no_ao), 0, 0, NULL, SCOPE_PICTURE},
    {0, "no-shadows", NULL, "draw no shadows of direct light", OPTION_FLAG, AT(no_shadows), 0, 0, NULL, SCOPE_PICTURE},
    {0, "shadow-size", "N", "side of the shadow map in texels (default 2048)", OPTION_INT, AT(shadow_size), 1, 16384,
     "a whole number from 1 to 16384", SCOPE_PICTURE},
    {0, "mapped-normals", NULL,
     "apply normal maps before occlusion is estimated (default: only the mesh's normals count)", OPTION_FLAG,
     AT(mapped_normals), 0, 0, NULL, SCOPE_PICTURE},
    {0, "specular-occlusion", NULL, "let occlusion darken reflections by their lobe", OPTION_FLAG,
     AT(specular_occlusion), 0, 0, NULL, SCOPE_PICTURE},
    {0, "multi-bounce", NULL, "tint occluded light with the surface's colour", OPTION_FLAG, AT(multi_bounce), 0, 0,
     NULL, SCOPE_PICTURE},
    {0, "environment", "FILE",
     "light the scene with an equirectangular picture (.hdr, .png, .jpg), which is also the sky", OPTION_FILE,
     AT(environment), 0, 0, ".hdr|.pic|.png|.jpg|.jpeg", SCOPE_PICTURE},
    {0, "background", "sky|none|#RRGGBB",
     "fill the space behind the scene: the sky (default), nothing (straight alpha) or a colour", OPTION_TEXT,
     AT(background), 0, 0, "", SCOPE_PICTURE},
    {0, "samples-per-pixel", "N",
     "anti-aliasing: average N pictures, 1 to 64 (default 4 on a GPU, 1 on a software rasteriser and in glssao-view)",
     OPTION_INT, AT(samples_per_pixel), 1, 64, "a whole number from 1 to 64", SCOPE_PICTURE},
    {0, "debug-map", "NAME",
     "show a map in the lower right of the picture: ao, normals, depth, random, shadow or tiles", OPTION_WORD,
     AT(debug_map), 0, 0, OPTIONS_MAP_WORDS, SCOPE_PICTURE},
    {0, "batch", "LIST", "render each line of LIST as a job with its own options and scene; - reads standard input",
     OPTION_FILE, AT(batch), 0, 0, "", SCOPE_RENDERED_RUN},
    {0, "shard", "I/N", "batch: run only every N-th job, starting with job I, counted from 0", OPTION_SHARD,
     AT(shard_index), 1, 1000000, "I/N with I from 0 to N-1", SCOPE_RENDERED_RUN},
    {0, "cache", "MIB", "batch: memory for scenes that later jobs may need (default 1024)", OPTION_INT, AT(cache_mib),
     0, 1048576, "a whole number from 0 to 1048576", SCOPE_RENDERED_RUN},
    {0, "timeout", "SECONDS", "end a job that takes longer; in a batch this implies --isolate", OPTION_NUMBER,
     AT(timeout_s), 0.001, 1e6, "a number of seconds from 0.001 to 1e6", SCOPE_RENDERED_RUN},
    {0, "isolate", NULL, "batch: run each job in its own process, so that a crash costs one job", OPTION_FLAG,
     AT(isolate), 0, 0, NULL, SCOPE_RENDERED_RUN},
    {0, "program-cache", "DIR", "keep the effect's linked programs in this folder for the next run", OPTION_FILE,
     AT(program_cache), 0, 0, "", SCOPE_RUN},
    {0, "seed", "N", "seed of all random inputs (default 0)", OPTION_SEED, AT(seed), 0, 4294967295.0,
     "a whole number from 0 to 4294967295", SCOPE_PICTURE},
    {'h', "help", NULL, "print this help", OPTION_FLAG, AT(help), 0, 0, NULL, SCOPE_RUN},
    {0, "version", NULL, "print the version", OPTION_FLAG, AT(version), 0, 0, NULL, SCOPE_RUN},
};
#undef AT

option_set options_set(options_program program)
{
    static const char not_viewers[] = "glssao-render takes it, glssao-view does not",
                      not_jobs[] = "belongs to the whole run, not to a job in a list";
    static const char *const refused[][SCOPE_COUNT] = {
        [OPTIONS_RENDER] = {NULL},
        [OPTIONS_JOB] = {[SCOPE_RUN] = not_jobs, [SCOPE_RENDERED_RUN] = not_jobs},
        [OPTIONS_VIEWER] = {[SCOPE_RENDERED] = not_viewers, [SCOPE_RENDERED_RUN] = not_viewers},
    };
    return (option_set){.table = table,
                        .count = sizeof table / sizeof table[0],
                        .refused = refused[program],
                        .operand = "scene",
                        .operand_offset = offsetof(options, scene_path)};
}
