/* SPDX-License-Identifier: MIT
 *
 * The GL objects that steps run with: programs, maps, samplers, buffers.
 */
#ifndef GLSSAO_FRAME_RESOURCES_H
#define GLSSAO_FRAME_RESOURCES_H

#include "frame/steps.h"
#include "frame/uniforms.h"
#include "gpu/programs.h"
#include "gpu/timers.h"

/* The plain uniforms of all programs, as glssao__program.locations has them. */
enum { SECOND_IMAGE_UNIT = 1 }; /* of a dispatch's second target; the first one's is 0 */
enum { UNIFORM_HORIZONTAL, UNIFORM_ORIGIN, UNIFORM_TILE_RANGE, UNIFORM_REGION, UNIFORM_SHADE, UNIFORM_PICTURE };

typedef struct glssao__resources {
    const glssao__gl *gl;
    const glssao__log *log;
    glssao__programs programs;
    glssao__target targets[MAP_COUNT]; /* from MAP_FIRST_TARGET on */
    glssao__target retired[MAP_COUNT]; /* replaced during a call; deleted by glssao__resources_collect */
    gl_uint random_vector_map, vertex_array;
    gl_uint pair_framebuffer; /* of steps with two targets; 0: not needed yet */
    gl_uint samplers[SAMPLER_COUNT], uniform_buffers[BLOCK_COUNT];
    glssao__timers timers;
} glssao__resources;

/* Makes what every frame needs, for maps of the full size `size`. Fails as glssao_create does;
 * glssao__resources_destroy is due either way. */
glssao_result glssao__resources_init(glssao__resources *r, const int size[2], uint32_t seed, bool has_timers);
void glssao__resources_destroy(glssao__resources *r);

/* Makes the maps that exist at any time anew at another full size, and drops the others; on failure all are as before.
 */
glssao_result glssao__resources_resize(glssao__resources *r, const int size[2]);

/* Compiles the programs and makes the maps of a schedule; on failure all maps are as before. */
glssao_result glssao__resources_prepare(glssao__resources *r, const glssao__schedule *schedule);
/* Compiles a program of glssao_apply. */
glssao_result glssao__resources_prepare_apply(glssao__resources *r, const glssao__variant *variant);

/* Binds the framebuffer of steps with two targets, with these textures attached; 0: none. */
void glssao__resources_attach(const glssao__resources *r, gl_uint first, gl_uint second);

/* What the map of bent normals holds where there is no surface: the direction to the eye, open. */
extern const gl_float glssao__bent_of_sky[4];

/* A program that was prepared. */
const glssao__program *glssao__resources_program(const glssao__resources *r, enum glssao__shader shader,
                                                 const glssao__variant *variant);

/* Deletes replaced maps. Due after the host's state is restored: until then a name may be bound to one of its units. */
void glssao__resources_collect(glssao__resources *r);

/* With GLSSAO_CHECK_GL only: logs where the driver holds an error. It takes errors of the host too. */
void glssao__resources_check(const glssao__resources *r, const char *where);

#endif
