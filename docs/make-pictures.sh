#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# make-pictures.sh GLSSAO_RENDER SCENES: makes the pictures of README.md into docs/pictures. SCENES is the folder of test
# scenes; the garage in it is by Brandon Jones and others, CC BY 3.0 (credit in README.md).
set -euo pipefail
[ $# = 2 ] || { sed -n 3,4p "$0"; exit 2; }
render=$(realpath "$1")
garage=$(realpath "$2")/garage-interior/garage.gltf
out=$(dirname "$(realpath "$0")")/pictures
mkdir -p "$out"
view=(-s 960x540 --eye 0.5,1.6,1.5 --target -0.5,0.9,-3 --fov 70 --radius 0.5 "$garage")
"$render" --no-ao -o "$out/garage-off.png" "${view[@]}"
"$render" --power 2 -o "$out/garage-on.png" "${view[@]}" # contrast, so that a small picture tells
