/* SPDX-License-Identifier: MIT
 *
 * Draws and dispatches.
 */
#include "frame/execute.h"

#include "frame/choose.h"
#include "random.h"
#include "shaders_text.h"

#include <stdlib.h>
#include <string.h>

/* The plain uniforms of all programs. */
enum { UNIFORM_HORIZONTAL, UNIFORM_ORIGIN, UNIFORM_TILE_RANGE, UNIFORM_REGION };

#define ROUND_TO_VEC4(size) (((size) + 15) / 16 * 16)

static const glssao__block blocks[BLOCK_COUNT] = {
    {"cbSsao", sizeof(glssao_constants), shader_cb_ssao_glsl},
    {"cbFrame", ROUND_TO_VEC4(sizeof(glssao__frame_block)), shader_cb_frame_glsl},
    {"cbHemisphere", sizeof(glssao__hemisphere_block), shader_cb_hemisphere_glsl}};

static const struct glssao__sampler_name sampler_names[] = {
    {"u_normal_map", UNIT_NORMAL},   {"u_depth_map", UNIT_DEPTH},       {"u_random_vector_map", UNIT_RANDOM_VECTOR},
    {"u_ambient_map", UNIT_AMBIENT}, {"u_distance_map", UNIT_DISTANCE}, {"u_back_map", UNIT_BACK},
    {"u_second_map", UNIT_SECOND},   {"u_input_map", UNIT_DEPTH},       {"u_tile_map", UNIT_TILES},
};

static const glssao__program_ties ties = {
    .blocks = blocks,
    .block_count = BLOCK_COUNT,
    .samplers = sampler_names,
    .sampler_count = sizeof sampler_names / sizeof *sampler_names,
    .uniforms = {"gHorizontalBlur", "gOrigin", "gTileRange", "gRegion"},
};

