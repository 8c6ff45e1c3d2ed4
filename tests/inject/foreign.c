/* SPDX-License-Identifier: MIT
 *
 * foreign MODE...: the dropin programs' boxes drawn straight into the window as other programs do it, for inject.sh.
 *   ubo       the matrix in a uniform buffer, written by glBufferSubData; "mapped": by glMapBufferRange
 *   ortho     an orthographic view
 *   reversed  glClipControl to 0..1, near plane at 1, infinitely far at 0
 *   range     glDepthRange(1, 0)
 *   own       with the effect by glssao_compute, which is told the true matrix: what inject's should look like
 * Options as dropin's.
 */
#include "support.h"
#include "window_depth.h"

#include <cglm/cglm.h>
#include <glssao/glssao.h>
#include <string.h>

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

static GLuint make_program(bool buffer)
{
    const char *const vertex[2] = {vertex_texts[buffer], rest_of_vertex_text};
    GLuint program = glCreateProgram();
    for (int i = 0; i < 2; ++i) {
        GLuint shader = glCreateShader(i == 0 ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
        glShaderSource(shader, i == 0 ? 2 : 1, i == 0 ? vertex : &fragment_text, NULL);
        glCompileShader(shader);
        glAttachShader(program, shader);
    }
    glLinkProgram(program);
    glUseProgram(program);
    return program;
}

static void make_projection(bool ortho, bool reversed, mat4 out)
{
    if (ortho) {
        glm_ortho(-2.4f, 2.4f, -1.8f, 1.8f, 0.5f, 10.0f, out);
    } else {
        glm_perspective(0.8f, 640.0f / 480.0f, 0.1f, 50.0f, out);
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

int main(int argc, char **argv)
{
    dropin_options o = dropin_read_options(argc, argv);
    const bool mapped = has(argc, argv, "mapped"), buffer = mapped || has(argc, argv, "ubo");
    const bool reversed = has(argc, argv, "reversed"), range = has(argc, argv, "range");
    const bool own = has(argc, argv, "own");
    GLFWwindow *window = dropin_open_window("foreign", &o);
    GLuint vertex_array, block, program = make_program(buffer);
    mat4 projection, view, clip_from_world;
    make_projection(has(argc, argv, "ortho"), reversed, projection);
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

    glssao_effect *effect = NULL;
    glssao_config config = {.load = find_function, .log = glssao_log_to_stderr, .width = 640, .height = 480};
    window_depth *depth = own ? window_depth_create(find_function, NULL) : NULL;
    if (own && (!depth || glssao_create(&config, &effect) != GLSSAO_OK))
        return 1;
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    settings.radius = 0.5f;

    while (!o.ended && !glfwWindowShouldClose(window)) {
        if (buffer)
            write_block(clip_from_world, mapped);
        else
            glUniformMatrix4fv(glGetUniformLocation(program, "clip_from_world"), 1, GL_FALSE, clip_from_world[0]);
        glClearColor(0.3f, 0.4f, 0.6f, 1.0f);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, 24);
        if (own) {
            glssao_frame frame = {.depth_texture = window_depth_copy(depth, 0, 640, 480, NULL),
                                  .clip_zero_to_one = reversed};
            memcpy(frame.projection, projection, sizeof frame.projection);
            if (range) { /* depth runs the other way round */
                frame.projection[10] = -frame.projection[10];
                frame.projection[14] = -frame.projection[14];
            }
            if (glssao_compute(effect, &frame, &settings) == GLSSAO_OK)
                glssao_apply(effect, 0);
        }
        dropin_show(window, &o, 640, 480);
    }
    glssao_destroy(effect);
    window_depth_destroy(depth);
    glfwTerminate();
    return o.failed;
}
