/* SPDX-License-Identifier: MIT
 *
 * The life of an effect: create, resize, destroy, and what it tells about itself.
 */
#include "effect.h"

#include <stdlib.h>
#include <string.h>

static bool check_size(const glssao__log_sink *log, int width, int height, int max_size)
{
    if (width >= 1 && height >= 1 && width <= max_size && height <= max_size)
        return true;
    glssao__log_write(log, GLSSAO_LOG_ERROR, "size = %d x %d: want 1 to %d", width, height, max_size);
    return false;
}

static bool check_path(const glssao__log_sink *log, glssao_path path)
{
    if ((unsigned)path <= GLSSAO_PATH_COMPUTE)
        return true;
    glssao__log_write(log, GLSSAO_LOG_ERROR, "config.path = %d: unknown", (int)path);
    return false;
}

static glssao_result make_sized(glssao_effect *effect, int width, int height, glssao__target *out_normal,
                                glssao__ambient_maps *out_ambient)
{
    glssao_result result = glssao__maps_make_normal(effect, width, height, out_normal);
    if (result != GLSSAO_OK)
        return result;
    result = glssao__maps_make_ambient(effect, (width + 1) / 2, (height + 1) / 2, out_ambient);
    if (result != GLSSAO_OK)
        glssao__maps_delete_target(&effect->gl, out_normal);
    return result;
}

static glssao_result make_objects(glssao_effect *effect)
{
    const glssao__gl *gl = &effect->gl;
    /* Compiling a pass checks the driver's layout of the blocks; this one takes the least time. */
    glssao__program_object program;
    glssao_result result = glssao__program_get(effect, SHADER_APPLY, 0, &program);
    if (result == GLSSAO_OK)
        result = glssao__maps_make_random_vector(effect);
    if (result == GLSSAO_OK)
        result = make_sized(effect, effect->width, effect->height, &effect->normal_map, &effect->ambient);
    if (result != GLSSAO_OK)
        return result;
    effect->ambient_is_one = true;
    glssao__maps_make_samplers(effect);
    glssao__stats_make_timers(effect);
    gl->GenVertexArrays(1, &effect->vertex_array);
    gl->GenBuffers(BLOCK_COUNT, effect->uniform_buffers);
    const gl_sizeiptr sizes[BLOCK_COUNT] = {sizeof effect->constants, sizeof effect->frame_constants,
                                            sizeof effect->hemisphere_constants};
    for (int i = 0; i < BLOCK_COUNT; ++i) {
        gl->BindBuffer(GL_UNIFORM_BUFFER, effect->uniform_buffers[i]);
        gl->BufferData(GL_UNIFORM_BUFFER, sizes[i], NULL, GL_STREAM_DRAW);
    }
    return GLSSAO_OK;
}

glssao_result glssao_create(const glssao_config *config, glssao_effect **out_effect)
{
    if (out_effect)
        *out_effect = NULL;
    if (!config)
        return GLSSAO_INVALID_ARGUMENT;
    glssao__log_sink log = {config->log, config->log_user};
    if (!out_effect || !config->load) {
        glssao__log_write(&log, GLSSAO_LOG_ERROR, "%s is NULL", out_effect ? "config.load" : "out_effect");
        return GLSSAO_INVALID_ARGUMENT;
    }
    glssao_effect *effect = calloc(1, sizeof *effect);
    if (!effect) {
        glssao__log_write(&log, GLSSAO_LOG_ERROR, "no memory for the effect");
        return GLSSAO_OUT_OF_MEMORY;
    }
    effect->log = log;
    effect->seed = config->seed;
    effect->has_timers = !config->no_timers;
    effect->path = config->path;
    effect->accumulation.sampling_error = -1.0;
    effect->width = config->width;
    effect->height = config->height;

    const char *missing = NULL;
    if (!glssao__gl_load(&effect->gl, config->load, config->load_user, &missing)) {
        glssao__log_write(&log, GLSSAO_LOG_ERROR, "the context lacks %s", missing);
        free(effect);
        return GLSSAO_UNSUPPORTED_CONTEXT;
    }
    if (!check_size(&log, config->width, config->height, effect->gl.max_size) || !check_path(&log, config->path)) {
        free(effect);
        return GLSSAO_INVALID_ARGUMENT;
    }
    if (glssao__compute_is_out(effect)) /* its state is then none of ours */
        effect->gl.compute = false;
    if (config->path == GLSSAO_PATH_COMPUTE && !effect->gl.compute) {
        glssao__log_write(&log, GLSSAO_LOG_ERROR,
                          "the context lacks compute shaders that write images, which config.path requires");
        free(effect);
        return GLSSAO_UNSUPPORTED_CONTEXT;
    }
    if (config->program_cache) {
        const size_t size = strlen(config->program_cache) + 1;
        effect->cache_folder = malloc(size);
        if (effect->cache_folder) /* without it, programs are compiled */
            memcpy(effect->cache_folder, config->program_cache, size);
    }
    glssao__constants_init(&effect->constants, effect->seed);
    glssao__constants_init_hemisphere(&effect->hemisphere_constants, effect->seed);

    glssao__host_state host;
    glssao__state_save(&effect->gl, &host);
    glssao_result result = make_objects(effect);
    glssao__state_restore(&effect->gl, &host);
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
    const glssao__gl *gl = &effect->gl;
    if (effect->between_normals)
        (void)glssao_end_normals(effect); /* the host's framebuffer comes back; deleting a bound one would bind 0 */
    for (int i = 0; i < effect->program_count; ++i)
        gl->DeleteProgram(effect->programs[i].object.name);
    free(effect->programs);
    free(effect->cache_folder);
    for (int i = 0; i < INPUT_COUNT; ++i)
        glssao__maps_delete_target(gl, &effect->inputs[i]); /* names of 0 are ignored, here and below */
    glssao__maps_delete_target(gl, &effect->normal_map);
    glssao__maps_delete_ambient(gl, &effect->ambient);
    glssao__maps_delete_ambient(gl, &effect->paired);
    glssao__maps_delete_target(gl, &effect->distance_map);
    glssao__maps_delete_target(gl, &effect->result_map);
    glssao__maps_delete_target(gl, &effect->block_map);
    glssao__tiles_destroy(effect);
    glssao__accumulate_destroy(effect);
    gl->DeleteTextures(1, &effect->random_vector_map);
    gl->DeleteSamplers(SAMPLER_COUNT, effect->samplers);
    gl->DeleteVertexArrays(1, &effect->vertex_array);
    gl->DeleteBuffers(BLOCK_COUNT, effect->uniform_buffers);
    for (int i = 0; i < TIMER_FRAMES; ++i)
        gl->DeleteQueries(GLSSAO_PASS_COUNT * 2, effect->timers[i].queries[0]);
    free(effect);
}

