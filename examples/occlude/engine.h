/* SPDX-License-Identifier: MIT
 *
 * The part of occlude.c that talks to OpenGL. One thread makes an engine, uses it and destroys it.
 */
#pragma once

#include "occlude.h"

typedef struct engine engine;

engine *engine_create(uint32_t seed, char *error, size_t error_size);
void engine_destroy(engine *e);
const char *engine_description(const engine *e);
bool engine_compute(engine *e, const occlude_input *input, const glssao_settings *settings, float *out_accessibility,
                    char *error, size_t error_size);
