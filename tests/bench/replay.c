/* SPDX-License-Identifier: MIT
 *
 * Draws recordings and reads their results.
 */
#include "replay_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

GLuint replay_make_texture(GLenum internal, GLenum format, GLenum type, const int size[2], bool linear, bool repeat,
                           const void *data)
{
    GLuint texture;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.TexImage2D(GL_TEXTURE_2D, 0, (GLint)internal, size[0], size[1], 0, format, type, data);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, linear ? GL_LINEAR : GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, linear ? GL_LINEAR : GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    return texture;
}

bool replay_inputs_create(replay_inputs *in, const gbuffer *g)
{
    const int size[2] = {g->view.width, g->view.height}, one[2] = {1, 1};
    const size_t count = (size_t)size[0] * (size_t)size[1];
    static const float white[4] = {1, 1, 1, 1};
    float *distance, *normals, *unsigned_normals = malloc(3 * count * sizeof *unsigned_normals);
    *in = (replay_inputs){{g->depth}};
    gbuffer_read(g, &distance, &normals);
    const bool made = distance && unsigned_normals;
    for (size_t i = 0; made && i < count; i++) {
        /* 0x7777ff in linear light */
        static const float clear[3] = {0.1845f, 0.1845f, 1};
        for (size_t k = 0; k < 3; k++)
            unsigned_normals[3 * i + k] = distance[i] > 0 ? 0.5f + 0.5f * normals[3 * i + k] : clear[k];
        normals[3 * i + 2] = -normals[3 * i + 2];
    }
    if (made) {
        in->textures[REPLAY_NORMALS] =
            replay_make_texture(GL_RGBA16F, GL_RGB, GL_FLOAT, size, false, false, unsigned_normals);
        in->textures[REPLAY_NORMALS_LEFT_HANDED] =
            replay_make_texture(GL_RGBA16F, GL_RGB, GL_FLOAT, size, true, false, normals);
        in->textures[REPLAY_DISTANCE] = replay_make_texture(GL_R32F, GL_RED, GL_FLOAT, size, true, false, distance);
        in->textures[REPLAY_WHITE] = replay_make_texture(GL_RGBA8, GL_RGBA, GL_FLOAT, one, false, false, white);
        gl.BindTexture(GL_TEXTURE_2D, g->depth);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    free(unsigned_normals);
    free(distance);
    free(normals);
    return made;
}

void replay_inputs_destroy(replay_inputs *in)
{
    gl.DeleteTextures(REPLAY_INPUTS - 1, &in->textures[1]);
    *in = (replay_inputs){{0}};
}

replayer *replayer_create(context *c)
{
    static const float triangle[] = {-1, -1, 0, 0, 0, 3, -1, 0, 2, 0, -1, 3, 0, 0, 2}; /* position, uv */
    replayer *r = calloc(1, sizeof *r);
    if (!r)
        return NULL;
    r->get_active_uniform.pointer = context_load("glGetActiveUniform", c);
    r->uniform1fv.pointer = context_load("glUniform1fv", c);
    r->uniform_matrix2fv.pointer = context_load("glUniformMatrix2fv", c);
    gl.GenVertexArrays(1, &r->vertex_array);
    gl.BindVertexArray(r->vertex_array);
    gl.GenBuffers(1, &r->buffer);
    gl.BindBuffer(GL_ARRAY_BUFFER, r->buffer);
    gl.BufferData(GL_ARRAY_BUFFER, sizeof triangle, triangle, GL_STATIC_DRAW);
    gl.EnableVertexAttribArray(0);
    gl.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 5 * sizeof(float), NULL);
    gl.EnableVertexAttribArray(1);
    gl.VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, 5 * sizeof(float), (const void *)(uintptr_t)(3 * sizeof(float)));
    gl.BindVertexArray(0);
    return r;
}

void replayer_destroy(replayer *r)
{
    if (!r)
        return;
    for (int i = 0; i < r->program_count && i < MAX_PROGRAMS; i++)
        gl.DeleteProgram(r->programs[i].program);
    gl.DeleteVertexArrays(1, &r->vertex_array);
    gl.DeleteBuffers(1, &r->buffer);
    free(r);
}

void replay_destroy(replay *p)
{
    if (!p)
        return;
    gl.DeleteTextures(p->texture_count, p->textures);
    for (int i = 0; i < p->pass_count; i++) {
        gl.DeleteFramebuffers(1, &p->passes[i].framebuffer);
        for (int k = 0; k < p->passes[i].uniform_count; k++)
            free(p->passes[i].uniforms[k].values);
    }
    free(p);
}

