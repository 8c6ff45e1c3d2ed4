/* SPDX-License-Identifier: MIT
 *
 * The scene's names for fault.h.
 */
#ifndef GLSSAO_EXAMPLES_SCENE_FAULT_H
#define GLSSAO_EXAMPLES_SCENE_FAULT_H

#include "fault.h"

typedef fault scene_fault;
#define scene_fail fault_set
#define scene_fail_memory fault_set_memory

#endif
