/* SPDX-License-Identifier: MIT
 *
 * Command line, window and picture of the dropin programs.
 */
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

dropin_options dropin_read_options(int argc, char **argv)
{
    dropin_options o = {.frames = -1, .with_ao = true};
    for (int i = 1; i < argc; ++i) {
        if (strcmp(argv[i], "--frames") == 0 && i + 1 < argc)
            o.frames = atoi(argv[++i]);
        else if (strcmp(argv[i], "--samples") == 0 && i + 1 < argc)
            o.samples = atoi(argv[++i]);
        else if (strcmp(argv[i], "--picture") == 0 && i + 1 < argc)
            o.picture = argv[++i];
        else if (strcmp(argv[i], "--no-ao") == 0)
            o.with_ao = false;
        else if (strcmp(argv[i], "--egl") == 0)
            o.egl = true;
    }
    return o;
}

static void fail(const char *what)
{
    fprintf(stderr, "%s\n", what);
    exit(1);
}

GLFWwindow *dropin_open_window(const char *title, const dropin_options *o)
{
    if (!glfwInit())
        fail("GLFW can't start");
    glfwWindowHint(GLFW_SAMPLES, o->samples);
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, o->egl ? GLFW_EGL_CONTEXT_API : GLFW_NATIVE_CONTEXT_API);
#if !defined(DROPIN_LEGACY)
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
#endif
    GLFWwindow *window = glfwCreateWindow(640, 480, title, NULL, NULL);
    if (!window)
        fail("no window");
    glfwMakeContextCurrent(window);
#if defined(DROPIN_GLEW)
    glewExperimental = GL_TRUE;
    if (glewInit() != GLEW_OK)
        fail("GLEW can't load OpenGL");
#endif
    return window;
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

bool dropin_take_size(GLFWwindow *window, int *width, int *height)
{
    int w, h;
    glfwGetFramebufferSize(window, &w, &h);
    if ((w == *width && h == *height) || w <= 0 || h <= 0)
        return false;
    *width = w;
    *height = h;
    return true;
}

void dropin_show(GLFWwindow *window, dropin_options *o, int width, int height)
{
    o->ended = o->frames > 0 && --o->frames == 0;
    if (o->ended && o->picture)
        o->failed = !save_picture(o->picture, width, height) || glGetError() != GL_NO_ERROR;
    glfwSwapBuffers(window);
    glfwPollEvents();
}
