/* SPDX-License-Identifier: MIT
 *
 * Shared by the dropin programs; your own program does not need it. It chooses where the OpenGL functions come from
 * (libGL's prototypes, libepoxy or GLEW), reads the command line, and writes the last frame to a file for the test.
 */
#pragma once

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
    int frames, samples; /* --frames N: draws N frames, then ends; --samples N: samples a pixel of the window */
    bool with_ao, egl;   /* not --no-ao; --egl */
    bool ended, failed;  /* the last frame was shown; its picture was not written, or OpenGL had an error */
    const char *picture; /* --picture FILE.ppm: writes the last frame there */
} dropin_options;

dropin_options dropin_read_options(int argc, char **argv);

/* Opens a window of 640 x 480, makes its context current and prepares the loader. Ends the program where that fails. */
GLFWwindow *dropin_open_window(const char *title, const dropin_options *o);

/* True where the framebuffer's size differs from *width by *height, which are then updated. A minimised window keeps
 * its size. */
bool dropin_take_size(GLFWwindow *window, int *width, int *height);

/* Swaps the buffers, handles events, counts frames, and writes the picture of the last one. */
void dropin_show(GLFWwindow *window, dropin_options *o, int width, int height);
