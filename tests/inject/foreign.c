/* SPDX-License-Identifier: MIT
 *
 * foreign MODE...: the dropin programs' boxes drawn straight into the window as other programs do it, for inject.sh.
 *   ubo       the matrix in a uniform buffer, written by glBufferSubData; "mapped": by glMapBufferRange
 *   ortho     an orthographic view
 *   reversed  glClipControl to 0..1, near plane at 1, infinitely far at 0
 *   range     glDepthRange(1, 0)
 *   weapon    depth is cleared after the scene, and more is drawn with another projection
 *   icon      a small picture in a corner, which sets more matrices than the scene
 *   small     a small picture in a framebuffer of its own, blitted into a corner at the end
 *   pick      the scene is drawn twice, first to read a pixel back
 *   post      the scene in a framebuffer of its own, drawn into the window as a texture
 *   shared    as post, with the scene drawn in another context that shares the texture
 *   resolve   the scene in a multisampled framebuffer, blitted to another, and that one into the window
 *   zoom      from the 4th frame with another field of view
 *   several   from the 4th frame in a framebuffer with two pictures, which is not followed
 *   empty     the scene is drawn without depth
 *   demand    nothing but the background in the first two frames; 0.4 seconds pass after each frame
 *   contexts  40 windows are opened and closed before
 *   german    a locale with a decimal comma
 *   own       with the effect by glssao_compute, which is told the true matrix: what inject's should look like
 * Options as dropin's.
 */
#define _POSIX_C_SOURCE 200809L
#include "support.h"

#include <cglm/cglm.h>
#include <glssao/glssao.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define ZERO_TO_ONE 0x935F
#define LOWER_LEFT 0x8CA1

static void *find_function(const char *name, void *user)
{
    (void)user;
    GLFWglproc function = glfwGetProcAddress(name);
    void *address;
    memcpy(&address, &function, sizeof address);
    return address;
}

static bool has(int argc, char **argv, const char *mode)
{
    for (int i = 1; i < argc; ++i)
        if (strcmp(argv[i], mode) == 0)
            return true;
    return false;
}

static const char *const vertex_texts[2] = {"#version 330\n"
                                            "uniform mat4 clip_from_world;\n",
                                            "#version 330\n"
                                            "layout(std140) uniform camera { vec4 tint; mat4 clip_from_world; };\n"};
static const char *const rest_of_vertex_text =
    "const vec3 boxes[12] = vec3[](vec3(0.0, -0.1, 0.0), vec3(4.0, 0.1, 4.0), vec3(0.8, 0.8, 0.8),\n"
    "                              vec3(-0.8, 0.6, 0.0), vec3(0.6, 0.6, 0.6), vec3(0.9, 0.6, 0.4),\n"
    "                              vec3(0.5, 0.4, 0.3), vec3(0.4, 0.4, 0.4), vec3(0.5, 0.7, 0.9),\n"
    "                              vec3(0.3, 0.9, -1.2), vec3(0.9, 0.9, 0.3), vec3(0.7, 0.8, 0.6));\n"
    "out vec3 normal, color;\n"
    "void main() {\n"
    "    int box = gl_InstanceID / 6 * 3, axis = gl_InstanceID / 2 % 3;\n"
    "    vec3 p = vec3(gl_VertexID % 2, gl_VertexID / 2, gl_InstanceID % 2) * 2.0 - 1.0;\n"
    "    normal = vec3(0.0, 0.0, p.z);\n"
    "    for (int i = 0; i < axis; ++i) { p = p.zxy; normal = normal.zxy; }\n"
    "    color = boxes[box + 2];\n"
    "    gl_Position = clip_from_world * vec4(boxes[box] + boxes[box + 1] * p, 1.0);\n"
    "}\n";
static const char *const fragment_text =
    "#version 330\n"
    "in vec3 normal, color; out vec4 o_color;\n"
    "void main() { o_color = vec4(color * (0.6 + 0.4 * max(dot(normal, vec3(0.36, 0.8, 0.48)), 0.0)), 1.0); }\n";

