/* SPDX-License-Identifier: MIT
 *
 * Checks that involve several options: options that need or cannot be used together, and the text of --set.
 */
#include "options_internal.h"

#include "picture.h"
#include "setting_table.h"
#include "trace.h"
#include "viewpoint.h"
#include "words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool same_file(const options *o, failure *why)
{
    const char *const files[] = {o->output, o->ao, o->normals, o->depth, o->stats};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++)
        for (size_t k = 0; k < i; k++) {
            if (files[i] && files[k] && strcmp(files[i], files[k]) == 0) {
                fault_set(why, "%s is named for two outputs", files[i]);
                return true;
            }
        }
    return false;
}

static bool is_horizon_count(int n)
{
    return n == 12 || n == 16 || n == 24 || n == 32 || n == 48 || n == 64;
}

/* Checks the number of samples from --set, which is valid, or from --samples. */
static bool check_samples(const options *o, failure *why)
{
    glssao_settings settings = {.sample_count = o->sample_count};
    if (o->set)
        setting_apply(o->set, &settings, &(failure){0});
    const int count = settings.sample_count, most = o->technique == GLSSAO_CLASSIC ? 14 : 64;
    if (count == 0 || o->technique == OPTIONS_RAYTRACE)
        return true;
    if (o->technique == GLSSAO_HORIZON && !is_horizon_count(count))
        return fault_set(why, "--samples \"%d\": horizon takes 12, 16, 24, 32, 48 or 64", count);
    if (count > most)
        return fault_set(why, "--samples \"%d\": this technique takes at most %d", count, most);
    return true;
}

bool options_parse_background(const char *text, float out_rgba[4])
{
    const bool is_color =
        text && text[0] == '#' && strlen(text) == 7 && strspn(text + 1, "0123456789abcdefABCDEF") == 6;
    memset(out_rgba, 0, 4 * sizeof *out_rgba);
    for (int i = 0; is_color && i < 3; i++) { /* IEC 61966-2-1, sRGB */
        const char digits[3] = {text[1 + 2 * i], text[2 + 2 * i], 0};
        const float encoded = (float)strtol(digits, NULL, 16) / 255;
        out_rgba[i] = encoded <= 0.04045f ? encoded / 12.92f : powf((encoded + 0.055f) / 1.055f, 2.4f);
    }
    out_rgba[3] = is_color ? 1 : 0;
    return is_color || (text && strcmp(text, "none") == 0);
}

/* The settings that a part of --set alone can't judge. */
static bool check_extent(const options *o, failure *why)
{
    glssao_settings s = {.fade_far_start = (float)o->fade_far.value[0], .fade_far_end = (float)o->fade_far.value[1]};
    s.radius_in_pixels = o->radius_in_pixels;
    if (o->set)
        setting_apply(o->set, &s, &(failure){0});
    if (s.fade_far_start > s.fade_far_end)
        return fault_set(why, "--fade-far \"%g,%g\": the end is nearer than the start", (double)s.fade_far_start,
                         (double)s.fade_far_end);
    const bool fades = s.fade_far_end > 0;
    if (o->technique == OPTIONS_RAYTRACE && (s.radius_in_pixels || fades || o->thickness.given))
        return fault_set(why, "%s: not for raytrace",
                         s.radius_in_pixels ? "--radius-in-pixels"
                         : fades            ? "--fade-far"
                                            : "--thickness");
    return true;
}

static bool check_picture(const options *o, options_program program, failure *why)
{
    float color[4];
    if (o->background && strcmp(o->background, "sky") != 0 && !options_parse_background(o->background, color))
        return fault_set(why, "--background \"%s\": must be sky, none or #RRGGBB", o->background);
    if (!o->output)
        return true;
    const bool is_transparent = o->background && strcmp(o->background, "none") == 0;
    if (is_transparent && words_find_ending(".jpg|.jpeg", o->output) >= 0)
        return fault_set(why, "--background none: a JPEG (%s) has no transparency; .png and .webp have", o->output);
    if (words_find_ending(".webp", o->output) >= 0 && !picture_has_webp())
        return fault_set(why, "--output %s: this program was built without libwebp", o->output);
    if (strcmp(o->output, "-") == 0 && (program != OPTIONS_RENDER || o->frames || o->plan || o->bench))
        return fault_set(why, "--output -: standard output takes one picture, and nothing else");
    return true;
}

static bool asks_for_bent_normals(const options *o)
{
    glssao_settings settings = {.bent_normals = o->bent_normals};
    return o->technique == GLSSAO_HORIZON && (!o->set || setting_apply(o->set, &settings, &(failure){0})) &&
           settings.bent_normals;
}

