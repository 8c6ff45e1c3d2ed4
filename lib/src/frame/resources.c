/* SPDX-License-Identifier: MIT
 *
 * Programs, maps and other GL objects that steps run with.
 */
#include "frame/resources.h"

#include "random.h"
#include "shaders_text.h"

#include <stdlib.h>
#include <string.h>

#define ROUND_TO_VEC4(size) (((size) + 15) / 16 * 16)

static const glssao__block blocks[BLOCK_COUNT] = {
    {"cbSsao", sizeof(glssao_constants), shader_cb_ssao_glsl},
    {"cbFrame", ROUND_TO_VEC4(sizeof(glssao__frame_block)), shader_cb_frame_glsl},
    {"cbHemisphere", sizeof(glssao__hemisphere_block), shader_cb_hemisphere_glsl}};

static const struct glssao__sampler_name sampler_names[] = {
    {"u_normal_map", UNIT_NORMAL},   {"u_depth_map", UNIT_DEPTH},       {"u_random_vector_map", UNIT_RANDOM_VECTOR},
    {"u_ambient_map", UNIT_AMBIENT}, {"u_distance_map", UNIT_DISTANCE}, {"u_back_map", UNIT_BACK},
    {"u_second_map", UNIT_SECOND},   {"u_input_map", UNIT_DEPTH},       {"u_tile_map", UNIT_TILES},
    {"u_raw_map", UNIT_RAW},         {"u_history_map", UNIT_HISTORY},   {"u_motion_map", UNIT_MOTION},
    {"u_bent_map", UNIT_BACK},       {"u_other_map", UNIT_BACK},        {"u_bent_target", SECOND_IMAGE_UNIT},
    {"u_rays_map", UNIT_RAYS},       {"u_strength_map", UNIT_DEPTH},    {"u_albedo_map", UNIT_NORMAL}, /* apply.c */
    {"u_near_map", UNIT_BACK},
};

static const glssao__program_ties ties = {
    .blocks = blocks,
    .block_count = BLOCK_COUNT,
    .samplers = sampler_names,
    .sampler_count = sizeof sampler_names / sizeof *sampler_names,
    .uniforms = {"gHorizontalBlur", "gOrigin", "gTileRange", "gRegion", "gShade", "gPicture"},
};

void glssao__resources_check(const glssao__resources *r, const char *where)
{
#if GLSSAO_CHECK_GL
    for (gl_enum error = r->gl->GetError(); error != 0; error = r->gl->GetError())
        glssao__log_write(r->log, GLSSAO_LOG_ERROR, "OpenGL error 0x%04X after %s", error, where);
#else
    (void)r;
    (void)where;
#endif
}

/* ---- programs ---- */

static glssao__program_key key_of(enum glssao__shader shader, const glssao__variant *variant)
{
    _Static_assert(sizeof(glssao__variant) + 1 <= sizeof(glssao__program_key), "a key has no room for a variant");
    glssao__program_key key = {{(uint8_t)shader}};
    memcpy(key.bytes + 1, variant, sizeof *variant);
    return key;
}

static glssao_result prepare_program(glssao__resources *r, enum glssao__shader shader, const glssao__variant *variant)
{
    const glssao__program_key key = key_of(shader, variant);
    if (glssao__programs_find(&r->programs, &key))
        return GLSSAO_OK;
    const bool compute = variant->values[MACRO_COMPUTE];
    char name[128];
    glssao__shader_describe(shader, variant, name, sizeof name);
    char *own = glssao__shader_source(shader, variant, r->gl->version, r->gl->is_software);
    char *vertex = compute ? NULL : glssao__shader_vertex_source(r->gl->is_software);
    const glssao__program_source source = {
        .name = name, .vertex = vertex, .fragment = compute ? NULL : own, .compute = compute ? own : NULL};
    glssao_result result = GLSSAO_OUT_OF_MEMORY;
    if (own && (vertex || compute))
        result = glssao__programs_make(&r->programs, r->gl, r->log, &ties, &key, &source);
    else
        glssao__log_write(r->log, GLSSAO_LOG_ERROR, "no memory for the source of %s", name);
    free(own);
    free(vertex);
    return result;
}

