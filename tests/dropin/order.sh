#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# order.sh CHECK DROPIN_ORDER GLSSAO_RENDER SCENE.gltf: runs dropin-order under Xvfb with occlusion at each place of the frame.
# What integration.md recommends must be nearest to the picture with ray-traced occlusion, and what it warns of farthest.
set -euo pipefail
if ! command -v xvfb-run >/dev/null; then
    echo "order.sh: skipped: no xvfb-run (Debian and Ubuntu: apt install xvfb xauth)"
    exit 77
fi
if [ -z "${INSIDE_XVFB:-}" ]; then
    INSIDE_XVFB=1 LIBGL_ALWAYS_SOFTWARE=1 exec xvfb-run -a -s "-screen 0 800x600x24 -noreset" bash "$0" "$@"
fi
check=$1 program=$2 render=$3 scene=$4
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
picture() { # name arguments
    local name=$1
    shift
    "$program" --frames 1 --picture "$name.ppm" "$@" || { echo "order.sh: $name: exit code $?" >&2; exit 1; }
}
if ! "$render" -t raytrace --samples 128 -s 640x480 --eye 2.2,2.4,3.6 --target 0,0.4,0 --fov 45.8366 --radius 0.8 \
    --ao truth.pfm "$scene" 2>log; then
    grep -q -i embree log || { cat log >&2; exit 1; }
    echo "order.sh: skipped: no ray tracer (Debian and Ubuntu: apt install libembree-dev)"
    exit 77
fi
picture truth --truth truth.pfm
picture before-glass
picture by-opacity --apply glass --strength opacity
picture kept-out --apply glass --strength none
picture after-glass --apply glass
"$check" --nearest truth.ppm before-glass.ppm kept-out.ppm after-glass.ppm
"$check" --nearest truth.ppm by-opacity.ppm kept-out.ppm
picture tone-mapping --apply tone-mapping --strength opacity
"$check" --nearest truth.ppm by-opacity.ppm tone-mapping.ppm
picture fog-truth --truth truth.pfm --fog
picture before-fog --fog
picture after-fog --fog --apply fog --strength opacity
"$check" --nearest fog-truth.ppm before-fog.ppm after-fog.ppm
echo "order: good"
