#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# make-stability-pictures.sh: makes the picture pairs of docs/stability.md into docs/pictures: as the library is, and from a copy
# of the repository without the guards concerned (their lines in tests/stability/guards.tsv).
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cp -r "$root"/{CMakeLists.txt,LICENSE,glsl,lib,tests,examples,third_party,docs,README.md,CHANGELOG.md} "$copy"
draw() { # name
    cmake -S "$copy" -B "$copy/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo >/dev/null
    ninja -C "$copy/build" stability_pictures >/dev/null
    GLSSAO_TEST_CONTEXT=egl "$copy/build/tests/stability/stability_pictures" "$1" "$copy" >/dev/null
}
draw guarded
for guard in "horizon: what depth can't tell" "mirrored projections turn rebuilt normals" "sky is not mixed into distances"; do
    IFS=$'\t' read -r _ file text instead _ < <(grep "^$guard" "$root/tests/stability/guards.tsv")
    TEXT=$text INSTEAD=$instead perl -0pi -e 's/\Q$ENV{TEXT}\E/$ENV{INSTEAD}/' "$copy/$file"
done
draw naive
for name in coarse-depth mirrored sky-of-0; do
    cp "$copy/$name-guarded.png" "$root/docs/pictures/stability-$name-guarded.png"
    cp "$copy/$name-naive.png" "$root/docs/pictures/stability-$name-naive.png"
done
