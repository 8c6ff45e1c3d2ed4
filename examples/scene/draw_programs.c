/* SPDX-License-Identifier: MIT
 *
 * Chooses the shader variant of each draw call in each pass, describes the choice in words, and builds missing
 * variants. Each variant is built once.
 */
#include "draw_internal.h"
#include "gl.h"
#include "scene_shaders.h"

#include <stdio.h>
#include <stdlib.h>

/* Index of the program, built on first use; -1 on failure. */
static int find_program(draw_pool *pool, draw_kind kind, unsigned variant, failure *fault)
{
    static const char *const what[] = {"scene normals pass", "scene main pass", "shadow pass",
                                       "layer pass",         "motion pass",     "sky pass"};
    const bool is_sky = kind == DRAW_SKY;
    for (int i = 0; i < pool->variant_count; i++)
        if (pool->variants[i].kind == kind && pool->variants[i].variant == variant)
            return i;
    draw_variant *grown = realloc(pool->variants, ((size_t)pool->variant_count + 1) * sizeof *grown);
    if (!grown) {
        fault_set_memory(fault);
        return -1;
    }
    pool->variants = grown;
    draw_variant made = {.kind = kind, .variant = variant};
    if (!draw_program_build(&made.program, what[kind], is_sky ? shader_sky_vert : shader_scene_vert,
                            is_sky ? "" : shader_surface_glsl,
                            is_sky              ? shader_sky_frag
                            : kind == DRAW_MAIN ? shader_main_frag
                                                : shader_normals_frag,
                            variant, fault))
        return -1;
    pool->variants[pool->variant_count] = made;
    return pool->variant_count++;
}

static unsigned normals_variant(const draw_item *item, const scene_material *m, const scene_draw_options *options,
                                bool has_tangents)
{
    if (options->everything)
        return VARIANT_LIT | VARIANT_DOUBLE_SIDED | VARIANT_MASKED | VARIANT_COLORED | VARIANT_BASE_MAPPED |
               VARIANT_TEXTURED | VARIANT_NORMAL_MAPPED | (item->flat ? VARIANT_FLAT : 0u);
    unsigned variant = VARIANT_LIT | (m->double_sided ? VARIANT_DOUBLE_SIDED : 0u) | (item->flat ? VARIANT_FLAT : 0u);
    if (m->alpha == SCENE_ALPHA_MASK) {
        variant |= VARIANT_MASKED | (item->colored ? VARIANT_COLORED : 0u);
        variant |= m->base_color_texture >= 0 ? VARIANT_BASE_MAPPED | VARIANT_TEXTURED : 0u;
    }
    if ((options->mapped_normals || options->bent) && m->normal_map.used && has_tangents && m->normal_scale != 0)
        variant |= VARIANT_NORMAL_MAPPED | VARIANT_TEXTURED;
    return variant;
}

static unsigned main_variant(const draw_item *item, const scene_lighting *lighting, const scene_draw_options *options,
                             bool shadowed)
{
    if (options->everything)
        return VARIANT_EVERYTHING | (item->blended ? VARIANT_BLENDED : 0u) |
               (item->variant & (VARIANT_FLAT | VARIANT_MORE_UVS));
    if (!(item->variant & VARIANT_LIT))
        return item->variant;
    const bool occluded = !item->blended;
    return item->variant | (shadowed ? VARIANT_SHADOWED : 0u) | (lighting->light_count ? VARIANT_LIGHTS : 0u) |
           (lighting->environment ? VARIANT_ENVIRONMENT : 0u) |
           (options->specular_occlusion && occluded && item->variant & VARIANT_REFLECTIVE ? VARIANT_SPECULAR_OCCLUSION
                                                                                          : 0u) |
           (options->multi_bounce && occluded ? VARIANT_MULTI_BOUNCE : 0u) |
           (options->bent && occluded ? VARIANT_BENT : 0u);
}

/* The shadow map, the layers and motion need depth alone, after the alpha test. */
static unsigned depth_variant(unsigned normals)
{
    const unsigned test = VARIANT_MASKED | VARIANT_COLORED | VARIANT_BASE_MAPPED | VARIANT_TEXTURED;
    return normals & VARIANT_MASKED ? normals & test : 0u;
}

bool draw_has_sky(const scene_lighting *lighting)
{
    const float *tilt = lighting->sky_tilt;
    return !lighting->plain && (lighting->environment || tilt[0] != 0 || tilt[1] != 0 || tilt[2] != 0);
}

int draw_find_sky(scene_renderer *r, const scene_lighting *lighting, failure *fault)
{
    return find_program(r->pool, DRAW_SKY, lighting->environment ? VARIANT_ENVIRONMENT : 0u, fault);
}

