/* SPDX-License-Identifier: MIT
 *
 * Every kind of frame that a schedule can be made for, without OpenGL.
 */
#pragma once

#include "frame/schedule.h"

/* Calls `visit` with a schedule for each combination of techniques, samples, sizes, blurs, rounds, bent normals,
 * encodings, layers, margins, accumulation and capabilities that can change a step's program. Returns how many. */
int schedules_visit(void (*visit)(const glssao__request *request, const glssao__schedule *schedule, void *user),
                    void *user);

/* A request for a frame of that size with depth and normals, on a GPU with compute shaders. */
glssao__request schedules_request(glssao_frame *frame, glssao_settings *settings, int width, int height);
