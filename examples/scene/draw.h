/* SPDX-License-Identifier: MIT
 *
 * Draws a scene the way the D3D12 demo does: a pre-pass that writes view-space normals and depth, then a main pass
 * with depth EQUAL and no depth write that scales ambient light by accessibility and adds one directional light.
 * Both passes compute positions by one shared expression marked invariant. Blended materials come last, over the
 * opaque picture, and get no occlusion of their own. Unlit materials show their base colour: no light, no occlusion.
 *
 * GL state: each draw function sets what it needs (viewport, program, vertex array, texture units 0 and 1, depth,
 * culling, blending, masks, sRGB) and leaves GL's defaults behind, the viewport aside. Scissor, stencil and polygon
 * state it leaves alone; they are expected off.
 */
#ifndef GLSSAO_EXAMPLES_DRAW_H
#define GLSSAO_EXAMPLES_DRAW_H

#include "scene.h"

typedef struct scene_renderer scene_renderer;

typedef struct scene_view {
    float view_from_world[16];  /* column-major */
    float clip_from_view[16];
    int width, height;          /* pixels */
} scene_view;

typedef struct scene_lighting {
    float ambient[3];                /* linear radiance, scaled by accessibility */
    float direction_world[3];        /* unit, the way the light travels */
    float directional[3];            /* linear irradiance */
    float sky[3];                    /* linear; drawn where nothing is */
} scene_lighting;

/* What the example programs light with. */
scene_lighting scene_default_lighting(void);

/* Uploads the scene through the table in gl.h, which must be loaded. Shaders and textures only for what the scene
 * holds (alpha test, instancing, texture, vertex colour ...). The scene must outlive the renderer. NULL on
 * failure, with one line in `error`. */
scene_renderer *scene_renderer_create(const scene *s, char *error, size_t error_size);
void scene_renderer_destroy(scene_renderer *r);

/* Draws opaque and alpha-tested triangles into the bound framebuffer: view-space unit normals, facing the viewer
 * on double-sided materials, to output 0 (alpha 0), and depth (LESS, written). Does not clear. */
void scene_draw_normals(scene_renderer *r, const scene_view *view);

/* Draws the picture into the bound framebuffer, whose depth buffer holds the pre-pass's depth: clears colour to
 * the sky, opaque with depth EQUAL, then blended materials back to front with depth LEQUAL and no depth write.
 * Output is linear; the caller's framebuffer is GL_SRGB8_ALPHA8 with GL_FRAMEBUFFER_SRGB enabled by this call.
 * `ambient_map` is an accessibility texture (red; any size, sampled linearly by uv), 0: fully accessible. */
void scene_draw_main(scene_renderer *r, const scene_view *view, const scene_lighting *lighting, unsigned ambient_map);

/* Draws texture `map` over the whole bound framebuffer of width x height, through one channel transform:
 * out = scale * texel + bias, with only red spread to rgb if `red_only`; alpha 1, sampled linearly, stored without
 * sRGB encoding. For debug views and read-back at full size. */
void scene_draw_map(scene_renderer *r, unsigned map, int width, int height, bool red_only, float scale, float bias);

/* View distance of each pixel (0 where nothing was drawn: depth at its far value) from a window-depth texture, to
 * output 0 of the bound framebuffer. Exact for perspective (off-centre, infinite, reversed too) and orthographic
 * projections; depth runs over -1..1 in clip space. */
void scene_draw_view_distance(scene_renderer *r, const scene_view *view, unsigned depth_texture);

#endif
