/* SPDX-License-Identifier: MIT
 *
 * Fills the table of OpenGL functions for examples and tests.
 */
#include "gl.h"

#include <stdio.h>
#include <string.h>

struct gl_functions gl;

bool gl_load(void *(*load)(const char *name, void *user), void *user, char *error, size_t error_size)
{
    void *address;
/* ISO C has no cast from an object pointer to a function pointer; POSIX guarantees the same representation. */
#define GL_LOAD(type, name)                                                                                            \
    address = load("gl" #name, user);                                                                                  \
    if (!address) {                                                                                                    \
        snprintf(error, error_size, "the context has no function gl" #name);                                           \
        return false;                                                                                                  \
    }                                                                                                                  \
    memcpy(&gl.name, &address, sizeof address);
    GL_FUNCTIONS(GL_LOAD)
#undef GL_LOAD
    return true;
}
