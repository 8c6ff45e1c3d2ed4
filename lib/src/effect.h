/* SPDX-License-Identifier: MIT
 *
 * An effect: a composition of what its modules keep.
 */
#ifndef GLSSAO_EFFECT_H
#define GLSSAO_EFFECT_H

#include "accumulate.h"
#include "frame/execute.h"
#include "history.h"
#include "input/depth_copy.h"
#include "input/host_textures.h"
#include "log.h"
#include "normals.h"

/* What the last frame left behind. */
typedef struct glssao__last_frame {
    uint64_t number; /* of frames that succeeded; 0: none yet */
    enum glssao__map result, other;
    bool has_tiles, has_bent;
    int margin;
    int viewport[4];       /* the frame's */
    gl_uint depth_texture; /* the host's, as last handed over */
    int draw_calls[GLSSAO_PASS_COUNT];
} glssao__last_frame;

struct glssao_effect {
    glssao__gl gl;
    glssao__log log;
    glssao__capabilities can;
    bool host_restores_state;
    unsigned doubts; /* told of: a bit for each enum glssao__doubt */
    uint32_t seed;
    int size[2]; /* full size, pixels */
    glssao__resources resources;
    glssao__uniforms uniforms;
    glssao__host_textures known; /* with host_restores_state */
    glssao__accumulation accumulation;
    glssao__history history;
    glssao__normals normals;
    glssao__depth_copy depth_copy;
    glssao__last_frame last;
    unsigned told; /* bit i: what glssao_apply ignores was logged */
};

/* False, after a line in the log, between glssao_begin_normals and glssao_end_normals. */
bool glssao__effect_is_closed(const glssao_effect *effect, const char *function);
/* Refuses state of the host that no call can work with. */
glssao_result glssao__effect_check_state(const glssao_effect *effect, const char *function);

#endif
