/* SPDX-License-Identifier: MIT
 *
 * The life of an effect: create, resize, destroy, and what it tells about itself.
 */
#include "effect.h"

#include "gpu/program_cache.h"
#include "random.h"

#include <stdlib.h>
#include <string.h>

static bool check_size(const glssao__log *log, int width, int height, int max_size)
{
    if (width >= 1 && height >= 1 && width <= max_size && height <= max_size)
        return true;
    glssao__log_write(log, GLSSAO_LOG_ERROR, "size = %d x %d: want 1 to %d", width, height, max_size);
    return false;
}

static glssao_result check_config(const glssao_config *config, const glssao__gl *gl, const glssao__log *log)
{
    if (!check_size(log, config->width, config->height, gl->max_size))
        return GLSSAO_INVALID_ARGUMENT;
    if ((unsigned)config->path > GLSSAO_PATH_COMPUTE)
        return glssao__log_refuse(log, "config.path = %d: unknown", (int)config->path);
    if (config->path == GLSSAO_PATH_COMPUTE && !gl->compute) {
        glssao__log_write(log, GLSSAO_LOG_ERROR,
                          "the context lacks compute shaders that write images, which config.path requires");
        return GLSSAO_UNSUPPORTED_CONTEXT;
    }
    return GLSSAO_OK;
}

/* A folder that others can write to is not used: a linked program is code that the driver runs. */
static char *copy_cache_folder(const char *folder, const glssao__log *log)
{
    if (!folder)
        return NULL;
    if (!glssao__program_cache_trusts(folder)) {
        glssao__log_write(log, GLSSAO_LOG_WARNING,
                          "config.program_cache = %s: not a folder that this user owns and nobody else can write to; "
                          "programs are not kept",
                          folder);
        return NULL;
    }
    char *copy = malloc(strlen(folder) + 1);
    return copy ? strcpy(copy, folder) : NULL; /* without it, programs are compiled each time */
}

static glssao_result init(glssao_effect *effect, const glssao_config *config)
{
    const glssao__gl_loader loader = {config->load, config->load_user, config->get_proc};
    glssao__gl *gl = &effect->gl;
    const char *missing = NULL;
    if (!glssao__gl_load(gl, &loader, &missing)) {
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "the context lacks %s", missing);
        return GLSSAO_UNSUPPORTED_CONTEXT;
    }
    const glssao_result result = check_config(config, gl, &effect->log);
    if (result != GLSSAO_OK)
        return result;
    effect->can = (glssao__capabilities){.compute = gl->compute,
                                         .path = config->path,
                                         .is_software = gl->is_software,
                                         .max_size = gl->max_size,
                                         .max_point_size = gl->max_point_size};
    effect->host_restores_state = config->host_restores_state;
    effect->seed = config->seed;
    effect->size[0] = config->width;
    effect->size[1] = config->height;
    effect->accumulation.sampling_error = -1.0;
    effect->last.result = MAP_AMBIENT_0;
    effect->last.other = MAP_AMBIENT_1;
    effect->resources.gl = gl;
    effect->resources.log = &effect->log;
    effect->resources.programs.cache_folder = copy_cache_folder(config->program_cache, &effect->log);
    glssao__uniforms_init(&effect->uniforms, effect->seed);
    return glssao__state_check(gl, &effect->log, "glssao_create");
}

glssao_result glssao_create(const glssao_config *config, glssao_effect **out_effect)
{
    if (out_effect)
        *out_effect = NULL;
    if (!config)
        return GLSSAO_INVALID_ARGUMENT;
    const glssao__log log = {config->log, config->log_user};
    if (!out_effect)
        return glssao__log_refuse(&log, "out_effect is NULL");
    if (!config->load && !config->get_proc)
        return glssao__log_refuse(&log, "config.load and config.get_proc are NULL: one of them must find GL functions");
    glssao_effect *effect = calloc(1, sizeof *effect);
    if (!effect) {
        glssao__log_write(&log, GLSSAO_LOG_ERROR, "no memory for the effect");
        return GLSSAO_OUT_OF_MEMORY;
    }
    effect->log = log;
    glssao_result result = init(effect, config);
    if (result != GLSSAO_OK) {
        free(effect->resources.programs.cache_folder);
        free(effect);
        return result;
    }
    const glssao__state_need need = {STATE_DRAW | STATE_UNIFORMS | STATE_TRANSFER, .units = 1u};
    glssao__state host;
    glssao__state_save(&effect->gl, &need, effect->host_restores_state, &host);
    result = glssao__resources_init(&effect->resources, effect->size, effect->seed, !config->no_timers);
    glssao__state_restore(&effect->gl, &host);
    glssao__resources_check(&effect->resources, "glssao_create");
    if (result != GLSSAO_OK) {
        glssao_destroy(effect);
        return result;
    }
    *out_effect = effect;
    return GLSSAO_OK;
}