const glssao__program *glssao__resources_program(const glssao__resources *r, enum glssao__shader shader,
                                                 const glssao__variant *variant)
{
    const glssao__program_key key = key_of(shader, variant);
    return glssao__programs_find(&r->programs, &key);
}

glssao_result glssao__resources_prepare_apply(glssao__resources *r, const glssao__variant *variant)
{
    return prepare_program(r, SHADER_APPLY, variant);
}

/* ---- maps ---- */

const gl_float glssao__bent_of_sky[4] = {0.0f, 0.0f, 1.0f, 1.0f};

/* What a map holds before anything is drawn into it. */
static void clear_new(const glssao__resources *r, enum glssao__map map, glssao__target *target)
{
    if (map == MAP_NORMAL)
        glssao__target_clear(r->gl, target, (const gl_float[4]){0.0f, 0.0f, 1.0f, 0.0f});
    else if (map == MAP_BENT)
        glssao__target_clear(r->gl, target, glssao__bent_of_sky);
    else if (map == MAP_AMBIENT_0 || map == MAP_AMBIENT_1 || map == MAP_RESULT)
        glssao__target_clear_to(r->gl, target, 1.0f);
}

static gl_uint newest(const glssao__resources *r, const glssao__target made[MAP_COUNT], enum glssao__map map)
{
    return made[map].texture ? made[map].texture : r->targets[map].texture;
}

void glssao__resources_attach(const glssao__resources *r, gl_uint first, gl_uint second)
{
    const gl_uint textures[2] = {first, second};
    r->gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, r->pair_framebuffer);
    for (int i = 0; i < 2; ++i)
        r->gl->FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + (gl_enum)i, GL_TEXTURE_2D, textures[i],
                                    0);
}

/* Makes the framebuffer of steps with two targets. Drivers may refuse formats of different sizes side by side. */
static glssao_result make_pair(glssao__resources *r, gl_uint first, gl_uint second)
{
    static const gl_enum buffers[2] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT0 + 1};
    r->gl->GenFramebuffers(1, &r->pair_framebuffer);
    glssao__resources_attach(r, first, second);
    r->gl->DrawBuffers(2, buffers);
    const gl_enum status = r->gl->CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
    glssao__resources_attach(r, 0, 0);
    if (status == GL_FRAMEBUFFER_COMPLETE)
        return GLSSAO_OK;
    glssao__log_write(r->log, GLSSAO_LOG_ERROR,
                      "the driver rejects a framebuffer of accessibility and bent normals: 0x%04X", status);
    r->gl->DeleteFramebuffers(1, &r->pair_framebuffer);
    r->pair_framebuffer = 0;
    return GLSSAO_FRAMEBUFFER_ERROR;
}

/* Makes the maps that differ from what is asked for, and the framebuffer of `pair`, a step with two targets or NULL;
 * all or nothing. */
static glssao_result fit_maps(glssao__resources *r, const glssao__target_spec specs[MAP_COUNT],
                              const glssao__step *pair)
{
    glssao__target made[MAP_COUNT] = {{0}};
    glssao_result result = GLSSAO_OK;
    for (int i = MAP_FIRST_TARGET; i < MAP_COUNT && result == GLSSAO_OK; ++i) {
        if (specs[i].format == 0 || glssao__target_fits(&r->targets[i], &specs[i]))
            continue;
        result = glssao__target_make(r->gl, r->log, &specs[i], &made[i]);
        if (result == GLSSAO_OK)
            clear_new(r, (enum glssao__map)i, &made[i]);
    }
    if (result == GLSSAO_OK && pair && !r->pair_framebuffer)
        result = make_pair(r, newest(r, made, pair->target), newest(r, made, pair->second));
    if (result != GLSSAO_OK) {
        for (int i = MAP_FIRST_TARGET; i < MAP_COUNT; ++i)
            glssao__target_delete(r->gl, &made[i]);
        return result;
    }
    for (int i = MAP_FIRST_TARGET; i < MAP_COUNT; ++i)
        if (made[i].texture) {
            r->retired[i] = r->targets[i];
            r->targets[i] = made[i];
        }
    return GLSSAO_OK;
}

void glssao__resources_collect(glssao__resources *r)
{
    for (int i = MAP_FIRST_TARGET; i < MAP_COUNT; ++i)
        glssao__target_delete(r->gl, &r->retired[i]);
}

