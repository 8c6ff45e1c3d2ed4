/* SPDX-License-Identifier: MIT
 *
 * Frames of the example renderer, for measuring: a scene, and what draws it.
 */
#ifndef GLSSAO_BENCH_ECONOMY_STAGE_H
#define GLSSAO_BENCH_ECONOMY_STAGE_H

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
bool economy_stage_open(economy_stage *s, const bench_scene *b, int width, int height, char *error, size_t error_size);
void economy_stage_close(economy_stage *s);

/* What draws a stage: programs, textures, targets. */
typedef struct economy_player {
    const economy_stage *stage;
    scene_renderer *renderer;
    glssao_effect *effect;
    GLuint depth, color, framebuffer;
} economy_player;

/* Functions of OpenGL for the effect come from `load`. False, with one line in `error`; economy_player_close is due in
 * either case. */
bool economy_player_open(economy_player *p, const economy_stage *s, glssao_load_fn load, void *load_user, char *error,
                         size_t error_size);
void economy_player_close(economy_player *p);

/* What of a frame is drawn. */
typedef struct economy_frame {
    int quality; /* of the horizon technique; -1: no occlusion */
    glssao_tiles tiles;
    bool main;
    bool everything; /* normals are rebuilt though they are there, and nothing that the host knows is told */
} economy_frame;

/* Draws it, and waits for it. The renderer has been configured. */
void economy_player_draw(economy_player *p, const economy_frame *frame);

#endif
