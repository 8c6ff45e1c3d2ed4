/* SPDX-License-Identifier: MIT
 *
 * The textures that the effect owns, their framebuffers, and the samplers through which all textures are read.
 * Everything here runs between glssao__state_save and _restore, so bindings are left as they fall.
 */
#include "effect.h"

#include <stdlib.h>

static bool has_size(const glssao__gl *gl, int width, int height)
{
    gl_int w = 0, h = 0;
    gl->GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &w);
    gl->GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &h);
    return w == width && h == height;
}

/* 0 where the driver has no memory for it: the level then stays undefined, which shows without glGetError. */
static gl_uint make_texture(const glssao__gl *gl, gl_enum format, int width, int height, const void *rgba8)
{
    gl_uint texture = 0;
    gl->GenTextures(1, &texture);
    gl->ActiveTexture(GL_TEXTURE0 + UNIT_AMBIENT);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl_enum channels = format == GL_RG32F ? GL_RG : format == GL_R16 || format == GL_R32F ? GL_RED : GL_RGBA;
    gl->TexImage2D(GL_TEXTURE_2D, 0, (gl_int)format, width, height, 0, channels, rgba8 ? GL_UNSIGNED_BYTE : GL_FLOAT,
                   rgba8);
    /* Hosts may read the maps with a sampler of their own or with none: complete either way. */
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, rgba8 ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, rgba8 ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    if (has_size(gl, width, height))
        return texture;
    gl->DeleteTextures(1, &texture);
    return 0;
}

static glssao_result make_target(glssao_effect *effect, gl_enum format, int width, int height, const char *what,
                                 glssao__target *out_target)
{
    const glssao__gl *gl = &effect->gl;
    *out_target = (glssao__target){
        .texture = make_texture(gl, format, width, height, NULL), .width = width, .height = height, .format = format};
    if (!out_target->texture) {
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "no memory for the %s map of %d x %d", what, width, height);
        return GLSSAO_OUT_OF_MEMORY;
    }
    gl->GenFramebuffers(1, &out_target->framebuffer);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, out_target->framebuffer);
    gl->FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, out_target->texture, 0);
    gl_enum status = gl->CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE)
        return GLSSAO_OK;
    glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "the framebuffer of the %s map of %d x %d is refused: 0x%04X",
                      what, width, height, status);
    glssao__maps_delete_target(gl, out_target);
    return GLSSAO_FRAMEBUFFER_ERROR;
}

void glssao__maps_delete_target(const glssao__gl *gl, glssao__target *target)
{
    gl->DeleteFramebuffers(1, &target->framebuffer); /* names of 0 are ignored */
    gl->DeleteTextures(1, &target->texture);
    *target = (glssao__target){0};
}

glssao_result glssao__maps_make_normal(glssao_effect *effect, int width, int height, glssao__target *out_map)
{
    glssao_result result = make_target(effect, GL_RGBA16F, width, height, "normal", out_map);
    if (result == GLSSAO_OK)
        effect->gl.ClearBufferfv(GL_COLOR, 0, (const gl_float[4]){0.0f, 0.0f, 1.0f, 0.0f});
    return result;
}

static glssao_result fit_target(glssao_effect *effect, gl_enum format, int width, int height, const char *what,
                                glssao__target *target)
{
    if (target->width == width && target->height == height && target->format == format)
        return GLSSAO_OK;
    glssao__target made;
    glssao_result result = make_target(effect, format, width, height, what, &made);
    if (result != GLSSAO_OK)
        return result;
    glssao__maps_delete_target(&effect->gl, target);
    *target = made;
    return GLSSAO_OK;
}

glssao_result glssao__maps_fit_input(glssao_effect *effect, bool has_normals, glssao__target *map)
{
    return fit_target(effect, has_normals ? GL_RGBA32F : GL_R32F, effect->width, effect->height, "input", map);
}

glssao_result glssao__maps_fit_distance(glssao_effect *effect, int width, int height, bool has_layers)
{
    return fit_target(effect, has_layers ? GL_RGBA32F : GL_R32F, width, height, "distance", &effect->distance_map);
}

glssao_result glssao__maps_fit_block(glssao_effect *effect, int width, int height)
{
    return fit_target(effect, GL_RGBA16, width, height, "block", &effect->block_map);
}

glssao_result glssao__maps_fit_accumulation(glssao_effect *effect)
{
    glssao__accumulation *a = &effect->accumulation;
    glssao_result result = fit_target(effect, GL_RG32F, effect->width, effect->height, "accumulation", &a->sum);
    return result == GLSSAO_OK ? fit_target(effect, GL_RG32F, PROBE_SIZE, PROBE_SIZE, "probe", &a->probe) : result;
}

