/* SPDX-License-Identifier: MIT
 *
 * What the tests of the scene's draw passes share: a frame drawn and read back, and a picture to draw it in.
 */
#ifndef GLSSAO_TESTS_DRAW_FRAME_H
#define GLSSAO_TESTS_DRAW_FRAME_H

#include "draw.h"
#include "small_scene.h"

enum {
    FRAME_SIZE = 64, /* of `frame_front` */
    FRAME_MIDDLE = FRAME_SIZE / 2 * FRAME_SIZE + FRAME_SIZE / 2,
    FRAME_EMPTY = 9 /* what the normal map is cleared to: no unit normal has it */
};

/* Looks along -z at the square of side 2 about the origin, which fills the picture, without perspective; what lies
 * within 2 of it is seen. Normals in view space are those in world space. */
extern const scene_view frame_front;

/* Rows bottom to top, pixels square as `view->width`. */
typedef struct frame {
    float *normals; /* 4 a pixel */
    float *depth;
    uint8_t (*color)[4]; /* as stored: sRGB */
    scene_draw_counts counts;
} frame;

/* Pre-pass and main pass; `ambient_map` as for scene_draw_main. */
frame frame_draw(const small_scene *s, const scene_view *view, const scene_lighting *lighting, unsigned ambient_map);
/* The same with options, NULL: a renderer that nobody configured. */
frame frame_draw_with(const small_scene *s, const scene_view *view, const scene_lighting *lighting,
                      const scene_draw_options *options, unsigned ambient_map);
void frame_free(frame *f);

/* Whether the pre-pass drew that pixel; of how many it did. */
bool frame_is_drawn(const frame *f, int pixel);
int frame_count_drawn(const frame *f, int pixels);
/* Draws, counts, and frees the scene. */
int frame_count_drawn_by(small_scene *s);

/* A unit square, its front towards `frame_front`, a quarter of its picture; NULL: not moved. */
small_scene *frame_one_quad(scene_material material, const float world_from_mesh[16]);
/* Another one of those, added to the scene. */
void frame_add_quad(small_scene *s, scene_material material, const float world_from_mesh[16]);

/* Fails unless the colour is these linear ones, sRGB-encoded, to 1/255. */
void frame_assert_color(const uint8_t color[4], double r, double g, double b);

#endif