void glssao__executor_check(const glssao__executor *e, const char *where)
{
#if GLSSAO_CHECK_GL
    for (gl_enum error = e->gl->GetError(); error != 0; error = e->gl->GetError())
        glssao__log_write(e->log, GLSSAO_LOG_ERROR, "OpenGL error 0x%04X after %s", error, where);
#else
    (void)e;
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

static glssao_result prepare_program(glssao__executor *e, enum glssao__shader shader, const glssao__variant *variant)
{
    const glssao__program_key key = key_of(shader, variant);
    if (glssao__programs_find(&e->programs, &key))
        return GLSSAO_OK;
    const bool compute = variant->values[MACRO_COMPUTE];
    char name[128];
    glssao__shader_describe(shader, variant, name, sizeof name);
    char *own = glssao__shader_source(shader, variant, &e->dialect);
    char *vertex = compute ? NULL : glssao__shader_vertex_source(&e->dialect);
    const glssao__program_source source = {
        .name = name, .vertex = vertex, .fragment = compute ? NULL : own, .compute = compute ? own : NULL};
    glssao_result result = GLSSAO_OUT_OF_MEMORY;
    if (own && (vertex || compute))
        result = glssao__programs_make(&e->programs, e->gl, e->log, &ties, &key, &source);
    else
        glssao__log_write(e->log, GLSSAO_LOG_ERROR, "no memory for the source of %s", name);
    free(own);
    free(vertex);
    return result;
}

static const glssao__program *program_of(const glssao__executor *e, enum glssao__shader shader,
                                         const glssao__variant *variant)
{
    const glssao__program_key key = key_of(shader, variant);
    return glssao__programs_find(&e->programs, &key);
}

/* ---- maps ---- */

/* What a map holds before anything is drawn into it. */
static void clear_new(const glssao__executor *e, enum glssao__map map, glssao__target *target)
{
    if (map == MAP_NORMAL)
        glssao__target_clear(e->gl, target, (const gl_float[4]){0.0f, 0.0f, 1.0f, 0.0f});
    else if (map == MAP_AMBIENT_0 || map == MAP_AMBIENT_1 || map == MAP_RESULT)
        glssao__target_clear_to_one(e->gl, target);
}

/* Makes the maps that differ from what is asked for, all or none. */
static glssao_result fit_maps(glssao__executor *e, const glssao__target_spec specs[MAP_COUNT])
{
    glssao__target made[MAP_COUNT] = {{0}};
    for (int i = MAP_FIRST_TARGET; i < MAP_COUNT; ++i) {
        if (specs[i].format == 0 || glssao__target_fits(&e->targets[i], &specs[i]))
            continue;
        const glssao_result result = glssao__target_make(e->gl, e->log, &specs[i], &made[i]);
        if (result != GLSSAO_OK) {
            for (int k = MAP_FIRST_TARGET; k < i; ++k)
                glssao__target_delete(e->gl, &made[k]);
            return result;
        }
        clear_new(e, (enum glssao__map)i, &made[i]);
    }
    for (int i = MAP_FIRST_TARGET; i < MAP_COUNT; ++i)
        if (made[i].texture) {
            e->retired[i] = e->targets[i];
            e->targets[i] = made[i];
        }
    return GLSSAO_OK;
}

void glssao__executor_collect(glssao__executor *e)
{
    for (int i = MAP_FIRST_TARGET; i < MAP_COUNT; ++i)
        glssao__target_delete(e->gl, &e->retired[i]);
}

glssao_result glssao__executor_resize(glssao__executor *e, const int size[2])
{
    const int half[2] = {(size[0] + 1) / 2, (size[1] + 1) / 2};
    const glssao__target_spec specs[MAP_COUNT] = {
        [MAP_NORMAL] = {"normal", GL_RGBA16F, size[0], size[1]},
        [MAP_AMBIENT_0] = {"ambient", GL_R16, half[0], half[1]},
        [MAP_AMBIENT_1] = {"ambient", GL_R16, half[0], half[1]},
    };
    const glssao_result result = fit_maps(e, specs);
    for (int i = MAP_FIRST_TARGET; i < MAP_COUNT && result == GLSSAO_OK; ++i)
        if (specs[i].format == 0) { /* made again when next needed */
            e->retired[i] = e->targets[i];
            e->targets[i] = (glssao__target){0};
        }
    return result;
}

glssao_result glssao__executor_prepare(glssao__executor *e, const glssao__schedule *schedule)
{
    for (int i = 0; i < schedule->count; ++i) {
        const glssao__step *step = &schedule->steps[i];
        if (step->kind != STEP_DRAW && step->kind != STEP_DISPATCH)
            continue;
        const glssao_result result = prepare_program(e, step->shader, &step->variant);
        if (result != GLSSAO_OK)
            return result;
    }
    return fit_maps(e, schedule->maps);
}

/* ---- the life of an executor ---- */

static glssao_result make_random_vectors(glssao__executor *e, uint32_t seed)
{
    uint8_t *texels = malloc((size_t)RANDOM_VECTOR_MAP_SIZE * RANDOM_VECTOR_MAP_SIZE * 4);
    if (texels) {
        glssao__random_vector_texels(seed, texels);
        e->random_vector_map =
            glssao__texture_make_rgba8(e->gl, RANDOM_VECTOR_MAP_SIZE, RANDOM_VECTOR_MAP_SIZE, texels);
        free(texels);
    }
    if (e->random_vector_map)
        return GLSSAO_OK;
    glssao__log_write(e->log, GLSSAO_LOG_ERROR, "no memory for the random vector map");
    return GLSSAO_OUT_OF_MEMORY;
}

glssao_result glssao__executor_init(glssao__executor *e, const int size[2], uint32_t seed, bool has_timers)
{
    /* Compiling a program checks the driver's layout of the blocks; this one takes the least time. */
    glssao_result result = glssao__executor_prepare_apply(e);
    if (result == GLSSAO_OK)
        result = make_random_vectors(e, seed);
    if (result == GLSSAO_OK)
        result = glssao__executor_resize(e, size);
    if (result != GLSSAO_OK)
        return result;
    glssao__samplers_make(e->gl, e->samplers);
    if (has_timers)
        glssao__timers_make(&e->timers, e->gl);
    e->gl->GenVertexArrays(1, &e->vertex_array);
    e->gl->GenBuffers(BLOCK_COUNT, e->uniform_buffers);
    for (int i = 0; i < BLOCK_COUNT; ++i) {
        e->gl->BindBuffer(GL_UNIFORM_BUFFER, e->uniform_buffers[i]);
        e->gl->BufferData(GL_UNIFORM_BUFFER, (gl_sizeiptr)blocks[i].size, NULL, GL_STREAM_DRAW);
    }
    return GLSSAO_OK;
}

void glssao__executor_destroy(glssao__executor *e)
{
    glssao__executor_collect(e);
    for (int i = MAP_FIRST_TARGET; i < MAP_COUNT; ++i)
        glssao__target_delete(e->gl, &e->targets[i]);
    e->gl->DeleteTextures(1, &e->random_vector_map); /* OpenGL ignores the name 0, here and below */
    e->gl->DeleteSamplers(SAMPLER_COUNT, e->samplers);
    e->gl->DeleteVertexArrays(1, &e->vertex_array);
    e->gl->DeleteBuffers(BLOCK_COUNT, e->uniform_buffers);
    glssao__timers_destroy(&e->timers, e->gl);
    glssao__programs_destroy(&e->programs, e->gl);
}

/* ---- running ---- */

glssao__state_need glssao__executor_need(const glssao__executor *e, const glssao__schedule *schedule)
{
    glssao__state_need need = {.parts = STATE_DRAW | STATE_UNIFORMS,
                               .units = 1u << UNIT_DEPTH,
                               .blocks = BLOCK_HEMISPHERE,
                               .multisample_unit = UNIT_DEPTH};
    for (int i = MAP_FIRST_TARGET; i < MAP_COUNT; ++i)
        if (schedule->maps[i].format != 0 && !glssao__target_fits(&e->targets[i], &schedule->maps[i])) {
            need.parts |= STATE_TRANSFER;
            need.units |= 1u; /* textures are made on unit 0 */
        }
    for (int i = 0; i < schedule->count; ++i) {
        const glssao__step *step = &schedule->steps[i];
        for (int k = 0; k < step->read_count; ++k)
            need.units |= 1u << step->reads[k].unit;
        if (step->kind == STEP_DISPATCH)
            need.parts |= STATE_IMAGE;
        if (step->adds)
            need.parts |= STATE_BLEND;
        if (step->target == MAP_PROBE)
            need.parts |= STATE_TRANSFER | STATE_READ;
        if (step->variant.values[MACRO_MULTISAMPLE])
            need.parts |= STATE_MULTISAMPLE;
        if (step->shader == SHADER_HEMISPHERE)
            need.blocks = BLOCK_COUNT;
    }
    return need;
}

/* A run of a schedule, with what is bound so far. */
typedef struct run {
    glssao__executor *e;
    const glssao__host_inputs *host;
    const glssao__program *program;
    struct {
        gl_uint texture;
        enum glssao__sampler sampler;
    } bound[UNIT_COUNT];
} run;

static gl_uint texture_of(const run *r, enum glssao__map map)
{
    if (map >= MAP_FIRST_TARGET)
        return r->e->targets[map].texture;
    if (map == MAP_RANDOM_VECTOR)
        return r->e->random_vector_map;
    return r->host->textures[map - MAP_HOST_DEPTH].name;
}

static void bind(run *r, enum glssao__unit unit, gl_enum target, gl_uint texture, enum glssao__sampler sampler)
{
    const glssao__gl *gl = r->e->gl;
    if (target == GL_TEXTURE_2D && r->bound[unit].texture == texture && r->bound[unit].sampler == sampler)
        return;
    gl->ActiveTexture(GL_TEXTURE0 + (gl_enum)unit);
    gl->BindTexture(target, texture);
    gl->BindSampler((gl_uint)unit, r->e->samplers[sampler]);
    if (target == GL_TEXTURE_2D) {
        r->bound[unit].texture = texture;
        r->bound[unit].sampler = sampler;
    }
}

static void use(run *r, const glssao__step *step)
{
    const glssao__gl *gl = r->e->gl;
    const gl_enum target =
        step->variant.values[MACRO_MULTISAMPLE] ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
    const glssao__program *program = program_of(r->e, step->shader, &step->variant);
    if (program != r->program)
        gl->UseProgram(program->name);
    r->program = program;
    for (int i = 0; i < step->read_count; ++i)
        bind(r, step->reads[i].unit, target, texture_of(r, step->reads[i].map), step->reads[i].sampler);
    /* OpenGL ignores the location -1. Rings are stored over 16 (tile_rings.frag). */
    gl->Uniform1i(program->locations[UNIFORM_HORIZONTAL], step->is_horizontal);
    gl->Uniform2f(program->locations[UNIFORM_ORIGIN], (gl_float)step->origin[0], (gl_float)step->origin[1]);
    gl->Uniform3f(program->locations[UNIFORM_TILE_RANGE], (gl_float)step->tiles.least / 16.0f,
                  (gl_float)step->tiles.most / 16.0f, (gl_float)step->tiles.side);
    gl->Uniform4i(program->locations[UNIFORM_REGION], step->region.x, step->region.y, step->region.width,
                  step->region.height);
}

static void set_viewport(const glssao__gl *gl, int x, int y, int width, int height)
{
    glssao__state_viewport(gl, (const gl_float[4]){(gl_float)x, (gl_float)y, (gl_float)width, (gl_float)height});
}

/* Two triangles over the target, or a point for each tile, over all tiles together. */
static void draw(const run *r, const glssao__step *step)
{
    const glssao__gl *gl = r->e->gl;
    const glssao__target *target = &r->e->targets[step->target], *tiles = &r->e->targets[MAP_TILE_RINGS];
    const glssao__region *region = &step->region;
    const bool is_part = region->width != target->width || region->height != target->height;
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, target->framebuffer);
    if (is_part)
        glssao__state_scissor(gl, (const gl_int[4]){region->x, region->y, region->width, region->height});
    if (step->adds)
        glssao__state_blend(gl, GL_ONE, GL_ONE);
    if (step->tiles.side > 0) {
        gl->Enable(GL_PROGRAM_POINT_SIZE);
        set_viewport(gl, -step->origin[0], -step->origin[1], tiles->width * step->tiles.side,
                     tiles->height * step->tiles.side);
        gl->DrawArrays(GL_POINTS, 0, tiles->width * tiles->height);
        gl->Disable(GL_PROGRAM_POINT_SIZE);
    } else {
        set_viewport(gl, 0, 0, target->width, target->height);
        gl->DrawArrays(GL_TRIANGLES, 0, 6);
    }
    if (step->adds)
        gl->Disablei(GL_BLEND, 0);
    if (is_part)
        glssao__state_scissor(gl, NULL);
}

