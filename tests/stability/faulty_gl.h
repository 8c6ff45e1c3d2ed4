/* SPDX-License-Identifier: MIT
 *
 * An OpenGL that fails on demand and counts living objects: a loader for glssao_config that wraps every function that
 * may fail, and the C allocator, which the linker wraps (--wrap=malloc and so on).
 */
#pragma once

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

/* Like fixture_load, whose context it takes. */
void *faulty_load(const char *name, void *user);

/* The `number`-th chance to fail from now on is taken (0: the first); negative: none. */
void faulty_arm(int number);

/* Returns what has failed since, and disarms. */
fault faulty_disarm(void);

/* OpenGL objects and memory blocks that the effect has not freed. */
int faulty_live_objects(void);
int faulty_live_blocks(void);