glssao_result glssao__resources_resize(glssao__resources *r, const int size[2])
{
    const int half[2] = {(size[0] + 1) / 2, (size[1] + 1) / 2};
    const glssao__target_spec specs[MAP_COUNT] = {
        [MAP_NORMAL] = {"normal", GL_RGBA16F, size[0], size[1]},
        [MAP_AMBIENT_0] = {"ambient", GL_R16, half[0], half[1]},
        [MAP_AMBIENT_1] = {"ambient", GL_R16, half[0], half[1]},
    };
    const glssao_result result = fit_maps(r, specs, NULL);
    for (int i = MAP_FIRST_TARGET; i < MAP_COUNT && result == GLSSAO_OK; ++i)
        if (specs[i].format == 0) { /* made again when next needed */
            r->retired[i] = r->targets[i];
            r->targets[i] = (glssao__target){0};
        }
    return result;
}

glssao_result glssao__resources_prepare(glssao__resources *r, const glssao__schedule *schedule)
{
    const glssao__step *pair = NULL;
    for (int i = 0; i < schedule->count; ++i) {
        const glssao__step *step = &schedule->steps[i];
        if (step->kind != STEP_DRAW && step->kind != STEP_DISPATCH)
            continue;
        const glssao_result result = prepare_program(r, step->shader, &step->variant);
        if (result != GLSSAO_OK)
            return result;
        if (step->kind == STEP_DRAW && step->second != MAP_NONE)
            pair = step;
    }
    return fit_maps(r, schedule->maps, pair);
}

/* ---- all of them ---- */

static glssao_result make_random_vectors(glssao__resources *r, uint32_t seed)
{
    uint8_t *texels = malloc((size_t)RANDOM_VECTOR_MAP_SIZE * RANDOM_VECTOR_MAP_SIZE * 4);
    if (texels) {
        glssao__random_vector_texels(seed, texels);
        r->random_vector_map =
            glssao__texture_make_rgba8(r->gl, RANDOM_VECTOR_MAP_SIZE, RANDOM_VECTOR_MAP_SIZE, texels);
        free(texels);
    }
    if (r->random_vector_map)
        return GLSSAO_OK;
    glssao__log_write(r->log, GLSSAO_LOG_ERROR, "no memory for the random vector map");
    return GLSSAO_OUT_OF_MEMORY;
}

glssao_result glssao__resources_init(glssao__resources *r, const int size[2], uint32_t seed, bool has_timers)
{
    /* Compiling a program checks the driver's layout of the blocks; this one takes the least time. */
    glssao_result result = glssao__resources_prepare_apply(r, &(glssao__variant){{0}});
    if (result == GLSSAO_OK)
        result = make_random_vectors(r, seed);
    if (result == GLSSAO_OK)
        result = glssao__resources_resize(r, size);
    if (result != GLSSAO_OK)
        return result;
    glssao__samplers_make(r->gl, r->samplers);
    if (has_timers)
        glssao__timers_make(&r->timers, r->gl);
    r->gl->GenVertexArrays(1, &r->vertex_array);
    r->gl->GenBuffers(BLOCK_COUNT, r->uniform_buffers);
    for (int i = 0; i < BLOCK_COUNT; ++i) {
        r->gl->BindBuffer(GL_UNIFORM_BUFFER, r->uniform_buffers[i]);
        r->gl->BufferData(GL_UNIFORM_BUFFER, (gl_sizeiptr)blocks[i].size, NULL, GL_STREAM_DRAW);
    }
    return GLSSAO_OK;
}

void glssao__resources_destroy(glssao__resources *r)
{
    glssao__resources_collect(r);
    for (int i = MAP_FIRST_TARGET; i < MAP_COUNT; ++i)
        glssao__target_delete(r->gl, &r->targets[i]);
    r->gl->DeleteTextures(1, &r->random_vector_map); /* OpenGL ignores the name 0, here and below */
    r->gl->DeleteSamplers(SAMPLER_COUNT, r->samplers);
    r->gl->DeleteVertexArrays(1, &r->vertex_array);
    r->gl->DeleteBuffers(BLOCK_COUNT, r->uniform_buffers);
    r->gl->DeleteFramebuffers(1, &r->pair_framebuffer);
    glssao__timers_destroy(&r->timers, r->gl);
    glssao__programs_destroy(&r->programs, r->gl);
}
