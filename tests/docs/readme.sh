#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# readme.sh PAGE CC INCLUDE: the C blocks of the page compile without a warning, as the body of a function that has what
# the page takes for granted, and its table has the options of CMakeLists.txt beside it, and no other. (integration.md's
# blocks are cut from compiled files: snippets.sh.)
set -euo pipefail
page=$1 cc=$2 include=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
awk '/^```c$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$page" >"$scratch/block"
[ -s "$scratch/block" ] || { echo "readme.sh: no C block in $page" >&2; exit 1; }
{
    grep '^#include' "$scratch/block"
    cat <<'C'
#include <string.h>
void *my_gl_loader(const char *name, void *user);
void each_frame(int w, int h, uint32_t depth, uint32_t normals, uint32_t framebuffer, const float clip_from_view[16]);
void each_frame(int w, int h, uint32_t depth, uint32_t normals, uint32_t framebuffer, const float clip_from_view[16])
{
C
    grep -v '^#include' "$scratch/block"
    echo "}"
} >"$scratch/block.c"
"$cc" -std=c11 -Wall -Wextra -Wpedantic -Wno-sizeof-array-argument -Werror -fsyntax-only -I "$include" "$scratch/block.c"

diff <(sed -n 's/^option(\([A-Z_]*\) .*/\1/p' "$(dirname "$page")/CMakeLists.txt" | sort) \
    <(sed -n 's/^| `\([A-Z_]*\)` |.*/\1/p' "$page" | sort) || {
    echo "readme.sh: options of CMakeLists.txt (<) and of $page (>) differ" >&2
    exit 1
}