/* Gives every item the programs that the options call for, building those that are missing. */
static bool choose_programs(scene_renderer *r, const scene_lighting *lighting, const scene_draw_options *options,
                            bool shadowed, failure *fault)
{
    if (!options->no_picture && (options->everything || draw_has_sky(lighting)) &&
        draw_find_sky(r, lighting, fault) < 0)
        return false;
    for (uint32_t i = 0; i < r->item_count; i++) {
        draw_item *item = &r->items[i];
        const scene_material *m = &r->scene->materials[item->material];
        const unsigned normals = normals_variant(item, m, options, r->scene->tangents != NULL);
        int chosen[DRAW_KIND_COUNT] = {-1, -1, -1, -1, -1};
        const bool casts = !item->blended && item->topology == SCENE_TRIANGLES;
        bool done = true;
        if (!options->no_picture) {
            chosen[DRAW_MAIN] =
                find_program(r->pool, DRAW_MAIN, main_variant(item, lighting, options, shadowed), fault);
            done = chosen[DRAW_MAIN] >= 0;
        }
        if (done && casts && !options->no_prepass) {
            chosen[DRAW_NORMALS] = find_program(r->pool, DRAW_NORMALS, normals, fault);
            done = chosen[DRAW_NORMALS] >= 0;
        }
        if (done && casts && shadowed) {
            chosen[DRAW_SHADOW] = find_program(r->pool, DRAW_SHADOW, depth_variant(normals), fault);
            done = chosen[DRAW_SHADOW] >= 0;
        }
        if (done && casts && options->layers) {
            chosen[DRAW_LAYER] = find_program(r->pool, DRAW_LAYER, depth_variant(normals) | VARIANT_BEHIND, fault);
            done = chosen[DRAW_LAYER] >= 0;
        }
        if (done && casts && options->motion) {
            chosen[DRAW_MOTION] = find_program(r->pool, DRAW_MOTION, depth_variant(normals) | VARIANT_MOVES, fault);
            done = chosen[DRAW_MOTION] >= 0;
        }
        if (!done)
            return false;
        for (int k = 0; k < DRAW_KIND_COUNT; k++)
            item->program[k] = chosen[k];
    }
    return true;
}

bool scene_renderer_configure(scene_renderer *r, const scene_lighting *lighting, const scene_draw_options *options,
                              failure *fault)
{
    const bool shadowed = draw_shadow_wanted(r, lighting, options);
    const int size = options->shadow_size ? options->shadow_size : 2048;
    if (shadowed && !draw_shadow_make(r, size, fault))
        return false;
    if (!choose_programs(r, lighting, options, shadowed, fault))
        return false;
    if (options->everything)
        draw_make_neutral(r);
    r->shadow.used = shadowed;
    r->options = *options;
    r->configured = true;
    return true;
}

static bool any_item(const scene_renderer *r, unsigned bit)
{
    bool any = false;
    for (uint32_t i = 0; i < r->item_count; i++)
        any = any || r->items[i].variant & bit;
    return any;
}

static bool any_instances(const scene_renderer *r)
{
    bool any = false;
    for (uint32_t i = 0; i < r->item_count; i++)
        any = any || r->items[i].instance_count > 1;
    return any;
}

static const char *shadow_reason(const scene_renderer *r, const scene_lighting *lighting)
{
    const float *sun = lighting->directional;
    return r->shadow.used                              ? "a directional light casts, and surfaces receive"
           : !r->options.shadows                       ? "not asked for"
           : !(sun[0] > 0 || sun[1] > 0 || sun[2] > 0) ? "no directional light"
                                                       : "nothing casts, or nothing lit receives";
}

void scene_renderer_effects(const scene_renderer *r, const scene_lighting *lighting, scene_effect *out)
{
    const bool mapped = any_item(r, VARIANT_NORMAL_MAPPED), masked = any_item(r, VARIANT_MASKED);
    const bool instanced = any_instances(r), blended = r->item_count > r->first_blended;
    const bool reflective = any_item(r, VARIANT_REFLECTIVE);
    const bool surrounded = lighting->environment, sky = draw_has_sky(lighting);
    const scene_effect effects[SCENE_EFFECT_COUNT] = {
        {"shadow map", shadow_reason(r, lighting), r->shadow.used},
        {"normal maps",
         !mapped                     ? "no material drawn has one"
         : r->options.mapped_normals ? "in the main pass and the pre-pass"
                                     : "in the main pass; the pre-pass has the vertices' normals",
         mapped},
        {"reflections", reflective ? "metallic-roughness materials" : "every material is matte or unlit", reflective},
        {"alpha test", masked ? "materials with a cut-off" : "no material has a cut-off", masked},
        {"instances", instanced ? "meshes that stand in several places" : "every mesh stands in one place", instanced},
        {"blending", blended ? "blended materials, back to front" : "no material is blended", blended},
        {"lights", lighting->light_count ? "the file has more than the shadow's" : "none beside the directional one",
         lighting->light_count > 0},
        {"environment", surrounded ? "ambient light from a picture" : "no picture given: a gradient", surrounded},
        {"sky",
         surrounded && sky ? "the environment's picture, last, until a view shows none of it"
         : sky             ? "a gradient, last, at the far plane, until a view shows none of it"
                           : "one colour: the clear's",
         sky},
    };
    for (int i = 0; i < SCENE_EFFECT_COUNT; i++)
        out[i] = effects[i];
}

scene_draw_counts scene_renderer_counts(const scene_renderer *r)
{
    return r->counts;
}
