#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# quickstart.sh [scene.gltf|scene.glb]: installs what is missing (Debian, Ubuntu), builds into build/, and renders the
# built-in scene, and the given one, into out/: without occlusion, with it, and the occlusion alone.
set -euo pipefail
scene=${1:+$(realpath -- "$1")}
cd "$(dirname "${BASH_SOURCE[0]}")/.."

./third_party/install-packages.sh build
cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DGLSSAO_BUILD_TESTS=OFF >/dev/null
cmake --build build

render=build/examples/render/glssao-render
mkdir -p out
pictures() { # name, then the scene's arguments
    local name=out/$1
    shift
    "$render" --no-ao -o "$name-off.png" "$@"
    "$render" -o "$name-on.png" --ao "$name-ao.png" "$@"
    echo "$name-off.png  $name-on.png  $name-ao.png"
}
pictures columns
if [ -n "$scene" ]; then
    name=$(basename -- "$scene")
    pictures "${name%.*}" -- "$scene"
fi
