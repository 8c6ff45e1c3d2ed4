/* SPDX-License-Identifier: MIT
 *
 * Frames of the example renderer, to be timed: a scene, and the objects that draw it.
 */
#pragma once

#include "context.h"
#include "draw.h"
#include "gl.h"
#include "scenes.h"

#include <glssao/glssao.h>

typedef struct economy_stage {
    scene *scene;
    scene_view view;
    float radius;
    scene_light *lights; /* of lighting */
    scene_lighting lighting;
} economy_stage;

/* False, with one line in `error`; economy_stage_close is due in either case. */
bool economy_stage_open(economy_stage *s, const bench_scene *b, int width, int height, failure *fault);
void economy_stage_close(economy_stage *s);

/* Programs, textures and targets that draw a stage. */
typedef struct economy_player {
    const economy_stage *stage;
    scene_renderer *renderer;
    glssao_effect *effect;
    GLuint depth, color, framebuffer;
} economy_player;

/* Functions of OpenGL for the effect come from `load`. False, with one line in `error`; economy_player_close is due in
 * either case. */
bool economy_player_open(economy_player *p, const economy_stage *s, glssao_load_fn load, void *load_user,
                         failure *fault);
void economy_player_close(economy_player *p);

/* Which parts of a frame are drawn. */
typedef struct economy_frame {
    int quality; /* of the horizon technique; -1: no occlusion */
    glssao_tiles tiles;
    bool main;
    bool everything; /* normals are rebuilt although they exist, and the effect gets no hints from the host */
} economy_frame;

/* Draws the frame with the configured renderer and waits until it is done. */
void economy_player_draw(economy_player *p, const economy_frame *frame);
