/* SPDX-License-Identifier: MIT
 *
 * glssao-bandwidth: the least that a pass can take on this driver: buffers copied, and maps of the effect's formats
 * copied texel by texel, by a draw and by a dispatch. Times are of the GPU, by timestamps around many copies.
 *   glssao-bandwidth [egl|osmesa [TURNS]]
 */
#include "context.h"
#include "gl.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Side of a work group. The launch rate bounds smaller groups; larger ones are not faster. */
#define GROUP 16
#define LAYOUT(side) "layout(local_size_x = " #side ", local_size_y = " #side ") in;\n"
#define LAYOUT_OF(side) LAYOUT(side)
enum { MOST_TURNS = 1000, WIDTH = 1920, HEIGHT = 1080 };

static int turns = 7; /* of which the fastest counts */

static const char vertex_source[] = "#version 330\n"
                                    "void main()\n"
                                    "{\n"
                                    "    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);\n"
                                    "    gl_Position = vec4(4.0 * corner - 1.0, 0.0, 1.0);\n"
                                    "}\n";
static const char fragment_source[] = "#version 330\n"
                                      "uniform sampler2D u_from;\n"
                                      "out vec4 o_texel;\n"
                                      "void main()\n"
                                      "{\n"
                                      "    o_texel = texelFetch(u_from, ivec2(gl_FragCoord.xy), 0);\n"
                                      "}\n";
static const char compute_source[] =
    "#version 430\n" LAYOUT_OF(GROUP) "uniform sampler2D u_from;\n"
                                      "writeonly uniform image2D u_to;\n"
                                      "void main()\n"
                                      "{\n"
                                      "    ivec2 at = ivec2(gl_GlobalInvocationID.xy);\n"
                                      "    if (all(lessThan(at, textureSize(u_from, 0))))\n"
                                      "        imageStore(u_to, at, texelFetch(u_from, at, 0));\n"
                                      "}\n";

/* Newer than OpenGL 3.3; NULL where the context lacks them. */
static PFNGLDISPATCHCOMPUTEPROC dispatch_compute;
static PFNGLBINDIMAGETEXTUREPROC bind_image_texture;
static PFNGLMEMORYBARRIERPROC memory_barrier;
static PFNGLCOPYBUFFERSUBDATAPROC copy_buffer;

typedef union function {
    void *pointer;
    PFNGLDISPATCHCOMPUTEPROC dispatch;
    PFNGLBINDIMAGETEXTUREPROC bind_image;
    PFNGLMEMORYBARRIERPROC barrier;
    PFNGLCOPYBUFFERSUBDATAPROC copy;
} function;

static const struct format {
    const char *name;
    GLenum format;
    int bytes, divisor; /* of the full size */
} formats[] = {
    {"R16, full size", GL_R16, 2, 1},         {"R32F, half size", GL_R32F, 4, 2},
    {"RG32F, half size", GL_RG32F, 8, 2},     {"RGBA16, half size", GL_RGBA16, 8, 2},
    {"RGBA16F, full size", GL_RGBA16F, 8, 1}, {"R32F, 64x36", GL_R32F, 4, 30},
};

typedef struct job {
    void (*once)(const struct job *, int i);
    GLuint maps[2], framebuffers[2]; /* copied to and fro, so that no copy can be optimised away */
    GLenum format;
    int width, height;
    GLsizeiptr size;
} job;

static void copy_buffers(const job *j, int i)
{
    (void)i;
    copy_buffer(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, 0, j->size);
}

