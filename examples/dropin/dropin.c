/* SPDX-License-Identifier: MIT
 *
 * The smallest foreign program: a window, a few boxes drawn in one forward pass, and ambient occlusion added to it.
 * What was added stands between "glssao" and "end" marks. It is compiled three times: with the prototypes of libGL,
 * with libepoxy and with GLEW, to show that glssao's loader gets in the way of none of them.
 *   dropin [--frames N] [--picture FILE.ppm] [--no-ao]
 */
#if defined(DROPIN_EPOXY)
#include <epoxy/gl.h>
#elif defined(DROPIN_GLEW)
#include <GL/glew.h>
#else
#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>
#endif
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <cglm/cglm.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* snippet: loader */
#include <glssao/glssao.h> /* glssao */

static void *find_function(const char *name, void *user)
{
    (void)user;
    GLFWglproc function = glfwGetProcAddress(name);
    void *address; /* ISO C has no cast from a function's address to an object's; POSIX and Windows promise one */
    memcpy(&address, &function, sizeof address);
    return address;
} /* end */
/* end of snippet */

static const char *const vertex_text =
    "#version 330\n"
    "uniform mat4 view, projection; uniform vec3 center, size; out vec3 normal;\n"
    "void main() {\n"
    "    int face = gl_VertexID / 6, corner = gl_VertexID % 6, axis = face / 2;\n"
    "    vec3 p = vec3(0.0), n = vec3(0.0);\n"
    "    n[axis] = float(face % 2) * 2.0 - 1.0;\n"
    "    p[(axis + 1) % 3] = corner == 1 || corner == 2 || corner == 4 ? 1.0 : -1.0;\n"
    "    p[(axis + 2) % 3] = corner == 2 || corner == 4 || corner == 5 ? 1.0 : -1.0;\n"
    "    normal = n;\n"
    "    gl_Position = projection * view * vec4(center + size * (p + n), 1.0);\n"
    "}\n";
static const char *const fragment_text =
    "#version 330\n"
    "uniform vec3 color; in vec3 normal; out vec4 o_color;\n"
    "void main() { o_color = vec4(color * (0.6 + 0.4 * max(dot(normal, vec3(0.36, 0.8, 0.48)), 0.0)), 1.0); }\n";

static const struct box {
    float center[3], size[3], color[3]; /* half sizes */
} boxes[] = {{{0.0f, -0.1f, 0.0f}, {4.0f, 0.1f, 4.0f}, {0.8f, 0.8f, 0.8f}},
             {{-0.8f, 0.6f, 0.0f}, {0.6f, 0.6f, 0.6f}, {0.9f, 0.6f, 0.4f}},
             {{0.5f, 0.4f, 0.3f}, {0.4f, 0.4f, 0.4f}, {0.5f, 0.7f, 0.9f}},
             {{0.3f, 0.9f, -1.2f}, {0.9f, 0.9f, 0.3f}, {0.7f, 0.8f, 0.6f}}};

