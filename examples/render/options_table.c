/* SPDX-License-Identifier: MIT
 *
 * The table of all options. The parser and the help text use it.
 */
#include "option_rows.h"
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
    ROW('o', "output", "FILE", FILE, SCOPE_PICTURE, output, 0, 0, ".png|.jpg|.jpeg|.webp|-",
        "write the shaded picture; the extension .png, .jpg or .webp sets the format; - writes a PNG to standard "
        "output"),
    FILE_NAME("ao", "FILE.png|.pfm", SCOPE_RENDERED, ao, ".png|.pfm",
              "write accessibility (1 open, 0 occluded) at full size; .pfm holds linear 32-bit floats"),
    FILE_NAME("normals", "FILE.png", SCOPE_RENDERED, normals, ".png", "write view-space normals as n * 0.5 + 0.5"),
    FILE_NAME("depth", "FILE.pfm", SCOPE_RENDERED, depth, ".pfm",
              "write view distance in scene units; 0 where the picture shows no surface"),
    ROW('s', "size", "WxH", SIZE, SCOPE_PICTURE, width, 1, 16384, NULL, "picture size in pixels (default 1280x720)"),
    ROW('q', "quality", "NAME", WORD, SCOPE_PICTURE, quality, 0, 0, QUALITY_WORDS,
        "low, medium, high or ultra (default high)"),
    ROW('t', "technique", "NAME", WORD, SCOPE_PICTURE, technique, 0, 0, ALL_TECHNIQUE_WORDS "|raytrace",
        "classic, hemisphere, horizon, rays (a few, denoised) or raytrace (many, in every pixel) (default horizon)"),
    RANGE(NUMBER, "radius", "R", SCOPE_PICTURE, radius, 0, 1e11,
          "largest distance of an occluder, in scene units (default: 1/20 of the scene's diagonal)"),
    FLAG(0, "radius-in-pixels", SCOPE_PICTURE, radius_in_pixels,
         "let --radius count pixels of the picture, at any distance (default radius: 32)"),
    RANGE(NUMBER, "thickness", "F", SCOPE_PICTURE, thickness, 0.001, 1000,
          "horizon: multiply the thickness that is estimated for occluders, 0.001 to 1000 (default 1)"),
    RANGE(PAIR, "fade-far", "START,END", SCOPE_PICTURE, fade_far, 0, 1e12,
          "let occlusion fade out between these view distances, in scene units"),
    RANGE(NUMBER, "power", "P", SCOPE_PICTURE, power, 0, 64, "contrast: raise accessibility to the power P, 0 to 64"),
    RANGE(NUMBER, "intensity", "F", SCOPE_PICTURE, intensity, 0, 1,
          "strength of occlusion in the shaded picture, 0 none to 1 full (default 1)"),
    RANGE(
        INT, "samples", "N", SCOPE_PICTURE, sample_count, 1, 65536,
        "samples a pixel: classic 1 to 14, hemisphere 1 to 64, horizon 12, 16, 24, 32, 48 or 64, raytrace rays (512)"),
    RANGE(INT, "rays", "N", SCOPE_PICTURE, rays, 1, 64,
          "trace N rays from each pixel of the estimate, 1 to 64: all of it with -t rays (default 2 to 8, by quality), "
          "and a correction with another technique (default none)"),
    FLAG(0, "adaptive-rays", SCOPE_PICTURE, adaptive_rays,
         "more rays where few neighbours can be averaged, fewer where all say the same; --rays is at most 16 then"),
    RANGE(INT, "blur-rounds", "N", SCOPE_PICTURE, blur_rounds, 0, 16, "rounds of blur, 0 to 16"),
    RANGE(INT, "history", "N", SCOPE_PICTURE, history, 0, 63,
          "reuse the accessibility of earlier frames: at most N count in a pixel's mean, 0 to 63 (glssao-render: of a "
          "turntable, an animation or a benchmark, default 0; glssao-view: while the view changes, default 16)"),
    RANGE(NUMBER, "error", "E", SCOPE_PICTURE, error, 1e-6, 1,
          "horizon: accumulate estimates until their sampling error is at most E"),
    RANGE(NUMBER, "budget", "MS", SCOPE_PICTURE, budget_ms, 0.001, 1e9,
          "horizon: accumulate estimates for MS milliseconds a frame"),
    ROW(0, "margin", "N", INT, SCOPE_RENDERED, margin, 0, 4096, "an even whole number from 0 to 4096",
        "draw N more pixels on each side, an even number, so that occluders beyond the edge count (default 0)"),
    ROW(0, "layers", "N", INT, SCOPE_PICTURE, layers, 1, 2, "1 or 2",
        "horizon: 2 also draws the surfaces behind the visible ones and measures thickness (default 1)"),
    TEXT("set", "NAME=V,...", SCOPE_PICTURE, set, "change any of the settings listed at the end of this help"),
    RANGE(INT_OR_NONE, "camera", "N|none", SCOPE_PICTURE, camera, 1, 1e9,
          "use the file's N-th camera (default 1); none fits the view to the scene"),
    TEXT("view", "A,E|NAME", SCOPE_PICTURE, view,
         "fit the view to the scene, seen from A degrees right of its front and E degrees above it, or from a named "
         "side: " VIEW_WORDS),
    FLAG(0, "ortho", SCOPE_PICTURE, orthographic, "use a parallel projection"),
    VECTOR("eye", SCOPE_PICTURE, eye, "place the camera there instead of fitting the view to the scene"),
    VECTOR("target", SCOPE_PICTURE, target, "point the camera there (default: the middle of the scene)"),
    VECTOR("up", SCOPE_PICTURE, up, "direction that is up in the scene (default 0,1,0)"),
    VECTOR("sky-up", SCOPE_PICTURE, sky_up,
           "direction that is up for the sky, the environment and the built-in sun (default: as --up)"),
    RANGE(NUMBER, "fov", "DEGREES", SCOPE_PICTURE, fov_deg, 0.01, 179, "vertical field of view (default 45)"),
    RANGE(NUMBER, "near", "N", SCOPE_PICTURE, near_plane, FLT_MIN, FLT_MAX,
          "near plane in scene units (default: fits the scene)"),
    RANGE(NUMBER, "far", "F", SCOPE_PICTURE, far_plane, FLT_MIN, FLT_MAX,
          "far plane in scene units (default: fits the scene)"),
    RANGE(NUMBER, "time", "SECONDS", SCOPE_PICTURE, time_s, 0, 1e9,
          "show the file's animation at this time (default: the file without animation)"),
    RANGE(INT, "animation", "N", SCOPE_PICTURE, file.animation, 1, 1e9,
          "with --time, use the file's N-th animation (default 1)"),
    RANGE(INT, "gltf-scene", "N", SCOPE_PICTURE, file.scene, 1, 1e9,
          "draw the file's N-th scene (default: the scene that the file names)"),
    TEXT("variant", "NAME|N", SCOPE_PICTURE, file.variant,
         "apply the material variant with that name or number (default: none)"),
    FILE_NAME("root", "DIR", SCOPE_PICTURE, file.root, "",
              "allow the scene to refer to files below DIR (default: only below the scene's own folder)"),
    FLAG(0, "strict", SCOPE_PICTURE, file.strict, "refuse a scene that would cause a warning"),
    FLAG(0, "flat-normals", SCOPE_PICTURE, file.flat_normals, "ignore the file's normals: every triangle has its own"),
    RANGE(INT, "memory", "MIB", SCOPE_PICTURE, memory_mib, 1, 1e9,
          "memory limit for loading a scene (default: half of the machine's memory)"),
    TEXT("scene", "NAME", SCOPE_PICTURE, scene_name,
         "draw a built-in scene: columns, cornell, steps or plane (default columns)"),
    FILE_NAME("depth-in", "FILE", SCOPE_RENDERED, depth_in, "",
              "estimate the occlusion of a depth map (.pfm, 16-bit .png, .npy, .exr) instead of drawing a scene; it "
              "needs one of --fov, --ortho-height, --projection and --heightmap"),
    WORD("depth-kind", "KIND", SCOPE_RENDERED, depth_kind, OPTIONS_DEPTH_WORDS,
         "what the depth map holds: view distance, or what a depth buffer stores under clip space of -1 to 1 or of 0 "
         "to 1: distance, window or window-0-1 (default distance)"),
    RANGE(NUMBER, "depth-scale", "S", SCOPE_RENDERED, depth_scale, FLT_MIN, FLT_MAX,
          "multiply the depth map's values by S, such as 0.001 for a PNG of millimetres (default 1)"),
    FILE_NAME("normals-in", "FILE", SCOPE_RENDERED, normals_in, "",
              "view-space normals of the depth map, in the same formats; a PNG holds n * 0.5 + 0.5 (default: rebuilt "
              "from depth)"),
    RANGE(NUMBER, "ortho-height", "H", SCOPE_RENDERED, ortho_height, FLT_MIN, FLT_MAX,
          "the depth map has a parallel projection and is H scene units high"),
    RANGE(MATRIX, "projection", "M0,...,M15", SCOPE_RENDERED, projection, 0, 0,
          "the depth map's projection, 16 numbers in columns as OpenGL takes them"),
    RANGE(NUMBER, "heightmap", "SPACING", SCOPE_RENDERED, heightmap, FLT_MIN, FLT_MAX,
          "the depth map holds heights of ground, that many scene units apart, seen from above"),
    WORD("context", "KIND", SCOPE_RENDERED_RUN, context, CONTEXT_WORDS,
         "where the OpenGL context comes from: auto, egl or osmesa (default auto)"),
    WORD("path", "WAY", SCOPE_PICTURE, path, PATH_WORDS,
         "run occlusion in compute or fragment shaders: auto, fragment or compute (default auto)"),
    RANGE(INT, "frames", "N", SCOPE_RENDERED, frames, 1, 100000,
          "turntable: write N pictures of a full turn about --up, named FILE-0001.png and so on"),
    RANGE(NUMBER, "fps", "F", SCOPE_RENDERED, fps, 0.001, 1e6,
          "with --frames and --time: F pictures of each second of the file's animation, instead of a turntable"),
    RANGE(INT, "bench", "N", SCOPE_RENDERED_RUN, bench, 1, 100000, "draw N frames and print their times"),
    FILE_NAME("stats", "FILE.json", SCOPE_RENDERED, stats, "",
              "write what was drawn and where the time went; - writes to standard output"),
    FLAG(0, "plan", SCOPE_RENDERED, plan, "print which passes run, and why"),
    FLAG(0, "no-ao", SCOPE_PICTURE, no_ao, "skip the occlusion passes"),
    FLAG(0, "no-shadows", SCOPE_PICTURE, no_shadows, "draw no shadows of direct light"),
    RANGE(INT, "shadow-size", "N", SCOPE_PICTURE, shadow_size, 1, 16384,
          "side of the shadow map in texels (default 2048)"),
    FLAG(0, "mapped-normals", SCOPE_PICTURE, mapped_normals,
         "apply normal maps before occlusion is estimated (default: only the mesh's normals count)"),
    FLAG(0, "specular-occlusion", SCOPE_PICTURE, specular_occlusion, "let occlusion darken reflections by their lobe"),
    FLAG(0, "multi-bounce", SCOPE_PICTURE, multi_bounce, "tint occluded light with the surface's colour"),
    FLAG(0, "bent-normals", SCOPE_PICTURE, bent_normals,
         "horizon: take ambient light from where surfaces are open, and let their open cone darken reflections"),
    FILE_NAME("environment", "FILE", SCOPE_PICTURE, environment, ".hdr|.pic|.png|.jpg|.jpeg",
              "light the scene with an equirectangular picture (.hdr, .png, .jpg), which is also the sky"),
    TEXT("background", "sky|none|#RRGGBB", SCOPE_PICTURE, background,
         "fill the space behind the scene: the sky (default), nothing (straight alpha) or a colour"),
    RANGE(INT, "samples-per-pixel", "N", SCOPE_PICTURE, samples_per_pixel, 1, 64,
          "anti-aliasing: average N pictures, 1 to 64 (default 4 on a GPU, 1 on a software rasteriser and in "
          "glssao-view)"),
    WORD("debug-map", "NAME", SCOPE_PICTURE, debug_map, OPTIONS_MAP_WORDS,
         "show a map in the lower right of the picture: ao, normals, depth, random, shadow or tiles"),
    FILE_NAME("batch", "LIST", SCOPE_RENDERED_RUN, batch, "",
              "render each line of LIST as a job with its own options and scene; - reads standard input"),
    RANGE(SHARD, "shard", "I/N", SCOPE_RENDERED_RUN, shard_index, 1, 1000000,
          "batch: run only every N-th job, starting with job I, counted from 0"),
    RANGE(INT, "cache", "MIB", SCOPE_RENDERED_RUN, cache_mib, 0, 1048576,
          "batch: memory for scenes that later jobs may need (default 1024)"),
    RANGE(NUMBER, "timeout", "SECONDS", SCOPE_RENDERED_RUN, timeout_s, 0.001, 1e6,
          "end a job that takes longer; in a batch this implies --isolate"),
    FLAG(0, "isolate", SCOPE_RENDERED_RUN, isolate,
         "batch: run each job in its own process, so that a crash costs one job"),
    FILE_NAME("program-cache", "DIR", SCOPE_RUN, program_cache, "",
              "keep the effect's linked programs in this folder for the next run"),
    RANGE(SEED, "seed", "N", SCOPE_PICTURE, seed, 0, 4294967295.0, "seed of all random inputs (default 0)"),
    FLAG('h', "help", SCOPE_RUN, help, "print this help"),
    FLAG(0, "version", SCOPE_RUN, version, "print the version"),
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