gl_uint glssao__maps_result(const glssao_effect *effect, int *out_width, int *out_height)
{
    bool apart = effect->has_result_map;
    *out_width = apart ? effect->result_map.width : effect->ambient.width;
    *out_height = apart ? effect->result_map.height : effect->ambient.height;
    return apart ? effect->result_map.texture : effect->ambient.texture[0];
}

static void clear_to_one(const glssao__gl *gl, const glssao__ambient_maps *maps)
{
    for (int i = 0; i < 2; ++i) {
        gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, maps->framebuffer[i]);
        gl->ClearBufferfv(GL_COLOR, 0, (const gl_float[4]){1.0f, 1.0f, 1.0f, 1.0f});
    }
}

static glssao_result make_pair(glssao_effect *effect, gl_enum format, int width, int height, const char *what,
                               glssao__ambient_maps *out_maps)
{
    *out_maps = (glssao__ambient_maps){.width = width, .height = height, .format = format};
    for (int i = 0; i < 2; ++i) {
        glssao__target target;
        glssao_result result = make_target(effect, format, width, height, what, &target);
        out_maps->texture[i] = target.texture;
        out_maps->framebuffer[i] = target.framebuffer;
        if (result != GLSSAO_OK) {
            glssao__maps_delete_ambient(&effect->gl, out_maps);
            return result;
        }
    }
    return GLSSAO_OK;
}

glssao_result glssao__maps_make_ambient(glssao_effect *effect, int width, int height, glssao__ambient_maps *out_maps)
{
    glssao_result result = make_pair(effect, GL_R16, width, height, "ambient", out_maps);
    if (result == GLSSAO_OK)
        clear_to_one(&effect->gl, out_maps);
    return result;
}

glssao_result glssao__maps_fit_results(glssao_effect *effect, int width, int height, bool paired, int result_width,
                                       int result_height)
{
    const bool makes_result =
        result_width > 0 && (effect->result_map.width != result_width || effect->result_map.height != result_height);
    const bool makes_paired = paired && (effect->paired.width != width || effect->paired.height != height);
    const bool makes_ambient = effect->ambient.width != width || effect->ambient.height != height;
    glssao__target result_map = {0};
    glssao__ambient_maps paired_maps = {0}, ambient_maps = {0};
    glssao_result result = GLSSAO_OK;
    if (makes_result)
        result = make_target(effect, GL_R16, result_width, result_height, "result", &result_map);
    if (result == GLSSAO_OK && makes_paired)
        result = make_pair(effect, GL_RG32F, width, height, "paired ambient", &paired_maps);
    if (result == GLSSAO_OK && makes_ambient)
        result = glssao__maps_make_ambient(effect, width, height, &ambient_maps);
    /* The old ones hold the last result: none goes before all of the new ones are there. */
    if (result != GLSSAO_OK) {
        glssao__maps_delete_target(&effect->gl, &result_map);
        glssao__maps_delete_ambient(&effect->gl, &paired_maps);
        return result;
    }
    if (makes_result) {
        glssao__maps_delete_target(&effect->gl, &effect->result_map);
        effect->result_map = result_map;
    }
    if (makes_paired) {
        glssao__maps_delete_ambient(&effect->gl, &effect->paired);
        effect->paired = paired_maps;
    }
    if (makes_ambient) {
        glssao__maps_delete_ambient(&effect->gl, &effect->ambient);
        effect->ambient = ambient_maps;
        effect->ambient_is_one = true;
        effect->has_result_map = false; /* until the last pass has run */
        effect->is_paired = false;
    }
    return GLSSAO_OK;
}

void glssao__maps_delete_ambient(const glssao__gl *gl, glssao__ambient_maps *maps)
{
    gl->DeleteFramebuffers(2, maps->framebuffer);
    gl->DeleteTextures(2, maps->texture);
    *maps = (glssao__ambient_maps){0};
}

glssao_result glssao__maps_fit_tiles(glssao_effect *effect, int width, int height, bool from_depth)
{
    glssao__tiles *t = &effect->tiles;
    int columns, rows;
    glssao__tiles_size(width, height, &columns, &rows);
    glssao_result result =
        fit_target(effect, GL_RGBA32F, columns, from_depth ? effect->height : height, "tile row", &t->rows);
    if (result == GLSSAO_OK)
        result = fit_target(effect, GL_RGBA32F, columns, rows, "tile bound", &t->bounds);
    if (result == GLSSAO_OK)
        result = fit_target(effect, GL_R32F, columns, rows, "tile class", &t->needed);
    return result == GLSSAO_OK ? fit_target(effect, GL_R32F, columns, rows, "tile ring", &t->rings) : result;
}