glssao_result glssao_resize(glssao_effect *effect, int width, int height)
{
    if (!effect)
        return GLSSAO_INVALID_ARGUMENT;
    if (effect->between_normals) {
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "glssao_resize called before glssao_end_normals");
        return GLSSAO_INVALID_ARGUMENT;
    }
    if (!check_size(&effect->log, width, height, effect->gl.max_size))
        return GLSSAO_INVALID_ARGUMENT;
    if (width == effect->width && height == effect->height)
        return GLSSAO_OK;
    glssao__target normal;
    glssao__ambient_maps ambient;
    glssao__host_state host;
    glssao__state_save(&effect->gl, &host);
    glssao_result result = make_sized(effect, width, height, &normal, &ambient);
    glssao__state_restore(&effect->gl, &host);
    if (result != GLSSAO_OK)
        return result;
    for (int i = 0; i < INPUT_COUNT; ++i)
        glssao__maps_delete_target(&effect->gl, &effect->inputs[i]);
    glssao__maps_delete_target(&effect->gl, &effect->normal_map);
    glssao__maps_delete_ambient(&effect->gl, &effect->ambient);
    glssao__maps_delete_ambient(&effect->gl, &effect->paired); /* made again when next needed, as are these: */
    glssao__maps_delete_target(&effect->gl, &effect->distance_map);
    glssao__maps_delete_target(&effect->gl, &effect->result_map);
    glssao__maps_delete_target(&effect->gl, &effect->block_map);
    glssao__tiles_destroy(effect);
    glssao__accumulate_destroy(effect);
    effect->has_result_map = false;
    effect->margin = 0;
    effect->is_paired = false;
    effect->normal_map = normal;
    effect->ambient = ambient;
    effect->ambient_is_one = true;
    effect->width = width;
    effect->height = height;
    return GLSSAO_OK;
}

uint32_t glssao_map(const glssao_effect *effect, glssao_map_id id, int *out_width, int *out_height)
{
    uint32_t texture = 0;
    int width = 0, height = 0;
    if (effect)
        switch (id) {
        case GLSSAO_MAP_AMBIENT:
            texture = glssao__maps_result(effect, &width, &height);
            break;
        case GLSSAO_MAP_AMBIENT_OTHER:
            texture = effect->is_paired ? effect->paired.texture[1] : effect->ambient.texture[1];
            width = effect->ambient.width;
            height = effect->ambient.height;
            break;
        case GLSSAO_MAP_NORMAL:
            texture = effect->normal_map.texture;
            width = effect->width;
            height = effect->height;
            break;
        case GLSSAO_MAP_RANDOM_VECTOR:
            texture = effect->random_vector_map;
            width = height = RANDOM_VECTOR_MAP_SIZE;
            break;
        case GLSSAO_MAP_TILES:
            texture = effect->tiles.used ? effect->tiles.rings.texture : 0;
            width = texture ? effect->tiles.rings.width : 0;
            height = texture ? effect->tiles.rings.height : 0;
            break;
        case GLSSAO_MAP_DEPTH:
            texture = effect->depth_texture;
            width = texture ? effect->width : 0;
            height = texture ? effect->height : 0;
            break;
        }
    if (out_width)
        *out_width = width;
    if (out_height)
        *out_height = height;
    return texture;
}

const glssao_constants *glssao_get_constants(const glssao_effect *effect)
{
    return effect ? &effect->constants : NULL;
}
