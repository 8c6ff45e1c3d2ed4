/* SPDX-License-Identifier: MIT
 *
 * Shared by the tests of the scene's draw passes: draws a frame and reads it back.
 */
#pragma once

#include "draw.h"
#include "small_scene.h"

enum {
    FRAME_SIZE = 64, /* of `frame_front` */
    FRAME_MIDDLE = FRAME_SIZE / 2 * FRAME_SIZE + FRAME_SIZE / 2,
    FRAME_EMPTY = 9 /* the clear value of the normal map; no unit normal equals it */
};

/* An orthographic view along -z. The square of side 2 about the origin fills the picture; everything within 2 of the
 * origin is visible. Normals in view space equal those in world space. */
extern const scene_view frame_front;

/* Rows bottom to top; the picture is `view->width` pixels square. */
typedef struct frame {
    float *normals; /* 4 a pixel */
    float *depth;
    uint8_t (*color)[4]; /* as stored: sRGB */
    scene_draw_counts counts;
} frame;

/* Pre-pass (not with options.no_prepass) and main pass; `ambient_map` as for scene_draw_main. */
frame frame_draw(const small_scene *s, const scene_view *view, const scene_lighting *lighting, unsigned ambient_map);
/* The same with options; NULL takes the renderer's defaults. */
frame frame_draw_with(const small_scene *s, const scene_view *view, const scene_lighting *lighting,
                      const scene_draw_options *options, unsigned ambient_map);
/* The same by a renderer that the caller keeps. */
frame frame_draw_by(scene_renderer *r, const scene_view *view, const scene_lighting *lighting, unsigned ambient_map);
void frame_free(frame *f);
#define test_end_drawn frame_free /* for SCOPED */

/* Whether the pre-pass drew that pixel; the number of pixels it drew. */
bool frame_is_drawn(const frame *f, int pixel);
int frame_count_drawn(const frame *f, int pixels);
/* Draws, counts, and frees the scene. */
int frame_count_drawn_by(small_scene *s);

/* A unit square that faces `frame_front` and covers a quarter of its picture; NULL leaves it in place. */
small_scene *frame_one_quad(scene_material material, const float world_from_mesh[16]);
/* Adds another such square to the scene. */
void frame_add_quad(small_scene *s, scene_material material, const float world_from_mesh[16]);

/* Fails unless the colour equals these linear values, sRGB-encoded, to 1/255. */
void frame_assert_color(const uint8_t color[4], double r, double g, double b);
