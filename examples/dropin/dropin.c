/* SPDX-License-Identifier: MIT
 *
 * The smallest host program: a window and a few boxes drawn in one forward pass. Comments with "glssao" mark what adds
 * ambient occlusion. It is compiled three times, with libGL's prototypes, libepoxy and GLEW, because glssao's loader
 * must work beside each of them.   dropin [--frames N] [--picture FILE.ppm] [--no-ao] [--samples N]
 */
#include "support.h"

#include <cglm/cglm.h>

/* glssao, snippet: loader */
#include <glssao/glssao.h>
#include <string.h>
/* end */

static const char *const shader_texts[2] = {
    "#version 330\n"
    "const vec3 boxes[12] = vec3[](vec3(0.0, -0.1, 0.0), vec3(4.0, 0.1, 4.0), vec3(0.8, 0.8, 0.8),\n" /* center, */
    "                              vec3(-0.8, 0.6, 0.0), vec3(0.6, 0.6, 0.6), vec3(0.9, 0.6, 0.4),\n" /* half size, */
    "                              vec3(0.5, 0.4, 0.3), vec3(0.4, 0.4, 0.4), vec3(0.5, 0.7, 0.9),\n"  /* color */
    "                              vec3(0.3, 0.9, -1.2), vec3(0.9, 0.9, 0.3), vec3(0.7, 0.8, 0.6));\n"
    "uniform mat4 clip_from_world; out vec3 normal, color;\n"
    "void main() {\n"
    "    int box = gl_InstanceID / 6 * 3, axis = gl_InstanceID / 2 % 3;\n" /* an instance is a face */
    "    vec3 p = vec3(gl_VertexID % 2, gl_VertexID / 2, gl_InstanceID % 2) * 2.0 - 1.0;\n"
    "    normal = vec3(0.0, 0.0, p.z);\n"
    "    for (int i = 0; i < axis; ++i) { p = p.zxy; normal = normal.zxy; }\n"
    "    color = boxes[box + 2];\n"
    "    gl_Position = clip_from_world * vec4(boxes[box] + boxes[box + 1] * p, 1.0);\n"
    "}\n",
    "#version 330\nin vec3 normal, color; out vec4 o_color;\n"
    "void main() { o_color = vec4(color * (0.6 + 0.4 * max(dot(normal, vec3(0.36, 0.8, 0.48)), 0.0)), 1.0); }\n"};

static GLuint make_program(void)
{
    GLuint program = glCreateProgram();
    for (int i = 0; i < 2; ++i) {
        GLuint shader = glCreateShader(i == 0 ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
        glShaderSource(shader, 1, &shader_texts[i], NULL);
        glCompileShader(shader);
        glAttachShader(program, shader);
    }
    glLinkProgram(program);
    glUseProgram(program);
    return program;
}

static void draw_boxes(GLuint program, mat4 projection)
{
    mat4 view, clip_from_world;
    glm_lookat((vec3){2.2f, 2.4f, 3.6f}, (vec3){0.0f, 0.4f, 0.0f}, (vec3){0.0f, 1.0f, 0.0f}, view);
    glm_mat4_mul(projection, view, clip_from_world);
    glUniformMatrix4fv(glGetUniformLocation(program, "clip_from_world"), 1, GL_FALSE, clip_from_world[0]);
    glClearColor(0.3f, 0.4f, 0.6f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, 24);
}

int main(int argc, char **argv)
{
    dropin_options o = dropin_read_options(argc, argv);
    GLFWwindow *window = dropin_open_window("glssao dropin", &o);
    int width = 0, height = 0;
    mat4 projection;
    GLuint vertex_array, program = make_program();
    glGenVertexArrays(1, &vertex_array);
    glBindVertexArray(vertex_array);
    glEnable(GL_DEPTH_TEST);

    /* glssao, snippet: create */
    glssao_effect *effect = NULL;
    glssao_config config = {.get_proc = glfwGetProcAddress, .log = glssao_log_to_stderr, .width = 640, .height = 480};
    if (glssao_create(&config, &effect) != GLSSAO_OK)
        return 1;
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    settings.radius = 0.5f; /* in the unit of your scene: here the boxes are about 1 wide */
    /* end */

    while (!o.ended && !glfwWindowShouldClose(window)) {
        if (dropin_take_size(window, &width, &height)) {
            glViewport(0, 0, width, height);
            glm_perspective(0.8f, (float)width / (float)height, 0.1f, 50.0f, projection);
        }
        draw_boxes(program, projection);
        if (o.with_ao) {
            /* glssao, snippet: window frame */
            glssao_frame frame = {0};
            memcpy(frame.projection, projection, sizeof frame.projection);
            if (glssao_compute_framebuffer(effect, 0, &frame, &settings) == GLSSAO_OK) /* 0: the window */
                glssao_apply(effect, 0);
            /* end */
        }
        dropin_show(window, &o, width, height);
    }
    /* glssao, snippet: destroy */
    glssao_destroy(effect);
    /* end */
    glfwTerminate();
    return o.failed;
}