static void clear_target(const glssao__gl *gl, const glssao__target *target)
{
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, target->framebuffer);
    gl->ClearBufferfv(GL_COLOR, 0, (const gl_float[4]){1.0f, 1.0f, 1.0f, 1.0f});
}

void glssao__maps_clear_all(glssao_effect *effect)
{
    if (effect->is_paired)
        clear_to_one(&effect->gl, &effect->paired);
    if (effect->has_result_map)
        clear_target(&effect->gl, &effect->result_map);
    if (!effect->is_paired || !effect->has_result_map)
        clear_to_one(&effect->gl, &effect->ambient);
}

void glssao__maps_clear_result(glssao_effect *effect)
{
    if (!effect->ambient_is_one)
        clear_to_one(&effect->gl, &effect->ambient);
    effect->ambient_is_one = true;
    if (effect->has_result_map)
        clear_target(&effect->gl, &effect->result_map);
}

glssao_result glssao__maps_make_random_vector(glssao_effect *effect)
{
    uint8_t *texels = malloc((size_t)RANDOM_VECTOR_MAP_SIZE * RANDOM_VECTOR_MAP_SIZE * 4);
    if (texels) {
        glssao__random_vector_texels(effect->seed, texels);
        effect->random_vector_map =
            make_texture(&effect->gl, GL_RGBA8, RANDOM_VECTOR_MAP_SIZE, RANDOM_VECTOR_MAP_SIZE, texels);
        free(texels);
    }
    if (effect->random_vector_map)
        return GLSSAO_OK;
    glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "no memory for the random vector map");
    return GLSSAO_OUT_OF_MEMORY;
}

void glssao__maps_make_samplers(glssao_effect *effect)
{
    static const struct {
        gl_int filter, wrap;
    } kinds[SAMPLER_COUNT] = {
        [SAMPLER_POINT_CLAMP] = {GL_NEAREST, GL_CLAMP_TO_EDGE},
        [SAMPLER_LINEAR_CLAMP] = {GL_LINEAR, GL_CLAMP_TO_EDGE},
        [SAMPLER_DEPTH] = {GL_LINEAR, GL_CLAMP_TO_BORDER}, /* border: the sky's depth, set each frame */
        [SAMPLER_LINEAR_WRAP] = {GL_LINEAR, GL_REPEAT},
    };
    const glssao__gl *gl = &effect->gl;
    gl->GenSamplers(SAMPLER_COUNT, effect->samplers);
    for (int i = 0; i < SAMPLER_COUNT; ++i) {
        gl->SamplerParameteri(effect->samplers[i], GL_TEXTURE_MIN_FILTER, kinds[i].filter);
        gl->SamplerParameteri(effect->samplers[i], GL_TEXTURE_MAG_FILTER, kinds[i].filter);
        gl->SamplerParameteri(effect->samplers[i], GL_TEXTURE_WRAP_S, kinds[i].wrap);
        gl->SamplerParameteri(effect->samplers[i], GL_TEXTURE_WRAP_T, kinds[i].wrap);
    }
}

glssao_result glssao__maps_check_texture(glssao_effect *effect, gl_uint texture, bool needs_depth, const char *field)
{
    const glssao__gl *gl = &effect->gl;
    if (!gl->IsTexture(texture)) {
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "%s = %u: no texture of this context", field, texture);
        return GLSSAO_INVALID_ARGUMENT;
    }
    gl->ActiveTexture(GL_TEXTURE0 + UNIT_AMBIENT);
    gl->BindTexture(GL_TEXTURE_2D, 0);
    gl->BindTexture(GL_TEXTURE_2D, texture); /* of another kind, it does not bind, and 0 has no size */
    if (!has_size(gl, effect->width, effect->height)) {
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "%s = %u: not a GL_TEXTURE_2D of the full size, %d x %d",
                          field, texture, effect->width, effect->height);
        return GLSSAO_INVALID_ARGUMENT;
    }
    gl_int depth_bits = 0;
    gl->GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_DEPTH_SIZE, &depth_bits);
    if (needs_depth && depth_bits == 0) {
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "%s = %u: not a depth format", field, texture);
        return GLSSAO_INVALID_ARGUMENT;
    }
    return GLSSAO_OK;
}
