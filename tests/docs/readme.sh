#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# readme.sh ROOT CC INCLUDE: the C block of README.md compiles without a warning inside a function that declares the names
# it uses, and the options in CONTRIBUTING.md's table are those of CMakeLists.txt. (Other pages: snippets.sh.)
set -euo pipefail
root=$1 cc=$2 include=$3
page=$root/README.md
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
awk '/^```c$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$page" >"$scratch/block"
[ -s "$scratch/block" ] || { echo "readme.sh: no C block in $page" >&2; exit 1; }
{
    grep '^#include' "$scratch/block"
    cat <<'C'
#include <string.h>
glssao_proc glfwGetProcAddress(const char *name);
void each_frame(int w, int h, uint32_t depth, uint32_t framebuffer, const float clip_from_view[16]);
void each_frame(int w, int h, uint32_t depth, uint32_t framebuffer, const float clip_from_view[16])
{
C
    grep -v '^#include' "$scratch/block"
    echo "}"
} >"$scratch/block.c"
"$cc" -std=c11 -Wall -Wextra -Wpedantic -Wno-sizeof-array-argument -Werror -fsyntax-only -I "$include" "$scratch/block.c"

diff <(sed -n 's/^option(\([A-Z_]*\) .*/\1/p' "$root/CMakeLists.txt" | sort) \
    <(sed -n 's/^| `\([A-Z_]*\)` |.*/\1/p' "$root/CONTRIBUTING.md" | sort) || {
    echo "readme.sh: options of CMakeLists.txt (<) and of CONTRIBUTING.md (>) differ" >&2
    exit 1
}
