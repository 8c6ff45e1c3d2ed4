/* SPDX-License-Identifier: MIT
 *
 * Draws a scene as the D3D12 demo does. First comes a shadow map, then a pre-pass that writes view-space normals and
 * depth. The main pass tests depth with EQUAL and does not write it. It scales ambient light by accessibility, adds
 * direct light, and draws the sky. Blended materials come last and get no occlusion. Unlit materials show their base
 * colour. All passes compute positions by one expression marked invariant. A pass that the scene, the lighting or the
 * options do not need is skipped, and objects outside the view are not drawn.
 *
 * GL state: each draw function sets what it needs (viewport, program, vertex array, texture units 0 to 7, depth,
 * culling, blending, masks, sRGB, polygon offset) and restores GL's defaults, except for the viewport. It does not
 * touch scissor, stencil and polygon mode, which must be off.
 */
#pragma once

#include "scene.h"

typedef struct scene_renderer scene_renderer;

typedef struct scene_view {
    float view_from_world[16]; /* column-major */
    float clip_from_view[16];
    int width, height; /* pixels */
    int margin;        /* pixels on each side that the ambient map does not cover */
} scene_view;

typedef struct scene_environment scene_environment;

typedef struct scene_lighting {
    float ambient[3];         /* linear radiance of the environment at the horizon, scaled by accessibility */
    float ambient_tilt[3];    /* how much more comes from straight above, and less from straight below */
    float up[3];              /* where the sky is straight above, in world space; 0, 0, 0: +y */
    float direction_world[3]; /* unit, the way the light travels */
    float directional[3];     /* linear irradiance; all 0: no such light */
    float sky[3];             /* linear, at the horizon; drawn where nothing is */
    float sky_tilt[3];        /* how much more straight above, as with ambient; all 0: one colour */
    bool plain;               /* draws no sky, but `background` where nothing is */
    float background[4];      /* linear colour, and alpha, by which it is multiplied */
    const scene_environment *environment; /* in the place of the four gradients; NULL: those */
    const scene_light *lights;            /* further lights; they cast no shadow. Past 16, the rest is left out */
    uint32_t light_count;
} scene_lighting;

/* A small environment and a sun. */
scene_lighting scene_default_lighting(void);

/* The same environment with the scene's own lights, if it has any. The first directional one replaces the sun. A file
 * has no exposure. If its strongest light gives the middle of the scene more irradiance than pi, which makes a white
 * surface that faces it white, all lights are dimmed alike. `out_rest` takes the other lights: room for s->light_count.
 */
scene_lighting scene_lighting_of(const scene *s, scene_light *out_rest);

/* Loads a picture of the surroundings, of a kind that environment.h lists. It lights matte surfaces by its irradiance
 * and shiny ones by reflections blurred for their roughness, and it is the sky. On failure NULL, and one line in
 * `error` that names the file and the fault. */
scene_environment *scene_environment_load(const char *path, failure *fault);
void scene_environment_destroy(scene_environment *e);

/* Replaces the built-in environment and its sun by this one (NULL: none), which must outlive the lighting. The scene's
 * own lights stay. */
void scene_lighting_surround(scene_lighting *lighting, const scene *s, const scene_environment *e);
/* Turns sky and environment, and the built-in sun where the scene has no lights, so that `up` is up. */
void scene_lighting_turn(scene_lighting *lighting, const scene *s, const float up[3]);
/* Whether there is any ambient light. */
bool scene_lighting_has_ambient(const scene_lighting *lighting);

typedef struct scene_draw_options { /* zero is the plainest */
    bool shadows;                   /* of the directional light; ambient light is not shadowed */
    int shadow_size;                /* side of the shadow map in texels; 0: 2048 */
    bool mapped_normals;     /* the pre-pass applies normal maps, so that occlusion sees them; else it does not */
    bool specular_occlusion; /* accessibility darkens ambient reflections by their lobe; else like the rest */
    bool layers;             /* scene_draw_layer will be called */
    bool motion;             /* scene_draw_motion will be called */
    bool no_picture;         /* the main pass is not drawn: neither its programs nor a shadow map are made */
    bool no_prepass; /* scene_draw_normals will not be called: the main pass finds the nearest surfaces itself */
    /* To measure what skipping saves: runs every part of the shaders on every surface, culls nothing, and draws shadow
     * map and sky in each frame. Matte and unlit materials then look different. */
    bool everything;
    bool multi_bounce; /* occluded ambient light takes on the surface's colour */
    bool bent;         /* the ambient map is that of bent normals: ambient light comes from where surfaces are open */
    float left_out;    /* the share of occlusion, 0 to 1, that the picture does not show */
} scene_draw_options;

/* Uploads the scene through the table in gl.h, which must be loaded. Makes only the shaders and textures that the scene
 * needs (alpha test, instancing, texture, vertex colour ...). The scene must outlive the renderer. On failure NULL, and
 * one line in `error`. */
scene_renderer *scene_renderer_create(const scene *s, failure *fault);
/* The same, and frees the texels of each opaque image once they are uploaded: the ray tracer needs only the others.
 * Shares the programs of `like`, another renderer of this context or NULL; they last as long as one of the two does. */
scene_renderer *scene_renderer_create_spending(scene *s, const scene_renderer *like, failure *fault);
void scene_renderer_destroy(scene_renderer *r);

/* Chooses what the passes do from now on, and makes the programs and the shadow map for it. Lighting may change from
 * frame to frame, but this call decides whether it has a directional light, other lights and an environment. Without it
 * the first drawing chooses the simplest options, and draws nothing if they fail. On failure false, and one line in
 * `error`; the renderer then still draws. */
