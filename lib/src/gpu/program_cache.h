/* SPDX-License-Identifier: MIT
 *
 * Linked programs kept on disk between runs, in a folder that the host names.
 */
#ifndef GLSSAO_GPU_PROGRAM_CACHE_H
#define GLSSAO_GPU_PROGRAM_CACHE_H

#include "gpu/programs.h"

/* Whether the folder exists, belongs to the user of this process, and nobody else can write to it. */
bool glssao__program_cache_trusts(const char *folder);
/* The linked program of that source, or 0. Only files that the user owns and nobody else can write are read; links
 * are not followed. */
gl_uint glssao__program_cache_read(const glssao__gl *gl, const char *folder, const glssao__program_source *source);
/* Keeps the program; does nothing where it can't. */
void glssao__program_cache_write(const glssao__gl *gl, const char *folder, const glssao__program_source *source,
                                 gl_uint program);

#endif
