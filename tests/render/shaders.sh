#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# shaders.sh VALIDATOR FOLDER: the example renderer's shaders, every combination of their macros, judged by glslangValidator.
set -uo pipefail
validator=$1
cd "$2" || exit 1
macros=(TEXTURED COLORED MASKED LIT DOUBLE_SIDED BLENDED)
programs=0 failures=0
check() {
    programs=$((programs + 1))
    if ! out=$("$validator" -l "$@" 2>&1); then
        failures=$((failures + 1))
        echo "$*: $out"
    fi
}
for bits in $(seq 0 63); do
    defines=()
    for i in "${!macros[@]}"; do
        defines+=("-D${macros[i]}=$(((bits >> i) & 1))")
    done
    check "${defines[@]}" scene.vert main.frag
    [ "$bits" -ge 32 ] || check "${defines[@]}" scene.vert normals.frag # the pre-pass draws nothing blended
done
check fullscreen.vert map.frag
check fullscreen.vert view_distance.frag
for shader in *.vert *.frag; do
    head -n 1 "$shader" | grep -qx '#version 330' || { echo "$shader does not begin with #version 330"; failures=$((failures + 1)); }
done
echo "$programs programs, $failures failures"
[ $failures = 0 ]