void glssao_destroy(glssao_effect *effect)
{
    if (!effect)
        return;
    if (effect->normals.is_open) /* the host's framebuffer comes back; deleting a bound one would bind 0 */
        glssao__normals_close(&effect->normals, &effect->gl, &effect->resources.targets[MAP_NORMAL],
                              effect->host_restores_state);
    glssao__accumulate_destroy(&effect->accumulation, &effect->gl);
    glssao__depth_copy_destroy(&effect->depth_copy, &effect->gl);
    glssao__resources_destroy(&effect->resources);
    free(effect);
}

glssao_result glssao_resize(glssao_effect *effect, int width, int height)
{
    if (!effect)
        return GLSSAO_INVALID_ARGUMENT;
    if (effect->normals.is_open)
        return glssao__log_refuse(&effect->log, "glssao_resize called before glssao_end_normals");
    if (!check_size(&effect->log, width, height, effect->gl.max_size))
        return GLSSAO_INVALID_ARGUMENT;
    if (width == effect->size[0] && height == effect->size[1])
        return GLSSAO_OK;
    glssao_result result = glssao__state_check(&effect->gl, &effect->log, "glssao_resize");
    if (result != GLSSAO_OK)
        return result;
    const int size[2] = {width, height};
    const glssao__state_need need = {STATE_DRAW | STATE_TRANSFER, .units = 1u};
    glssao__state host;
    glssao__state_save(&effect->gl, &need, effect->host_restores_state, &host);
    result = glssao__resources_resize(&effect->resources, size);
    glssao__state_restore(&effect->gl, &host);
    glssao__resources_collect(&effect->resources);
    glssao__resources_check(&effect->resources, "glssao_resize");
    if (result != GLSSAO_OK)
        return result;
    glssao__accumulate_stop(&effect->accumulation, &effect->gl);
    memcpy(effect->size, size, sizeof effect->size);
    effect->known = (glssao__host_textures){0};
    effect->history.frames = 0;
    effect->normals.known_depth = 0;
    effect->last.result = MAP_AMBIENT_0;
    effect->last.other = MAP_AMBIENT_1;
    effect->last.has_tiles = false;
    effect->last.has_bent = false;
    effect->last.margin = 0;
    memset(effect->last.viewport, 0, sizeof effect->last.viewport);
    return GLSSAO_OK;
}

uint32_t glssao_map(const glssao_effect *effect, glssao_map_id id, int *out_width, int *out_height)
{
    uint32_t texture = 0;
    int width = 0, height = 0;
    enum glssao__map map = MAP_NONE;
    if (effect)
        switch (id) {
        case GLSSAO_MAP_AMBIENT:
            map = effect->last.result;
            break;
        case GLSSAO_MAP_AMBIENT_OTHER:
            map = effect->last.other;
            break;
        case GLSSAO_MAP_NORMAL:
            map = MAP_NORMAL;
            break;
        case GLSSAO_MAP_REBUILT_NORMAL:
            map = MAP_REBUILT;
            break;
        case GLSSAO_MAP_TILES:
            map = effect->last.has_tiles ? MAP_TILE_RINGS : MAP_NONE;
            break;
        case GLSSAO_MAP_BENT_NORMAL:
            map = effect->last.has_bent ? MAP_BENT : MAP_NONE;
            break;
        case GLSSAO_MAP_RANDOM_VECTOR:
            texture = effect->resources.random_vector_map;
            width = height = RANDOM_VECTOR_MAP_SIZE;
            break;
        case GLSSAO_MAP_DEPTH:
            texture = effect->last.depth_texture;
            width = texture ? effect->size[0] : 0;
            height = texture ? effect->size[1] : 0;
            break;
        }
    if (map != MAP_NONE) {
        texture = effect->resources.targets[map].texture;
        width = effect->resources.targets[map].width;
        height = effect->resources.targets[map].height;
    }
    if (out_width)
        *out_width = width;
    if (out_height)
        *out_height = height;
    return texture;
}

const glssao_constants *glssao_get_constants(const glssao_effect *effect)
{
    return effect ? &effect->uniforms.ssao : NULL;
}