static void set_uniform(const replayer *r, const uniform *u)
{
    const float *v = u->values;
    switch (u->type) {
    case GL_FLOAT:
        r->uniform1fv.uniform1fv(u->location, u->count, v);
        break;
    case GL_FLOAT_VEC2:
        gl.Uniform2fv(u->location, u->count, v);
        break;
    case GL_FLOAT_VEC3:
        gl.Uniform3fv(u->location, u->count, v);
        break;
    case GL_FLOAT_VEC4:
        gl.Uniform4fv(u->location, u->count, v);
        break;
    case GL_FLOAT_MAT2:
        r->uniform_matrix2fv.uniform_matrix2fv(u->location, u->count, GL_FALSE, v);
        break;
    case GL_FLOAT_MAT3:
        gl.UniformMatrix3fv(u->location, u->count, GL_FALSE, v);
        break;
    case GL_FLOAT_MAT4:
        gl.UniformMatrix4fv(u->location, u->count, GL_FALSE, v);
        break;
    default:
        gl.Uniform1i(u->location, (GLint)v[0]);
    }
}

void replay_draw(replayer *r, const replay *p, const replay_inputs *in)
{
    gl.BindVertexArray(r->vertex_array);
    gl.Disable(GL_DEPTH_TEST);
    gl.Disable(GL_BLEND);
    gl.Disable(GL_CULL_FACE);
    for (int i = 0; i < p->pass_count; i++) {
        const pass *a = &p->passes[i];
        gl.BindFramebuffer(GL_FRAMEBUFFER, a->framebuffer);
        gl.Viewport(a->viewport[0], a->viewport[1], a->viewport[2], a->viewport[3]);
        if (a->cleared) {
            gl.ClearColor(a->clear[0], a->clear[1], a->clear[2], a->clear[3]);
            gl.Clear(GL_COLOR_BUFFER_BIT);
        }
        gl.UseProgram(a->program);
        for (int k = 0; k < a->sampler_count; k++) {
            const int texture = a->samplers[k].texture;
            gl.ActiveTexture(GL_TEXTURE0 + (GLenum)k);
            gl.BindSampler((GLuint)k, 0);
            gl.BindTexture(GL_TEXTURE_2D, texture < 0 ? in->textures[-1 - texture] : p->textures[texture]);
            gl.Uniform1i(a->samplers[k].location, k);
        }
        for (int k = 0; k < a->uniform_count; k++)
            set_uniform(r, &a->uniforms[k]);
        gl.DrawArrays(GL_TRIANGLES, 0, 3);
    }
    gl.ActiveTexture(GL_TEXTURE0);
    gl.UseProgram(0);
    gl.BindVertexArray(0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

double replay_gpu_ms(replayer *r, const replay *p, const replay_inputs *in)
{
    enum { AHEAD = 3 }; /* keep the GPU from waiting for the processor */
    GLuint queries[2];
    GLuint64 at[2] = {0, 0};
    gl.GenQueries(2, queries);
    for (int i = 0; i < AHEAD; i++)
        replay_draw(r, p, in);
    gl.QueryCounter(queries[0], GL_TIMESTAMP);
    replay_draw(r, p, in);
    gl.QueryCounter(queries[1], GL_TIMESTAMP);
    for (int i = 0; i < 2; i++)
        gl.GetQueryObjectui64v(queries[i], GL_QUERY_RESULT, &at[i]);
    gl.DeleteQueries(2, queries);
    return at[1] > at[0] ? (double)(at[1] - at[0]) * 1e-6 : NAN;
}

bool replay_read(const replay *p, int width, int height, float *out, failure *fault)
{
    const int *size = p->sizes[p->output];
    if (size[0] != width || size[1] != height)
        return fault_set(fault, "a peer's result has %dx%d pixels, not %dx%d", size[0], size[1], width, height);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.BindTexture(GL_TEXTURE_2D, p->textures[p->output]);
    gl.GetTexImage(GL_TEXTURE_2D, 0, GL_RED, GL_FLOAT, out);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    for (size_t i = 0; i < (size_t)width * (size_t)height;
         i++) /* as the picture that it is multiplied into clamps it */
        out[i] = out[i] < 0 ? 0 : out[i] > 1 ? 1 : out[i];
    return true;
}
