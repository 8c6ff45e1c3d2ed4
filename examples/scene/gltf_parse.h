// SPDX-License-Identifier: MIT
//
// tinygltf's parser, behind the guards that it needs.
#ifndef GLSSAO_EXAMPLES_GLTF_PARSE_H
#define GLSSAO_EXAMPLES_GLTF_PARSE_H

#include <cstddef>

#include <tiny_gltf.h>

#include "gltf_file.h"
#include "scene_fault.h"

// Parses the file of that path into `model`. False, with the fault set, on failure; throws what tinygltf throws.
bool gltf_parse(tinygltf::Model *model, const gltf_file &file, const char *path, size_t *out_external_bytes,
                scene_fault *fault);

#endif
