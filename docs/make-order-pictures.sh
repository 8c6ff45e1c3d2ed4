#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# make-order-pictures.sh BUILD: makes docs/pictures/order-*.png, which integration.md shows: occlusion applied at each place of
# a frame, by dropin-order, and with ray-traced occlusion. Needs a display, and ImageMagick.
set -euo pipefail
[ $# = 1 ] || { sed -n 3,4p "$0"; exit 2; }
build=$(realpath "$1")
docs=$(dirname "$(realpath "$0")")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
"$build/examples/render/glssao-render" -t raytrace --samples 4096 -s 640x480 --eye 2.2,2.4,3.6 --target 0,0.4,0 \
    --fov 45.8366 --radius 0.8 --ao truth.pfm "$docs/../examples/dropin/order.gltf"
panel() { # name arguments
    local name=$1
    shift
    "$build/examples/dropin/dropin-order" --frames 1 --picture "$name.ppm" "$@"
    convert "$name.ppm" -crop 560x420+80+20 -resize 320x240 "$docs/pictures/order-$name.png"
}
panel truth --truth truth.pfm
panel before-glass
panel after-glass --apply glass
panel kept-out --apply glass --strength none
panel by-opacity --apply glass --strength opacity
panel tone-mapping --apply tone-mapping --strength opacity
panel before-fog --fog
panel after-fog --apply fog --fog --strength opacity
