/* SPDX-License-Identifier: MIT
 *
 * What every pass does: binds a texture, covers a framebuffer, looks for errors.
 */
#include "effect.h"

void glssao__draw_check(const glssao_effect *effect, const char *where)
{
#if GLSSAO_CHECK_GL
    for (gl_enum error = effect->gl.GetError(); error != 0; error = effect->gl.GetError())
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "OpenGL error 0x%04X after %s", error, where);
#else
    (void)effect;
    (void)where;
#endif
}

void glssao__draw_bind(const glssao_effect *effect, enum glssao__unit unit, gl_uint texture,
                       enum glssao__sampler sampler)
{
    effect->gl.ActiveTexture(GL_TEXTURE0 + (gl_uint)unit);
    effect->gl.BindTexture(GL_TEXTURE_2D, texture);
    effect->gl.BindSampler((gl_uint)unit, effect->samplers[sampler]);
}

void glssao__draw_use(glssao_effect *effect, const glssao__program_object *program)
{
    effect->program = *program;
    effect->tiles.point = 0;
    effect->gl.UseProgram(program->name);
    effect->gl.Uniform2f(program->origin_location, 0.0f, 0.0f); /* a location of -1 is ignored */
    effect->gl.Uniform3f(program->tile_range_location, 0.0f, 0.0f, 0.0f);
}

/* Draws over a picture of that size whose lower left corner lies there. */
static void draw_over(glssao_effect *effect, int x, int y, int width, int height)
{
    const glssao__gl *gl = &effect->gl;
    const glssao__target *tiles = &effect->tiles.rings;
    const int point = effect->tiles.point;
    glssao__compute_finish(effect);
    gl->BindVertexArray(effect->vertex_array);
    if (point > 0) {
        width = tiles->width * point;
        height = tiles->height * point;
    }
    glssao__state_set_viewport(gl, (const gl_float[4]){(gl_float)x, (gl_float)y, (gl_float)width, (gl_float)height});
    if (point > 0)
        gl->DrawArrays(GL_POINTS, 0, tiles->width * tiles->height);
    else
        gl->DrawArrays(GL_TRIANGLES, 0, 6);
}

void glssao__draw(glssao_effect *effect, gl_uint framebuffer, int width, int height)
{
    effect->gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    draw_over(effect, 0, 0, width, height);
}

void glssao__draw_region(glssao_effect *effect, const glssao__target *target, const glssao__region *region)
{
    if (effect->program.compute) {
        glssao__compute_dispatch(effect, target, region);
        return;
    }
    const bool whole = region->width == target->width && region->height == target->height;
    if (!whole)
        glssao__state_set_scissor(&effect->gl, (const gl_int[4]){region->x, region->y, region->width, region->height});
    glssao__draw(effect, target->framebuffer, target->width, target->height);
    if (!whole)
        glssao__state_set_scissor(&effect->gl, NULL);
}

void glssao__draw_crop(glssao_effect *effect, const glssao__target *target, int width, int height,
                       const glssao__region *region)
{
    const glssao__gl *gl = &effect->gl;
    gl->Uniform2f(effect->program.origin_location, (gl_float)region->x, (gl_float)region->y);
    if (effect->program.compute) {
        glssao__compute_dispatch(effect, target, &(glssao__region){0, 0, region->width, region->height});
        return;
    }
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, target->framebuffer);
    /* The maps' picture, moved so that the region comes to lie on the target: uv runs over the maps as ever. */
    draw_over(effect, -region->x, -region->y, width, height);
}

bool glssao__draw_is_between_normals(const glssao_effect *effect, const char *function)
{
    if (effect->between_normals)
        glssao__log_write(&effect->log, GLSSAO_LOG_ERROR, "%s called before glssao_end_normals", function);
    return effect->between_normals;
}
