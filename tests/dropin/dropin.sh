#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# dropin.sh CHECK PROGRAM...: runs each program under Xvfb with and without occlusion and checks the pictures, also with 4
# samples a pixel. The first program's picture is the reference for the others.
set -euo pipefail
check=$1
shift
if ! command -v xvfb-run >/dev/null; then
    echo "dropin.sh: skipped: no xvfb-run (Debian and Ubuntu: apt install xvfb xauth)"
    exit 77
fi
if [ -z "${INSIDE_XVFB:-}" ]; then
    INSIDE_XVFB=1 LIBGL_ALWAYS_SOFTWARE=1 exec xvfb-run -a -s "-screen 0 800x600x24 -noreset" bash "$0" "$check" "$@"
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
reference=()
try() { # name program arguments
    local name=$1
    shift
    "$@" --frames 2 --picture "$scratch/$name-with.ppm"
    "$@" --frames 2 --picture "$scratch/$name-without.ppm" --no-ao
    "$check" "$scratch/$name-with.ppm" "$scratch/$name-without.ppm" "${reference[@]}"
    echo "$name: good"
}
for program in "$@"; do
    name=$(basename "$program")
    try "$name" "$program"
    reference=("$scratch/$(basename "$1")-with.ppm")
    try "$name-samples" "$program" --samples 4
done
