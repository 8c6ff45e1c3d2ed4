/* SPDX-License-Identifier: MIT
 *
 * What the dropin programs share and a program of your own has no use for: which loader brings the OpenGL functions
 * (libGL's prototypes, libepoxy or GLEW), the command line, and the last frame as a file for the test.
 */
#ifndef DROPIN_SUPPORT_H
#define DROPIN_SUPPORT_H

#if defined(DROPIN_EPOXY)
#include <epoxy/gl.h>
#elif defined(DROPIN_GLEW)
#include <GL/glew.h>
#elif defined(DROPIN_LEGACY)
#include <GL/gl.h>
#else
#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>
#endif
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <stdbool.h>

typedef struct dropin_options {
    int frames, samples; /* --frames N: as many, then ends; --samples N of the window */
    bool with_ao, egl;   /* not --no-ao; --egl */
    bool ended, failed;  /* the last frame was shown; its picture can't be written, or OpenGL had an error */
    const char *picture; /* --picture FILE.ppm: the last frame */
} dropin_options;

dropin_options dropin_read_options(int argc, char **argv);

/* A window of 640 x 480 with a current context, and the loader ready; where that fails the program ends. */
GLFWwindow *dropin_open_window(const char *title, const dropin_options *o);

/* True where the framebuffer has another size than *width by *height, which then follow. Minimised, it keeps its size.
 */
bool dropin_take_size(GLFWwindow *window, int *width, int *height);

/* Swaps the buffers and takes events; counts frames, and writes the last one's picture. */
void dropin_show(GLFWwindow *window, dropin_options *o, int width, int height);

#endif