static GLuint compile(void)
{
    GLuint program = glCreateProgram();
    for (int i = 0; i < 2; ++i) {
        GLuint shader = glCreateShader(i == 0 ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
        glShaderSource(shader, 1, i == 0 ? &vertex_text : &fragment_text, NULL);
        glCompileShader(shader);
        glAttachShader(program, shader);
    }
    glLinkProgram(program);
    return program;
}

static void draw_boxes(GLuint program, mat4 view, mat4 projection)
{
    glUseProgram(program);
    glEnable(GL_DEPTH_TEST);
    glClearColor(0.3f, 0.4f, 0.6f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glUniformMatrix4fv(glGetUniformLocation(program, "view"), 1, GL_FALSE, view[0]);
    glUniformMatrix4fv(glGetUniformLocation(program, "projection"), 1, GL_FALSE, projection[0]);
    for (size_t i = 0; i < sizeof boxes / sizeof *boxes; ++i) {
        glUniform3fv(glGetUniformLocation(program, "center"), 1, boxes[i].center);
        glUniform3fv(glGetUniformLocation(program, "size"), 1, boxes[i].size);
        glUniform3fv(glGetUniformLocation(program, "color"), 1, boxes[i].color);
        glDrawArrays(GL_TRIANGLES, 0, 36);
    }
}

static bool save_picture(const char *path, int width, int height)
{
    size_t row = (size_t)width * 3;
    unsigned char *rgb = malloc(row * (size_t)height);
    FILE *file = fopen(path, "wb");
    bool ok = rgb && file;
    if (ok) {
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, rgb);
        fprintf(file, "P6 %d %d 255\n", width, height);
        for (int y = height; ok && y-- > 0;)
            ok = fwrite(rgb + row * (size_t)y, row, 1, file) == 1;
    }
    free(rgb);
    return file && fclose(file) == 0 && ok;
}

int main(int argc, char **argv)
{
    int frames = -1;
    bool with_ao = true, ok = true;
    const char *picture = NULL;
    for (int i = 1; i < argc; ++i) {
        if (strcmp(argv[i], "--frames") == 0 && i + 1 < argc)
            frames = atoi(argv[++i]);
        else if (strcmp(argv[i], "--picture") == 0 && i + 1 < argc)
            picture = argv[++i];
        else if (strcmp(argv[i], "--no-ao") == 0)
            with_ao = false;
    }
    if (!glfwInit())
        return 1;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    GLFWwindow *window = glfwCreateWindow(640, 480, "glssao dropin", NULL, NULL);
    if (!window)
        return 1;
    glfwMakeContextCurrent(window);
#if defined(DROPIN_GLEW)
    glewExperimental = GL_TRUE;
    if (glewInit() != GLEW_OK)
        return 1;
#endif
    GLuint program = compile(), vertex_array, framebuffer, color, depth;
    glGenVertexArrays(1, &vertex_array);
    glBindVertexArray(vertex_array);
    glGenFramebuffers(1, &framebuffer);
    glGenTextures(1, &color);
    glGenTextures(1, &depth);
    int width = 0, height = 0;
    mat4 view, projection;
    glm_lookat((vec3){2.2f, 2.4f, 3.6f}, (vec3){0.0f, 0.4f, 0.0f}, (vec3){0.0f, 1.0f, 0.0f}, view);

    /* snippet: create */
    glssao_effect *effect = NULL; /* glssao */
    glssao_config config = {.load = find_function, .log = glssao_log_to_stderr, .width = 640, .height = 480};
    if (glssao_create(&config, &effect) != GLSSAO_OK)
        return 1;
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    settings.radius = 0.5f; /* in the unit of your scene: here the boxes are about 1 wide */ /* end */
    /* end of snippet */

    while (ok && frames != 0 && !glfwWindowShouldClose(window)) {
        int w, h;
        glfwGetFramebufferSize(window, &w, &h);
        if ((w != width || h != height) && w > 0 && h > 0) {
            width = w;
            height = h;
            glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
            glBindTexture(GL_TEXTURE_2D, color);
            glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, w, h, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
            glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color, 0);
            glBindTexture(GL_TEXTURE_2D, depth);
            glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, w, h, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, NULL);
            glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
            glm_perspective(0.8f, (float)w / (float)h, 0.1f, 50.0f, projection);
            /* snippet: resize */
            glssao_resize(effect, width, height); /* glssao */ /* end */
            /* end of snippet */
        }
        glViewport(0, 0, width, height);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        draw_boxes(program, view, projection);

        /* snippet: frame */
        if (with_ao) { /* glssao */
            glssao_frame frame = {.depth_texture = depth};
            memcpy(frame.projection, projection, sizeof frame.projection);
            if (glssao_compute(effect, &frame, &settings) == GLSSAO_OK)
                glssao_apply(effect, framebuffer);
        } /* end */
        /* end of snippet */

        glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
        glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        if (frames > 0 && --frames == 0 && picture)
            ok = save_picture(picture, width, height) && glGetError() == GL_NO_ERROR;
        glfwSwapBuffers(window);
        glfwPollEvents();
    }
    /* snippet: destroy */
    glssao_destroy(effect); /* glssao */ /* end */
    /* end of snippet */
    glfwTerminate();
    return ok ? 0 : 1;
}
