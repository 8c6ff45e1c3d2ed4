/* SPDX-License-Identifier: MIT */
#include "samples.h"

#include <stdio.h>

static const char vertex_source[] = "#version 330\n"
                                    "void main()\n"
                                    "{\n"
                                    "    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;\n"
                                    "    gl_Position = vec4(corner, 0.0, 1.0);\n"
                                    "}\n";

/* Clamps a sample before adding it. A glint would otherwise outweigh all other samples of its pixel. */
static const char fragment_source[] =
    "#version 330\n"
    "uniform sampler2D u_map;\n"
    "uniform float u_scale;\n"
    "uniform bool u_resolves;\n"
    "layout(location = 0) out vec4 o_color;\n"
    "void main()\n"
    "{\n"
    "    vec4 texel = texelFetch(u_map, ivec2(gl_FragCoord.xy), 0) * u_scale;\n"
    "    if (!u_resolves)\n"
    "        o_color = clamp(texel, 0.0, 1.0);\n"
    "    else\n"
    "        o_color = texel.a > 0.0 ? vec4(texel.rgb / texel.a, texel.a) : vec4(0.0);\n"
    "}\n";

static bool attach_shader(GLuint program, GLenum type, const char *source)
{
    const GLuint shader = gl.CreateShader(type);
    GLint compiled = GL_FALSE;
    gl.ShaderSource(shader, 1, &source, NULL);
    gl.CompileShader(shader);
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    gl.AttachShader(program, shader);
    gl.DeleteShader(shader); /* the program keeps a reference */
    return compiled;
}

static bool make_program(samples *s, failure *why)
{
    GLint linked = GL_FALSE;
    s->program = gl.CreateProgram();
    const bool compiled = attach_shader(s->program, GL_VERTEX_SHADER, vertex_source) &&
                          attach_shader(s->program, GL_FRAGMENT_SHADER, fragment_source);
    gl.LinkProgram(s->program);
    gl.GetProgramiv(s->program, GL_LINK_STATUS, &linked);
    if (!compiled || !linked) {
        char log[1024] = "";
        gl.GetProgramInfoLog(s->program, sizeof log, NULL, log);
        return fault_set(why, "the shaders that average samples: %s", log);
    }
    s->scale = gl.GetUniformLocation(s->program, "u_scale");
    s->resolves = gl.GetUniformLocation(s->program, "u_resolves");
    return true;
}

static bool make_target(GLenum format, int width, int height, GLuint depth, GLuint *out_texture,
                        GLuint *out_framebuffer)
{
    *out_texture = gl_make_texture(format, GL_RGBA, GL_FLOAT, width, height, NULL);
    return gl_make_framebuffer(*out_texture, depth, out_framebuffer);
}

bool samples_open(samples *s, int width, int height, GLuint depth, failure *why)
{
    if (s->sample)
        return true;
    gl.GenVertexArrays(1, &s->vertex_array);
    if (!make_program(s, why))
        return false;
    if (!make_target(GL_RGBA16F, width, height, depth, &s->sample, &s->framebuffer) ||
        !make_target(GL_RGBA32F, width, height, 0, &s->sum, &s->sum_framebuffer))
        return fault_set(why, "--size %dx%d: no framebuffer to average samples in", width, height);
    return true;
}

void samples_close(samples *s)
{
    gl.DeleteFramebuffers(1, &s->framebuffer);
    gl.DeleteFramebuffers(1, &s->sum_framebuffer);
    gl.DeleteTextures(1, &s->sample);
    gl.DeleteTextures(1, &s->sum);
    gl.DeleteVertexArrays(1, &s->vertex_array);
    gl.DeleteProgram(s->program);
    *s = (samples){0};
}

/* Hammersley points with the first bit of the second coordinate flipped. Four of them are the rotated grid. */
scene_view samples_view(const scene_view *view, int index, int count)
{
    if (count == 1)
        return *view;
    float second = 0, digit = 0.5f;
    int room = 1;
    for (int bits = index; room < count; room *= 2, bits /= 2, digit /= 2)
        second += ((bits & 1) != (room == 1)) ? digit : 0;
    const float offset[2] = {((float)index + 0.5f) / (float)count - 0.5f, second + digit - 0.5f};
    scene_view shifted = *view;
    float *m = shifted.clip_from_view;
    for (int column = 0; column < 4; column++) {
        m[4 * column] += 2 * offset[0] / (float)view->width * m[4 * column + 3];
        m[4 * column + 1] += 2 * offset[1] / (float)view->height * m[4 * column + 3];
    }
    return shifted;
}

static void draw(const samples *s, GLuint from, GLuint to, float scale, bool resolves)
{
    gl.BindFramebuffer(GL_FRAMEBUFFER, to);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindSampler(0, 0);
    gl.BindTexture(GL_TEXTURE_2D, from);
    gl.UseProgram(s->program);
    gl.Uniform1f(s->scale, scale);
    gl.Uniform1i(s->resolves, resolves);
    gl.BindVertexArray(s->vertex_array);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.BindVertexArray(0);
    gl.UseProgram(0);
    gl.BindTexture(GL_TEXTURE_2D, 0);
}

void samples_add(samples *s, bool first)
{
    const float zero[4] = {0};
    gl.BindFramebuffer(GL_FRAMEBUFFER, s->sum_framebuffer);
    if (first)
        gl.ClearBufferfv(GL_COLOR, 0, zero);
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_ONE, GL_ONE);
    draw(s, s->sample, s->sum_framebuffer, 1, false);
    gl.Disable(GL_BLEND);
    gl.BlendFunc(GL_ONE, GL_ZERO);
}

void samples_resolve(samples *s, int count, GLuint framebuffer)
{
    gl.Enable(GL_FRAMEBUFFER_SRGB);
    draw(s, s->sum, framebuffer, 1 / (float)count, true);
    gl.Disable(GL_FRAMEBUFFER_SRGB);
}