static GLuint link_program(const char *const *vertex, int vertex_texts_count, const char *fragment)
{
    GLuint program = glCreateProgram();
    for (int i = 0; i < 2; ++i) {
        GLuint shader = glCreateShader(i == 0 ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
        glShaderSource(shader, i == 0 ? vertex_texts_count : 1, i == 0 ? vertex : &fragment, NULL);
        glCompileShader(shader);
        glAttachShader(program, shader);
    }
    glLinkProgram(program);
    return program;
}

static GLuint make_program(bool buffer)
{
    const char *const vertex[2] = {vertex_texts[buffer], rest_of_vertex_text};
    const GLuint program = link_program(vertex, 2, fragment_text);
    glUseProgram(program);
    return program;
}

static GLuint make_show_program(void)
{
    static const char *const vertex = "#version 330\nvoid main() { gl_Position = vec4(vec2(gl_VertexID % 2, "
                                      "gl_VertexID / 2) * 4.0 - 1.0, 0.0, 1.0); }\n";
    return link_program(&vertex, 1,
                        "#version 330\nuniform sampler2D picture; out vec4 o_color;\n"
                        "void main() { o_color = texelFetch(picture, ivec2(gl_FragCoord.xy), 0); }\n");
}

/* ---- framebuffers of its own ---- */

enum { WIDTH = 640, HEIGHT = 480 };

typedef struct buffers {
    GLuint scene, resolved; /* framebuffers; 0: the window, or none */
    GLuint texture;         /* the scene's colours, where they are to be drawn */
} buffers;

static GLuint make_framebuffer(int samples, GLuint *out_texture)
{
    GLuint framebuffer, renderbuffers[2];
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glGenRenderbuffers(2, renderbuffers);
    glBindRenderbuffer(GL_RENDERBUFFER, renderbuffers[0]);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH24_STENCIL8, WIDTH, HEIGHT);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, renderbuffers[0]);
    if (out_texture) {
        glGenTextures(1, out_texture);
        glBindTexture(GL_TEXTURE_2D, *out_texture);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, WIDTH, HEIGHT, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, *out_texture, 0);
    } else {
        glBindRenderbuffer(GL_RENDERBUFFER, renderbuffers[1]);
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA8, WIDTH, HEIGHT);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, renderbuffers[1]);
    }
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        exit(3);
    return framebuffer;
}

enum { SMALL = 96 };

/* The boxes in the lower left corner of a framebuffer of its own, which is then left. */
static void draw_small(GLuint framebuffer, GLuint program, mat4 clip_from_world)
{
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glUniformMatrix4fv(glGetUniformLocation(program, "clip_from_world"), 1, GL_FALSE, clip_from_world[0]);
    glViewport(0, 0, SMALL, SMALL);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, 24);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, WIDTH, HEIGHT);
}

