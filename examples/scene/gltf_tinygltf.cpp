// SPDX-License-Identifier: MIT
//
// Compiles tinygltf from its header, with hidden symbols, instead of linking libtinygltf. Debian's libdraco exports an
// older tinygltf under the same names, with structures of other sizes, and the dynamic linker would mix the two.
#include <nlohmann/json.hpp>

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_INCLUDE_JSON
#include <tiny_gltf.h>
