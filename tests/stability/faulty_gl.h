/* SPDX-License-Identifier: MIT
 *
 * An OpenGL that fails when told to, and counts what is alive: a loader for glssao_config that wraps each function
 * which may fail, and the C allocator's functions, which the linker wraps (--wrap=malloc and so on).
 */
#ifndef GLSSAO_TESTS_FAULTY_GL_H
#define GLSSAO_TESTS_FAULTY_GL_H

#include <glssao/glssao.h>

typedef enum fault {
    FAULT_NONE,
    FAULT_TEXTURE,
    FAULT_COMPILE,
    FAULT_LINK,
    FAULT_FRAMEBUFFER,
    FAULT_FENCE,
    FAULT_MEMORY
} fault;

/* As fixture_load, whose context it takes. */
void *faulty_load(const char *name, void *user);

/* The `number`-th (0: the first) chance to fail from now on is taken; negative: none. */
void faulty_arm(int number);

/* What was made to fail since; and disarms. */
fault faulty_disarm(void);

/* Objects of OpenGL and blocks of memory that the effect has not given back. */
int faulty_live_objects(void);
int faulty_live_blocks(void);

#endif
