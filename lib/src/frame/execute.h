/* SPDX-License-Identifier: MIT
 *
 * Runs a schedule: makes the programs and maps that its steps need, and draws or dispatches them.
 */
#ifndef GLSSAO_FRAME_EXECUTE_H
#define GLSSAO_FRAME_EXECUTE_H

#include "frame/steps.h"
#include "frame/uniforms.h"
#include "gpu/programs.h"
#include "gpu/state.h"
#include "gpu/timers.h"
#include "input/host_textures.h"

/* What steps run with. */
typedef struct glssao__executor {
    const glssao__gl *gl;
    const glssao__log *log;
    glssao__dialect dialect;
    glssao__programs programs;
    glssao__target targets[MAP_COUNT]; /* from MAP_FIRST_TARGET on */
    glssao__target retired[MAP_COUNT]; /* replaced during a call; deleted by glssao__executor_collect */
    gl_uint random_vector_map, vertex_array;
    gl_uint samplers[SAMPLER_COUNT], uniform_buffers[BLOCK_COUNT];
    glssao__timers timers;
} glssao__executor;

/* Makes what every frame needs, for maps of the full size `size`. Fails as glssao_create does; glssao__executor_destroy is
 * due either way. */
glssao_result glssao__executor_init(glssao__executor *e, const int size[2], uint32_t seed, bool has_timers);
void glssao__executor_destroy(glssao__executor *e);

/* Makes the maps that exist at any time anew at another full size, and drops the others; on failure all are as before. */
glssao_result glssao__executor_resize(glssao__executor *e, const int size[2]);

/* Compiles the programs and makes the maps of a schedule; on failure all maps are as before. */
glssao_result glssao__executor_prepare(glssao__executor *e, const glssao__schedule *schedule);

/* Which parts of the host's state preparing and running the schedule changes. */
glssao__state_need glssao__executor_need(const glssao__executor *e, const glssao__schedule *schedule);

/* Runs a schedule that was prepared. `sky_depth`: what the depth sampler returns beyond the border. */
void glssao__executor_run(glssao__executor *e, const glssao__schedule *schedule, const glssao__host_inputs *host,
                          const glssao__uniforms *uniforms, float sky_depth);

/* Multiplies the map into width x height pixels of a framebuffer from its lower left corner; needs STATE_BLEND. */
glssao_result glssao__executor_prepare_apply(glssao__executor *e);
void glssao__executor_apply(glssao__executor *e, gl_uint framebuffer, enum glssao__map map, int width, int height);

/* Deletes replaced maps. Due after the host's state is restored: until then a name may be bound to one of its units. */
void glssao__executor_collect(glssao__executor *e);

/* With GLSSAO_CHECK_GL only: logs where the driver holds an error. It takes errors of the host too. */
void glssao__executor_check(const glssao__executor *e, const char *where);

#endif