static void blit_small(GLuint framebuffer)
{
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glBlitFramebuffer(0, 0, SMALL, SMALL, 0, 0, SMALL, SMALL, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

/* Brings the scene's picture into the window. */
static void show(const buffers *b, GLuint show_program)
{
    if (b->resolved) {
        glBindFramebuffer(GL_READ_FRAMEBUFFER, b->scene);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, b->resolved);
        glBlitFramebuffer(0, 0, WIDTH, HEIGHT, 0, 0, WIDTH, HEIGHT, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, b->resolved);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
        glBlitFramebuffer(0, 0, WIDTH, HEIGHT, 0, 0, WIDTH, HEIGHT, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    } else if (b->texture) {
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glDisable(GL_DEPTH_TEST);
        glUseProgram(show_program);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glEnable(GL_DEPTH_TEST);
    }
}

static void make_projection(bool ortho, bool reversed, float field, mat4 out)
{
    if (ortho) {
        glm_ortho(-2.4f, 2.4f, -1.8f, 1.8f, 0.5f, 10.0f, out);
    } else {
        glm_perspective(field, 640.0f / 480.0f, 0.1f, 50.0f, out);
    }
    if (reversed) {
        out[2][2] = 0.0f;
        out[3][2] = 0.1f;
    }
}

static void write_block(mat4 clip_from_world, bool mapped)
{
    float block[20] = {1.0f, 1.0f, 1.0f, 1.0f};
    memcpy(block + 4, clip_from_world, 16 * sizeof *block);
    if (!mapped) {
        glBufferSubData(GL_UNIFORM_BUFFER, 0, sizeof block, block);
        return;
    }
    void *at = glMapBufferRange(GL_UNIFORM_BUFFER, 0, sizeof block, GL_MAP_WRITE_BIT);
    if (at)
        memcpy(at, block, sizeof block);
    glUnmapBuffer(GL_UNIFORM_BUFFER);
}

/* The boxes once more by other matrices, each moved a little. */
static void draw_more(GLuint program, float field, int copies)
{
    mat4 projection, matrix;
    glm_perspective(field, 640.0f / 480.0f, 0.05f, 20.0f, projection);
    for (int i = 0; i < copies; ++i) {
        mat4 model;
        glm_translate_make(model, (vec3){0.9f, -0.9f, -3.0f - 0.1f * (float)i});
        glm_scale_uni(model, 0.15f);
        glm_mat4_mul(projection, model, matrix);
        glUniformMatrix4fv(glGetUniformLocation(program, "clip_from_world"), 1, GL_FALSE, matrix[0]);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, 24);
    }
}

static void add_second_picture(GLuint framebuffer)
{
    GLuint texture;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, WIDTH, HEIGHT, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, texture, 0);
    glDrawBuffers(2, (const GLenum[]){GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1});
}

static void open_and_close_windows(const dropin_options *o)
{
    for (int i = 0; i < 40; ++i) {
        GLFWwindow *window = dropin_open_window("one of many", o);
        glEnable(GL_DEPTH_TEST);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glfwSwapBuffers(window);
        glfwDestroyWindow(window);
    }
}

