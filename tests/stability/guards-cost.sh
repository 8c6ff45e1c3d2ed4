#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# guards-cost.sh [ROUNDS]: the cost of the shaders' guards. Builds glssao-render from two copies of the repository, one of
# them without the guards of guards.tsv that are in glsl/, and runs both in turn. Prints for each technique the least
# median of the frame's occlusion passes (ms, software rasteriser) with and without guards, and the ratio.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
for kind in with without; do
    mkdir "$copy/$kind"
    cp -r "$root"/{CMakeLists.txt,LICENSE,glsl,lib,tests,examples,third_party,docs,README.md,CHANGELOG.md} "$copy/$kind"
done
taken=0
while IFS=$'\t' read -r guard file text instead _; do
    [[ $guard == \#* || $file != glsl/* ]] && continue
    cp "$copy/without/$file" "$copy/kept"
    TEXT=$text INSTEAD=$instead perl -0pi -e 's/\Q$ENV{TEXT}\E/$ENV{INSTEAD}/' "$copy/without/$file"
    cmp -s "$copy/without/$file" "$copy/kept" || taken=$((taken + 1))
done <"$here/guards.tsv"
echo "$taken guards taken away"
for kind in with without; do
    cmake -S "$copy/$kind" -B "$copy/$kind/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo >/dev/null
    ninja -C "$copy/$kind/build" glssao-render >/dev/null
done
# Sum of the passes' medians, ms.
passes() { # kind, then glssao-render's arguments
    local kind=$1
    shift
    "$copy/$kind/build/examples/render/glssao-render" --scene columns -s 960x540 --context egl --bench 15 "$@" 2>&1 |
        awk '/, GPU +median/ {for (i = 1; i < NF; ++i) if ($i == "median") sum += $(i + 1)} END {print sum}'
}
for what in "classic high" "hemisphere high" "horizon high" "horizon ultra"; do
    read -r technique quality <<<"$what"
    for ((i = 0; i < ${1:-5}; ++i)); do
        kinds=(with without)
        ((i % 2)) && kinds=(without with) # neither always comes second
        for kind in "${kinds[@]}"; do
            echo "$kind $(passes "$kind" -t "$technique" -q "$quality" --set tiles=off)"
        done
    done | awk -v what="$what" '!($1 in least) || $2 < least[$1] {least[$1] = $2}
        END {printf "%s: %.1f with, %.1f without, %.2f\n", what, least["with"], least["without"], least["with"] / least["without"]}'
done
