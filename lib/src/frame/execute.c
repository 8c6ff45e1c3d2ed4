/* SPDX-License-Identifier: MIT
 *
 * Draws and dispatches.
 */
#include "frame/execute.h"

#include "frame/choose.h"

glssao__state_need glssao__execute_need(const glssao__resources *resources, const glssao__schedule *schedule)
{
    glssao__state_need need = {.parts = STATE_DRAW | STATE_UNIFORMS,
                               .units = 1u << UNIT_DEPTH,
                               .blocks = BLOCK_HEMISPHERE,
                               .multisample_unit = UNIT_DEPTH};
    for (int i = MAP_FIRST_TARGET; i < MAP_COUNT; ++i)
        if (schedule->maps[i].format != 0 && !glssao__target_fits(&resources->targets[i], &schedule->maps[i])) {
            need.parts |= STATE_TRANSFER;
            need.units |= 1u; /* textures are made on unit 0 */
        }
    for (int i = 0; i < schedule->count; ++i) {
        const glssao__step *step = &schedule->steps[i];
        for (int k = 0; k < step->read_count; ++k)
            need.units |= 1u << step->reads[k].unit;
        if (step->kind == STEP_DISPATCH)
            need.parts |= STATE_IMAGE;
        if (step->second != MAP_NONE)
            need.parts |= STATE_SECOND;
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
    glssao__resources *resources;
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
        return r->resources->targets[map].texture;
    if (map == MAP_RANDOM_VECTOR)
        return r->resources->random_vector_map;
    return r->host->textures[map - MAP_HOST_DEPTH].name;
}

static void bind(run *r, enum glssao__unit unit, gl_enum target, gl_uint texture, enum glssao__sampler sampler)
{
    const glssao__gl *gl = r->resources->gl;
    if (target == GL_TEXTURE_2D && r->bound[unit].texture == texture && r->bound[unit].sampler == sampler)
        return;
    gl->ActiveTexture(GL_TEXTURE0 + (gl_enum)unit);
    gl->BindTexture(target, texture);
    gl->BindSampler((gl_uint)unit, r->resources->samplers[sampler]);
    if (target == GL_TEXTURE_2D) {
        r->bound[unit].texture = texture;
        r->bound[unit].sampler = sampler;
    }
}

static void use(run *r, const glssao__step *step)
{
    const glssao__gl *gl = r->resources->gl;
    const gl_enum target = step->variant.values[MACRO_MULTISAMPLE] ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
    const glssao__program *program = glssao__resources_program(r->resources, step->shader, &step->variant);
    if (program != r->program)
        gl->UseProgram(program->name);
    r->program = program;
    for (int i = 0; i < step->read_count; ++i)
        bind(r, step->reads[i].unit, target, texture_of(r, step->reads[i].map), step->reads[i].sampler);
    /* OpenGL ignores the location -1. */
    gl->Uniform1i(program->locations[UNIFORM_HORIZONTAL], step->is_horizontal);
    gl->Uniform2f(program->locations[UNIFORM_ORIGIN], (gl_float)step->origin[0], (gl_float)step->origin[1]);
    gl->Uniform4f(program->locations[UNIFORM_TILE_RANGE], (gl_float)step->tiles.least, (gl_float)step->tiles.most,
                  (gl_float)step->tiles.side, step->tiles.grows ? 1.0f : 0.0f);
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
    const glssao__gl *gl = r->resources->gl;
    const glssao__target *target = &r->resources->targets[step->target],
                         *tiles = &r->resources->targets[MAP_TILE_RINGS];
    const glssao__region *region = &step->region;
    const bool is_part = region->width != target->width || region->height != target->height;
    if (step->second != MAP_NONE)
        glssao__resources_attach(r->resources, target->texture, r->resources->targets[step->second].texture);
    else
        gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, target->framebuffer);
    if (is_part)
        glssao__state_scissor(gl, (const gl_int[4]){region->x, region->y, region->width, region->height});
    if (step->adds)
        glssao__state_add(gl);
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
    if (step->second != MAP_NONE) /* an attached texture would outlive its deletion */
        glssao__resources_attach(r->resources, 0, 0);
}

static void dispatch(const run *r, const glssao__step *step)
{
    const glssao__gl *gl = r->resources->gl;
    const glssao__target *target = &r->resources->targets[step->target];
    int group[2];
    glssao__shader_group(step->shader, &step->variant, group);
    gl->BindImageTexture(0, target->texture, 0, 0, 0, GL_WRITE_ONLY, target->format);
    if (step->second != MAP_NONE) {
        const glssao__target *second = &r->resources->targets[step->second];
        gl->BindImageTexture(SECOND_IMAGE_UNIT, second->texture, 0, 0, 0, GL_WRITE_ONLY, second->format);
    }
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
    static const gl_float open[4] = {1.0f, 1.0f, 0.0f, 0.0f}; /* nothing is hidden (paired.glsl) */
    const glssao__gl *gl = r->resources->gl;
    wait_for(gl, step->barrier);
    switch (step->kind) {
    case STEP_CLEAR_TO_OPEN:
        glssao__target_clear(gl, &r->resources->targets[step->target],
                             step->target == MAP_BENT ? glssao__bent_of_sky : open);
        break;
    case STEP_CLEAR_TO_ZERO:
        glssao__target_clear_to(gl, &r->resources->targets[step->target], 0.0f);
        break;
    case STEP_DRAW:
        use(r, step);
        draw(r, step);
        break;
    case STEP_DISPATCH:
        use(r, step);
        dispatch(r, step);
        break;
    }
}

static void upload(const glssao__resources *resources, const glssao__uniforms *uniforms, int count)
{
    const void *data[BLOCK_COUNT] = {&uniforms->ssao, &uniforms->frame, &uniforms->hemisphere};
    const size_t sizes[BLOCK_COUNT] = {sizeof uniforms->ssao, sizeof uniforms->frame, sizeof uniforms->hemisphere};
    for (int i = 0; i < count; ++i) {
        resources->gl->BindBufferBase(GL_UNIFORM_BUFFER, (gl_uint)i, resources->uniform_buffers[i]);
        resources->gl->BufferSubData(GL_UNIFORM_BUFFER, 0, (gl_sizeiptr)sizes[i], data[i]);
    }
}

void glssao__execute(glssao__resources *resources, const glssao__schedule *schedule, const glssao__host_inputs *host,
                     const glssao__uniforms *uniforms, float sky_depth)
{
    const glssao__gl *gl = resources->gl;
    run r = {.resources = resources, .host = host};
    upload(resources, uniforms, glssao__execute_need(resources, schedule).blocks);
    gl->SamplerParameterfv(resources->samplers[SAMPLER_DEPTH], GL_TEXTURE_BORDER_COLOR,
                           (const gl_float[4]){sky_depth, sky_depth, sky_depth, sky_depth});
    gl->BindVertexArray(resources->vertex_array);
    for (int i = 0; i < schedule->count; ++i) {
        const glssao__step *step = &schedule->steps[i];
        const bool is_timed = schedule->plan.passes[step->pass].run;
        if (is_timed && (i == 0 || schedule->steps[i - 1].pass != step->pass))
            glssao__timers_begin(&resources->timers, gl, (int)step->pass);
        run_step(&r, step);
        if (is_timed && (i + 1 == schedule->count || schedule->steps[i + 1].pass != step->pass))
            glssao__timers_end(&resources->timers, gl, (int)step->pass);
        glssao__resources_check(resources, glssao__pass_name(step->pass));
    }
    wait_for(gl, schedule->last_barrier);
}
