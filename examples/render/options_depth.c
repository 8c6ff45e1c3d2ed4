/* SPDX-License-Identifier: MIT
 *
 * Checks the options of a depth map.
 */
#include "options_internal.h"
#include "words.h"

/* Without these words, an option would be ignored without a word. */
static const char only_depth_map[] = "depth-in|depth-kind|depth-scale|normals-in|ortho-height|projection|heightmap",
                  also_depth_map[] = "output|ao|quality|technique|radius|radius-in-pixels|thickness|fade-far|power|"
                                     "samples|blur-rounds|error|set|fov|near|far|"
                                     "seed|scene|batch|shard|cache|timeout|isolate|help|version";

static bool check_applicable(const options *start, const options *o, options_program program, failure *why)
{
    const option_set set = options_set(program);
    for (int i = 0; i < set.count; i++) {
        const option *row = &set.table[i];
        const bool only = words_find(only_depth_map, row->name) >= 0, also = words_find(also_depth_map, row->name) >= 0;
        if ((o->depth_in ? only || also : !only) || !option_differs(row, start, o))
            continue;
        return o->depth_in ? fault_set(why, "--%s: does not apply to a depth map (--depth-in)", row->name)
                           : fault_set(why, "--%s: needs a depth map, --depth-in FILE", row->name);
    }
    return true;
}

/* One of four ways says how the map was projected. */
static bool check_projection(const options *o, failure *why)
{
    const struct {
        const char *name;
        bool given;
    } ways[] = {{"fov", o->fov_deg.given},
                {"ortho-height", o->ortho_height.given},
                {"projection", o->projection.given},
                {"heightmap", o->heightmap.given}};
    const char *found = NULL;
    for (int i = 0; i < 4; i++) {
        if (ways[i].given && found)
            return fault_set(why, "--%s and --%s cannot be used together", found, ways[i].name);
        found = ways[i].given ? ways[i].name : found;
    }
    if (!found)
        return fault_set(why, "--depth-in %s: needs one of --fov, --ortho-height, --projection and --heightmap",
                         o->depth_in);
    const bool planes = o->near_plane.given && o->far_plane.given, any = o->near_plane.given || o->far_plane.given;
    const bool in_window = o->depth_kind != OPTIONS_DEPTH_DISTANCE, whole = o->projection.given || o->heightmap.given;
    if (in_window && o->heightmap.given)
        return fault_set(why, "--depth-kind %s and --heightmap cannot be used together",
                         words_at(OPTIONS_DEPTH_WORDS, o->depth_kind).text);
    if (in_window && !whole && !planes)
        return fault_set(why, "--depth-kind %s: needs --near and --far, or --projection",
                         words_at(OPTIONS_DEPTH_WORDS, o->depth_kind).text);
    if (any && (!in_window || whole))
        return fault_set(why, "--%s: with --depth-in, only window depth with --fov or --ortho-height needs it",
                         o->near_plane.given ? "near" : "far");
    return true;
}

bool options_check_depth_map(const options *start, const options *o, options_program program, failure *why)
{
    if (!check_applicable(start, o, program, why))
        return false;
    if (!o->depth_in || (program == OPTIONS_RENDER && o->batch)) /* each job of a batch is checked again */
        return true;
    if (o->scene_path || o->scene_name)
        return fault_set(why, "--depth-in %s and the scene %s cannot be used together", o->depth_in,
                         o->scene_path ? o->scene_path : o->scene_name);
    if (o->rays)
        return fault_set(why, "--rays %d: a depth map has no scene to trace", o->rays);
    if (o->technique > GLSSAO_HORIZON)
        return fault_set(why, "--technique: a depth map takes " TECHNIQUE_WORDS);
    if (!o->output && !o->ao)
        return fault_set(why, "--depth-in %s: needs an output, -o FILE or --ao FILE", o->depth_in);
    return check_projection(o, why);
}