static void draw(const job *j, int i)
{
    gl.BindTexture(GL_TEXTURE_2D, j->maps[i % 2]);
    gl.BindFramebuffer(GL_FRAMEBUFFER, j->framebuffers[1 - i % 2]);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

static void dispatch(const job *j, int i)
{
    gl.BindTexture(GL_TEXTURE_2D, j->maps[i % 2]);
    bind_image_texture(0, j->maps[1 - i % 2], 0, GL_FALSE, 0, GL_WRITE_ONLY, j->format);
    dispatch_compute((GLuint)(j->width + GROUP - 1) / GROUP, (GLuint)(j->height + GROUP - 1) / GROUP, 1);
    memory_barrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

/* The least time of one copy, from runs of `count`. */
static double least_ms(const job *j, int count)
{
    double least = 1e9;
    GLuint queries[2];
    gl.GenQueries(2, queries);
    for (int turn = 0; turn < turns; turn++) {
        GLuint64 at[2];
        gl.Finish();
        gl.QueryCounter(queries[0], GL_TIMESTAMP);
        for (int i = 0; i < count; i++)
            j->once(j, i);
        gl.QueryCounter(queries[1], GL_TIMESTAMP);
        gl.Finish();
        for (int i = 0; i < 2; i++)
            gl.GetQueryObjectui64v(queries[i], GL_QUERY_RESULT, &at[i]);
        const double ms = (double)(at[1] - at[0]) * 1e-6 / count;
        least = ms < least ? ms : least;
    }
    gl.DeleteQueries(2, queries);
    return least;
}

static void print(const char *what, const char *how, double bytes, double ms)
{
    printf("| %-18s | %-8s | %9.4f | %7.0f |\n", what, how, ms, bytes / ms * 1e-6);
}

static GLuint make_program(bool compute)
{
    const struct {
        GLenum kind;
        const char *source;
    } stages[] = {
        {GL_COMPUTE_SHADER, compute_source}, {GL_VERTEX_SHADER, vertex_source}, {GL_FRAGMENT_SHADER, fragment_source}};
    const GLuint program = gl.CreateProgram();
    for (int i = compute ? 0 : 1; i < (compute ? 1 : 3); i++) {
        const GLuint shader = gl.CreateShader(stages[i].kind);
        gl.ShaderSource(shader, 1, &stages[i].source, NULL);
        gl.CompileShader(shader);
        gl.AttachShader(program, shader);
        gl.DeleteShader(shader);
    }
    gl.LinkProgram(program);
    GLint linked = 0;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked)
        return program;
    gl.DeleteProgram(program);
    return 0;
}

static void measure_buffers(void)
{
    for (int mebibytes = 4; mebibytes <= 256; mebibytes *= 4) {
        job j = {.once = copy_buffers, .size = (GLsizeiptr)mebibytes << 20};
        GLuint buffers[2];
        gl.GenBuffers(2, buffers);
        gl.BindBuffer(GL_COPY_READ_BUFFER, buffers[0]);
        gl.BindBuffer(GL_COPY_WRITE_BUFFER, buffers[1]);
        gl.BufferData(GL_COPY_READ_BUFFER, j.size, NULL, GL_STATIC_COPY);
        gl.BufferData(GL_COPY_WRITE_BUFFER, j.size, NULL, GL_STATIC_COPY);
        char what[32];
        snprintf(what, sizeof what, "buffer, %d MiB", mebibytes);
        print(what, "copy", 2.0 * (double)j.size, least_ms(&j, 20));
        gl.DeleteBuffers(2, buffers);
    }
}

static void measure_maps(GLuint drawn, GLuint dispatched)
{
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        const struct format *f = &formats[i];
        job j = {.format = f->format, .width = WIDTH / f->divisor, .height = HEIGHT / f->divisor};
        for (int k = 0; k < 2; k++) {
            j.maps[k] = gl_make_texture(j.format, GL_RED, GL_FLOAT, j.width, j.height, NULL);
            (void)gl_make_framebuffer(j.maps[k], 0, &j.framebuffers[k]);
            gl.ClearColor(0.5f, 0.5f, 0.5f, 0.5f);
            gl.Clear(GL_COLOR_BUFFER_BIT);
        }
        gl.Viewport(0, 0, j.width, j.height);
        const double bytes = 2.0 * f->bytes * j.width * j.height;
        gl.UseProgram(drawn);
        j.once = draw;
        print(f->name, "draw", bytes, least_ms(&j, 20));
        if (dispatched) {
            gl.UseProgram(dispatched);
            j.once = dispatch;
            print(f->name, "dispatch", bytes, least_ms(&j, 20));
        }
        gl.DeleteFramebuffers(2, j.framebuffers);
        gl.DeleteTextures(2, j.maps);
    }
}

static void load_newer(context *c)
{
    dispatch_compute = (function){.pointer = context_load("glDispatchCompute", c)}.dispatch;
    bind_image_texture = (function){.pointer = context_load("glBindImageTexture", c)}.bind_image;
    memory_barrier = (function){.pointer = context_load("glMemoryBarrier", c)}.barrier;
    copy_buffer = (function){.pointer = context_load("glCopyBufferSubData", c)}.copy;
}

int main(int argc, char **argv)
{
    char error[512] = "";
    const bool osmesa = argc > 1 && strcmp(argv[1], "osmesa") == 0;
    turns = argc > 2 ? (int)strtol(argv[2], NULL, 10) : turns;
    if (argc > 3 || (argc > 1 && !osmesa && strcmp(argv[1], "egl") != 0) || turns < 1 || turns > MOST_TURNS) {
        fputs("usage: glssao-bandwidth [egl|osmesa [TURNS]]\n", stderr);
        return 2;
    }
    context *c = context_create(&(context_options){.kind = osmesa ? CONTEXT_OSMESA : CONTEXT_EGL}, error, sizeof error);
    if (!c || !gl_load(context_load, c, error, sizeof error)) {
        fprintf(stderr, "glssao-bandwidth: %s\n", error);
        context_destroy(c);
        return 1;
    }
    load_newer(c);
    printf("%s\n\n| what | how | ms | GB/s, read and written |\n|---|---|---|---|\n",
           (const char *)gl.GetString(GL_RENDERER));
    GLuint vertex_array;
    gl.GenVertexArrays(1, &vertex_array);
    gl.BindVertexArray(vertex_array);
    measure_buffers();
    const GLuint drawn = make_program(false);
    const GLuint dispatched = dispatch_compute && bind_image_texture && memory_barrier ? make_program(true) : 0;
    measure_maps(drawn, dispatched);
    gl.DeleteProgram(drawn);
    gl.DeleteProgram(dispatched);
    gl.DeleteVertexArrays(1, &vertex_array);
    context_destroy(c);
    return 0;
}
