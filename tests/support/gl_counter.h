/* SPDX-License-Identifier: MIT
 *
 * A loader that counts, at the table of GL functions itself, what a host's GL is asked to do. One at a time.
 */
#ifndef GLSSAO_TESTS_GL_COUNTER_H
#define GLSSAO_TESTS_GL_COUNTER_H

#include <glssao/glssao.h>
#include <stdint.h>

typedef struct gl_counts {
    int draws;      /* glDrawArrays */
    int elements;   /* glDrawElementsInstanced */
    int dispatches; /* glDispatchCompute */
    int unordered;  /* draws, dispatches and ends that followed a dispatch without the barrier that they need */
    int shaders;    /* glCompileShader */
    int programs;   /* glLinkProgram */
    int binaries;   /* glProgramBinary */
    int textures;   /* glTexImage2D with a size */
    int64_t bytes;  /* of those, as their formats say */
    int clears;     /* glClearBufferfv */
} gl_counts;

/* Counts from now on; what is loaded comes from `load`. */
void gl_counter_start(glssao_load_fn load, void *load_user);
/* A glssao_load_fn; `user` is not looked at. */
void *gl_counter_load(const char *name, void *user);
/* What was counted since the last call, which is taken for the end of a frame. */
gl_counts gl_counter_take(void);

#endif
