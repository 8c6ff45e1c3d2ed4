/* SPDX-License-Identifier: MIT
 *
 * A GL loader that counts the calls an effect makes. One at a time.
 */
#pragma once

#include <glssao/glssao.h>
#include <stdint.h>

typedef struct gl_counts {
    int draws;      /* glDrawArrays */
    int elements;   /* glDrawElementsInstanced */
    int dispatches; /* glDispatchCompute */
    int unordered;  /* draws, dispatches and frame ends that follow a dispatch without the barrier they need */
    int shaders;    /* glCompileShader */
    int programs;   /* glLinkProgram */
    int binaries;   /* glProgramBinary */
    int textures;   /* glTexImage2D with a size */
    int64_t bytes;  /* their size, from their formats */
    int clears;     /* glClearBufferfv */
} gl_counts;

/* Starts counting; `load` finds the real functions. */
void gl_counter_start(glssao_load_fn load, void *load_user);
/* A glssao_load_fn; ignores `user`. */
void *gl_counter_load(const char *name, void *user);
/* The counts since the last call, which marks the end of a frame. */
gl_counts gl_counter_take(void);