/* Options of pictures that follow each other. */
static bool check_sequence(const options *o, bool is_viewer, failure *why)
{
    if (o->fps.given && (!o->frames || !o->time_s.given))
        return fault_set(why, "--fps %g: needs --frames N and --time SECONDS", (double)o->fps.value);
    if (o->fps.given && o->scene_path && strcmp(o->scene_path, "-") == 0)
        return fault_set(why, "--fps %g: reads the file again for each picture, which standard input does not allow",
                         (double)o->fps.value);
    if (o->history <= 0)
        return true;
    if (!is_viewer && !o->frames && !o->bench)
        return fault_set(why, "--history %d: needs --frames N or --bench N: one picture has no earlier one",
                         o->history);
    const char *other = o->technique == OPTIONS_RAYTRACE                       ? "technique raytrace"
                        : o->no_ao && !is_viewer                               ? "no-ao"
                        : (o->error.given || o->budget_ms.given) && !is_viewer ? o->error.given ? "error" : "budget"
                                                                               : NULL;
    if (other)
        return fault_set(why, "--history %d and --%s cannot be used together", o->history, other);
    return true;
}

/* Options that need or cannot be used together. */
static bool check_together(const options *o, options_program program, failure *why)
{
    const bool is_viewer = program == OPTIONS_VIEWER;
    const bool file_wanted =
        o->output || o->ao || o->normals || o->depth || o->stats || o->bench || o->plan || is_viewer;
    const bool traced = o->technique == OPTIONS_RAYTRACE;
    float angles[2];
    if (traced && !GLSSAO_HAS_EMBREE)
        return fault_set(why, "--technique raytrace: this %s was built without Embree", options_name(program));
    if ((o->rays || o->technique == GLSSAO_RAYS) && !GLSSAO_HAS_EMBREE)
        return fault_set(why, "--%s: this %s was built without Embree", o->rays ? "rays" : "technique rays",
                         options_name(program));
    if (o->rays && (traced || o->no_ao))
        return fault_set(why, "--rays %d and --%s cannot be used together", o->rays,
                         traced ? "technique raytrace" : "no-ao");
    if (o->rays && (o->error.given || o->budget_ms.given))
        return fault_set(why, "--rays %d and --%s cannot be used together: a mean of many estimates needs no rays",
                         o->rays, o->error.given ? "error" : "budget");
    if (o->adaptive_rays && !o->rays && o->technique != GLSSAO_RAYS)
        return fault_set(why, "--adaptive-rays: no rays are traced without --rays or --technique rays");
    if (o->adaptive_rays && o->rays > OPTIONS_ADAPTIVE_RAYS)
        return fault_set(why, "--rays %d: at most %d with --adaptive-rays, which traces up to four times as many",
                         o->rays, (int)OPTIONS_ADAPTIVE_RAYS);
    if (o->technique == GLSSAO_RAYS && o->sample_count)
        return fault_set(why, "--samples %d: --rays sets how many rays are traced", o->sample_count);
    if (traced && o->bench)
        return fault_set(why,
                         "--technique raytrace and --bench %d cannot be used together; --stats reports rays per second",
                         o->bench);
    if (traced && o->blur_rounds >= 0)
        return fault_set(why, "--blur-rounds %d: ray-traced accessibility is not blurred", o->blur_rounds);
    if ((o->error.given || o->budget_ms.given) && o->technique != GLSSAO_HORIZON)
        return fault_set(why, "--%s %g: only the horizon technique accumulates estimates",
                         o->error.given ? "error" : "budget",
                         (double)(o->error.given ? o->error.value : o->budget_ms.value));
    if ((o->error.given || o->budget_ms.given) && (o->no_ao || o->bench))
        return fault_set(why, "--%s and %s cannot be used together", o->error.given ? "error" : "budget",
                         o->no_ao ? "--no-ao" : "--bench");
    if (o->margin % 2)
        return fault_set(why, "--margin \"%d\": must be an even whole number", o->margin);
    if (traced && (o->margin || o->layers))
        return fault_set(why, "--technique raytrace and --%s cannot be used together: rays see the whole scene",
                         o->margin ? "margin" : "layers");
    if (o->layers == 2 && o->technique != GLSSAO_HORIZON)
        return fault_set(why, "--layers 2: only the horizon technique reads a second layer");
    if (o->scene_path && o->scene_name)
        return fault_set(why, "--scene %s and the file %s cannot be used together", o->scene_name, o->scene_path);
    if (o->scene_name && words_find(SCENE_WORDS, o->scene_name) < 0)
        return fault_set(why, "--scene \"%s\": must be one of " SCENE_WORDS, o->scene_name);
    if (o->time_s.given && !o->scene_path)
        return fault_set(why, "--time %g: a built-in scene has no animation", (double)o->time_s.value);
    if (!o->scene_path && (o->file.animation || o->file.scene || o->file.variant))
        return fault_set(why, "--%s: a built-in scene has none",
                         o->file.animation ? "animation"
                         : o->file.scene   ? "gltf-scene"
                                           : "variant");
    if (o->file.animation && !o->time_s.given)
        return fault_set(why, "--animation %d: needs --time SECONDS", o->file.animation);
    if (o->no_ao && o->ao)
        return fault_set(why, "--no-ao and --ao %s cannot be used together", o->ao);
    if (o->no_shadows && (o->shadow_size || o->debug_map == OPTIONS_MAP_SHADOW))
        return fault_set(why, "--no-shadows cannot be used with --shadow-size or --debug-map shadow");
    const bool is_of_occlusion =
        o->debug_map == OPTIONS_MAP_AO || o->debug_map == OPTIONS_MAP_TILES || o->debug_map == OPTIONS_MAP_BENT;
    if (is_of_occlusion && o->no_ao)
        return fault_set(why, "--no-ao and --debug-map %s cannot be used together",
                         words_at(OPTIONS_MAP_WORDS, o->debug_map).text);
    if (o->debug_map == OPTIONS_MAP_BENT && !is_viewer && !asks_for_bent_normals(o))
        return fault_set(why, "--debug-map bent: needs -t horizon, and --bent-normals or --set bent-normals=on");
    if (o->bent_normals && (!asks_for_bent_normals(o) || o->history > 0))
        return fault_set(why, "--bent-normals: needs -t horizon, without --history");
    if (o->bent_normals && o->no_ao)
        return fault_set(why, "--no-ao and --bent-normals cannot be used together");
    if (o->debug_map && !o->output && !is_viewer)
        return fault_set(why, "--debug-map: needs a picture, -o FILE");
    if (o->frames && o->bench)
        return fault_set(why, "--frames %d and --bench %d cannot be used together", o->frames, o->bench);
    if (o->near_plane.given && o->far_plane.given && o->near_plane.value >= o->far_plane.value)
        return fault_set(why, "--near %g must be less than --far %g", (double)o->near_plane.value,
                         (double)o->far_plane.value);
    if (o->view && !viewpoint_parse_view(o->view, angles))
        return fault_set(why,
                         "--view \"%s\": must be two numbers of degrees AZIMUTH,ELEVATION, the second from -90 to 90, "
                         "or one of " VIEW_WORDS,
                         o->view);
    if (o->view && (o->eye.given || o->target.given || o->camera > 0))
        return fault_set(why, "--view and --%s cannot be used together",
                         o->eye.given      ? "eye"
                         : o->target.given ? "target"
                                           : "camera");
    if (o->eye.given && o->target.given && memcmp(&o->eye, &o->target, sizeof o->eye) == 0)
        return fault_set(why, "--eye and --target are the same point");
    if (o->sky_up.given && o->sky_up.value[0] == 0 && o->sky_up.value[1] == 0 && o->sky_up.value[2] == 0)
        return fault_set(why, "--sky-up 0,0,0: has no direction");
    if (is_viewer && traced)
        return fault_set(why, "--technique raytrace: the viewer shows ray-traced accessibility with the keys T and Y");
    if (!file_wanted)
        return fault_set(
            why, "nothing to do: give -o FILE, --ao, --normals, --depth, --stats, --bench or --plan (see --help)");
    if (o->frames && !o->output && !o->ao && !o->normals && !o->depth)
        return fault_set(why, "--frames %d: needs an output such as -o FILE", o->frames);
    return check_sequence(o, is_viewer, why) && !same_file(o, why);
}

/* Tries the text of --set on some settings. */
static bool check_settings(const options *o, failure *why)
{
    char text[256];
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    if (!o->set || setting_apply(o->set, &settings, FAULT(text)))
        return true;
    return fault_set(why, "--set %s", text);
}

bool options_check(const options *o, options_program program, failure *why)
{
    if (program == OPTIONS_RENDER && o->batch) { /* these options are checked again with each job */
        if (o->bench)
            fault_set(why, "--batch and --bench %d cannot be used together", o->bench);
        return !o->bench && check_settings(o, why);
    }
    if (o->isolate && program == OPTIONS_RENDER)
        return fault_set(why, "--isolate: needs a list, --batch LIST");
    if (program == OPTIONS_JOB && o->scene_path && strcmp(o->scene_path, "-") == 0)
        return fault_set(why, "-: only a run with one job reads its scene from standard input");
    if (o->shard_count && program == OPTIONS_RENDER)
        return fault_set(why, "--shard %d/%d: needs a list, --batch LIST", o->shard_index, o->shard_count);
    return check_together(o, program, why) && check_picture(o, program, why) && check_settings(o, why) &&
           check_samples(o, why) && check_extent(o, why);
}