int main(int argc, char **argv)
{
    dropin_options o = dropin_read_options(argc, argv);
    const bool mapped = has(argc, argv, "mapped"), buffer = mapped || has(argc, argv, "ubo");
    const bool reversed = has(argc, argv, "reversed"), range = has(argc, argv, "range");
    const bool own = has(argc, argv, "own"), weapon = has(argc, argv, "weapon"), icon = has(argc, argv, "icon");
    const bool pick = has(argc, argv, "pick"), resolve = has(argc, argv, "resolve"), shared = has(argc, argv, "shared");
    const bool empty = has(argc, argv, "empty"), demand = has(argc, argv, "demand");
    const bool post = shared || has(argc, argv, "post");
    if (has(argc, argv, "german") && !setlocale(LC_ALL, "de_DE.UTF-8")) {
        fprintf(stderr, "there is no locale de_DE.UTF-8\n");
        return 77;
    }
    if (has(argc, argv, "contexts"))
        open_and_close_windows(&o);
    GLFWwindow *window = dropin_open_window("foreign", &o);
    GLFWwindow *other = NULL;
    GLuint vertex_array, block;
    if (shared) {
        glGenVertexArrays(1, &vertex_array);
        glBindVertexArray(vertex_array);
        glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
        other = glfwCreateWindow(64, 64, "scene", NULL, window);
        if (!other)
            return 3;
        glfwMakeContextCurrent(other);
        glViewport(0, 0, WIDTH, HEIGHT);
    }
    const GLuint program = make_program(buffer);
    mat4 projection, view, clip_from_world;
    make_projection(has(argc, argv, "ortho"), reversed, 0.8f, projection);
    glm_lookat((vec3){2.2f, 2.4f, 3.6f}, (vec3){0.0f, 0.4f, 0.0f}, (vec3){0.0f, 1.0f, 0.0f}, view);
    glm_mat4_mul(projection, view, clip_from_world);
    glGenVertexArrays(1, &vertex_array);
    glBindVertexArray(vertex_array);
    glGenBuffers(1, &block);
    glBindBuffer(GL_UNIFORM_BUFFER, block);
    glBufferData(GL_UNIFORM_BUFFER, 20 * sizeof(float), NULL, GL_DYNAMIC_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, block);
    glEnable(GL_DEPTH_TEST);
    if (reversed) {
        void (*clip_control)(GLenum, GLenum);
        void *address = find_function("glClipControl", NULL);
        if (!address)
            return 2;
        memcpy(&clip_control, &address, sizeof address);
        clip_control(LOWER_LEFT, ZERO_TO_ONE);
    }
    if (range)
        glDepthRange(1.0, 0.0);
    if (reversed || range) {
        glClearDepth(0.0);
        glDepthFunc(GL_GREATER);
    }

    buffers b = {0};
    const GLuint show_program = make_show_program();
    if (post || resolve)
        b.scene = make_framebuffer(resolve ? 4 : 0, post ? &b.texture : NULL);
    if (resolve)
        b.resolved = make_framebuffer(0, NULL);
    const GLuint small_one = has(argc, argv, "small") ? make_framebuffer(0, NULL) : 0;

    glssao_effect *effect = NULL;
    glssao_config config = {.load = find_function, .log = glssao_log_to_stderr, .width = 640, .height = 480};
    if (own && glssao_create(&config, &effect) != GLSSAO_OK)
        return 1;
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    settings.radius = 0.5f;

    for (int number = 1; !o.ended && !glfwWindowShouldClose(window); ++number) {
        if (number == 4 && has(argc, argv, "zoom")) {
            make_projection(false, false, 0.4f, projection);
            glm_mat4_mul(projection, view, clip_from_world);
        }
        if (number == 4 && has(argc, argv, "several")) {
            b.scene = make_framebuffer(0, &b.texture);
            add_second_picture(b.scene);
            glBindTexture(GL_TEXTURE_2D, b.texture);
        }
        glUseProgram(program);
        glBindFramebuffer(GL_FRAMEBUFFER, b.scene);
        if (buffer)
            write_block(clip_from_world, mapped);
        else
            glUniformMatrix4fv(glGetUniformLocation(program, "clip_from_world"), 1, GL_FALSE, clip_from_world[0]);
        glClearColor(0.3f, 0.4f, 0.6f, 1.0f);
        if (small_one)
            draw_small(small_one, program, clip_from_world);
        if (pick) {
            float pixel[4];
            glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
            glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, 24);
            glReadPixels(320, 240, 1, 1, GL_RGBA, GL_FLOAT, pixel);
        }
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glDepthMask(!empty);
        if (!demand || number > 2)
            glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, 24);
        glDepthMask(GL_TRUE);
        if (own) {
            glssao_frame frame = {.clip_zero_to_one = reversed};
            memcpy(frame.projection, projection, sizeof frame.projection);
            if (range) { /* depth runs the other way round */
                frame.projection[10] = -frame.projection[10];
                frame.projection[14] = -frame.projection[14];
            }
            if (glssao_compute_framebuffer(effect, b.scene, &frame, &settings) == GLSSAO_OK)
                glssao_apply(effect, b.scene);
        }
        if (small_one)
            blit_small(small_one);
        if (weapon) {
            glClear(GL_DEPTH_BUFFER_BIT);
            draw_more(program, 1.2f, 1);
        }
        if (icon) {
            glViewport(0, 0, 80, 60);
            draw_more(program, 0.5f, 5);
            glViewport(0, 0, WIDTH, HEIGHT);
        }
        if (other) {
            glFinish();
            glfwMakeContextCurrent(window);
            glBindTexture(GL_TEXTURE_2D, b.texture);
        }
        show(&b, show_program);
        dropin_show(window, &o, WIDTH, HEIGHT);
        if (demand)
            nanosleep(&(struct timespec){0, 400000000}, NULL);
        if (other)
            glfwMakeContextCurrent(other);
    }
    glssao_destroy(effect);
    glfwTerminate();
    return o.failed;
}