bool scene_renderer_configure(scene_renderer *r, const scene_lighting *lighting, const scene_draw_options *options,
                              failure *fault);

/* Which effects the scene, the lighting and the options need, and why; out[SCENE_EFFECT_COUNT]. */
enum { SCENE_EFFECT_COUNT = 9 };
typedef struct scene_effect {
    const char *name, *reason; /* static */
    bool used;
} scene_effect;
void scene_renderer_effects(const scene_renderer *r, const scene_lighting *lighting, scene_effect *out);

/* Draw calls of the last pass of each kind. `culled` counts those that the normals and main passes skipped because they
 * are outside the view. */
typedef struct scene_draw_counts {
    unsigned shadow, normals, main, blended, sky, culled;
} scene_draw_counts;
scene_draw_counts scene_renderer_counts(const scene_renderer *r);

/* Draw calls of the scene, and those within the view. The rest are skipped. */
typedef struct scene_seen {
    unsigned opaque, opaque_total, blended, blended_total;
    unsigned lit; /* of the opaque ones within the view, those that light falls on */
} scene_seen;
scene_seen scene_find_seen(const scene_renderer *r, const scene_view *view);

/* Draws the shadow map if one is needed and the light's direction has changed. It then leaves framebuffer 0 bound. */
void scene_draw_shadow(scene_renderer *r, const scene_lighting *lighting);
/* The shadow map, a depth texture; 0 where there is none. */
unsigned scene_shadow_map(const scene_renderer *r, int *out_size);

/* Draws opaque and alpha-tested triangles into the bound framebuffer: view-space unit normals, facing the viewer
 * on double-sided materials, to output 0 (alpha 0), and depth (LESS, written). Does not clear. */
void scene_draw_normals(scene_renderer *r, const scene_view *view);

/* Clears the bound framebuffer's depth buffer and draws a layer behind the pre-pass's `depth_texture` into it: the
 * nearest back face at or behind the visible surface, or the nearest front face behind it. Double-sided materials count
 * as back faces. Needs options.layers. */
typedef enum scene_layer { SCENE_LAYER_BACK, SCENE_LAYER_SECOND } scene_layer;
void scene_draw_layer(scene_renderer *r, const scene_view *view, unsigned depth_texture, scene_layer layer);

/* Poses the scene anew: `s` is the same file at another time, and takes the place of the renderer's scene, which must
 * live until this returns. What the renderer drew so far becomes the last pose. False, and nothing changed, where the
 * two differ in more than the places of vertices and instances, or memory is short. */
bool scene_renderer_pose(scene_renderer *r, const scene *s);

/* For each opaque pixel, its uv minus the uv that its point had in the view `last` and the last pose, to output 0 (red
 * and green) of the bound framebuffer, whose depth buffer holds the pre-pass's depth; 1e4 where the point was behind
 * that eye, and where nothing is. Needs options.motion. */
void scene_draw_motion(scene_renderer *r, const scene_view *view, const scene_view *last);

/* Draws the picture into the bound framebuffer, whose depth buffer holds the pre-pass's depth: clears colour to
 * the sky at the horizon, opaque with depth EQUAL (with options.no_prepass: clears depth, opaque with depth LEQUAL),
 * the sky where it is no single colour with depth LEQUAL (unless the last drawing of the same view, without scissors,
 * showed none of it), then blended materials back to front with depth LEQUAL and no depth write. Output is linear; the
 * caller's framebuffer is GL_SRGB8_ALPHA8 with GL_FRAMEBUFFER_SRGB enabled by this call. `ambient_map` is an
 * accessibility texture (red; any size, sampled linearly by uv), 0: fully accessible. */
void scene_draw_main(scene_renderer *r, const scene_view *view, const scene_lighting *lighting, unsigned ambient_map);

/* Draws texture `map` over the whole bound framebuffer of width x height, through one channel transform:
 * out = scale * texel + bias, with only red spread to rgb if `red_only`; alpha 1, sampled linearly, stored without
 * sRGB encoding. For debug views and read-back at full size. */
void scene_draw_map(scene_renderer *r, unsigned map, int width, int height, bool red_only, float scale, float bias);

/* The same within a rectangle of the bound framebuffer, in pixels from its lower left. */
typedef struct scene_rectangle {
    int x, y, width, height;
} scene_rectangle;
void scene_draw_map_in(scene_renderer *r, unsigned map, scene_rectangle place, bool red_only, float scale, float bias);

/* View distance of each pixel (0 where nothing was drawn: depth at its far value) from a window-depth texture, to
 * output 0 of the bound framebuffer. Exact for perspective (off-centre, infinite, reversed too) and orthographic
 * projections; depth runs over -1..1 in clip space. */
void scene_draw_view_distance(scene_renderer *r, const scene_view *view, unsigned depth_texture);
/* The same times `scale`, in rgb: a grey picture. */
void scene_draw_distance_picture(scene_renderer *r, const scene_view *view, unsigned depth_texture, float scale);

/* Normal and view distance, as for scene_draw_view_distance, of one of each `step` x `step` pixels, the one at
 * `offset`, to output 0 of the bound framebuffer, which is that much smaller, rounded up. For trace_seen. */
void scene_draw_surfaces(scene_renderer *r, const scene_view *view, unsigned depth_texture, unsigned normal_texture,
                         int step, const int offset[2]);
