/* SPDX-License-Identifier: MIT
 *
 * Accessibility of a few analytic scenes by every technique, the same code on each system: against closed forms, and
 * as a file of floats that another system's run is compared with.
 */
#pragma once

#include <glssao/glssao.h>
#include <stdbool.h>

/* The current context and its loader; gl_load was called. */
typedef struct pictures_host {
    glssao_load_fn load;
    void *load_user;
    const char *cache; /* a folder of linked programs, or NULL */
} pictures_host;

/* Computes every picture and checks those with a closed form and the host's state about every call. Writes all of them
 * to `path`, or, where `compares`, reads the file and wants each value within one step of R16. False, with one line on
 * stderr, at the first fault. */
bool pictures_check(const pictures_host *host, const char *path, bool compares);