static void dispatch(const run *r, const glssao__step *step)
{
    const glssao__gl *gl = r->e->gl;
    const glssao__target *target = &r->e->targets[step->target];
    int group[2];
    glssao__shader_group(step->shader, &step->variant, group);
    gl->BindImageTexture(0, target->texture, 0, 0, 0, GL_WRITE_ONLY, target->format);
    gl->DispatchCompute((gl_uint)((step->region.width + group[0] - 1) / group[0]),
                        (gl_uint)((step->region.height + group[1] - 1) / group[1]), 1);
}

static void wait_for(const glssao__gl *gl, enum glssao__barrier barrier)
{
    const gl_bitfield images = GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT;
    if (barrier == BARRIER_DISPATCH)
        gl->MemoryBarrier(images);
    else if (barrier == BARRIER_ALL)
        gl->MemoryBarrier(images | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

static void run_step(run *r, const glssao__step *step)
{
    glssao__target *target = &r->e->targets[step->target];
    wait_for(r->e->gl, step->barrier);
    switch (step->kind) {
    case STEP_CLEAR_TO_ONE:
        glssao__target_clear_to_one(r->e->gl, target);
        return;
    case STEP_CLEAR_TO_ZERO:
        glssao__target_clear(r->e->gl, target, (const gl_float[4]){0.0f, 0.0f, 0.0f, 0.0f});
        return;
    case STEP_DRAW:
        use(r, step);
        draw(r, step);
        break;
    case STEP_DISPATCH:
        use(r, step);
        dispatch(r, step);
        break;
    }
    target->is_one = false;
}

static void upload(const glssao__executor *e, const glssao__uniforms *uniforms, int count)
{
    const void *data[BLOCK_COUNT] = {&uniforms->ssao, &uniforms->frame, &uniforms->hemisphere};
    const size_t sizes[BLOCK_COUNT] = {sizeof uniforms->ssao, sizeof uniforms->frame, sizeof uniforms->hemisphere};
    for (int i = 0; i < count; ++i) {
        e->gl->BindBufferBase(GL_UNIFORM_BUFFER, (gl_uint)i, e->uniform_buffers[i]);
        e->gl->BufferSubData(GL_UNIFORM_BUFFER, 0, (gl_sizeiptr)sizes[i], data[i]);
    }
}

void glssao__executor_run(glssao__executor *e, const glssao__schedule *schedule, const glssao__host_inputs *host,
                          const glssao__uniforms *uniforms, float sky_depth)
{
    const glssao__gl *gl = e->gl;
    run r = {.e = e, .host = host};
    upload(e, uniforms, glssao__executor_need(e, schedule).blocks);
    gl->SamplerParameterfv(e->samplers[SAMPLER_DEPTH], GL_TEXTURE_BORDER_COLOR,
                           (const gl_float[4]){sky_depth, sky_depth, sky_depth, sky_depth});
    gl->BindVertexArray(e->vertex_array);
    for (int i = 0; i < schedule->count; ++i) {
        const glssao__step *step = &schedule->steps[i];
        const bool is_timed = schedule->plan.passes[step->pass].run;
        if (is_timed && (i == 0 || schedule->steps[i - 1].pass != step->pass))
            glssao__timers_begin(&e->timers, gl, (int)step->pass);
        run_step(&r, step);
        if (is_timed && (i + 1 == schedule->count || schedule->steps[i + 1].pass != step->pass))
            glssao__timers_end(&e->timers, gl, (int)step->pass);
        glssao__executor_check(e, glssao__pass_name(step->pass));
    }
    wait_for(gl, schedule->last_barrier);
}

/* ---- apply ---- */

glssao_result glssao__executor_prepare_apply(glssao__executor *e)
{
    return prepare_program(e, SHADER_APPLY, &(glssao__variant){{0}});
}

void glssao__executor_apply(glssao__executor *e, gl_uint framebuffer, enum glssao__map map, int width, int height)
{
    const glssao__gl *gl = e->gl;
    run r = {.e = e};
    glssao__timers_begin(&e->timers, gl, GLSSAO_PASS_APPLY);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    gl->UseProgram(program_of(e, SHADER_APPLY, &(glssao__variant){{0}})->name);
    bind(&r, UNIT_AMBIENT, GL_TEXTURE_2D, e->targets[map].texture, SAMPLER_LINEAR_CLAMP);
    gl->BindVertexArray(e->vertex_array);
    glssao__state_blend(gl, GL_ZERO, GL_SRC_COLOR);
    set_viewport(gl, 0, 0, width, height);
    gl->DrawArrays(GL_TRIANGLES, 0, 6);
    glssao__timers_end(&e->timers, gl, GLSSAO_PASS_APPLY);
}
