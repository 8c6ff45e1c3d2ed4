/* SPDX-License-Identifier: MIT
 *
 * The scene's names for fault.h.
 */
#pragma once

#include "fault.h"

typedef failure scene_fault;
#define scene_fail fault_set
#define scene_fail_memory fault_set_memory
