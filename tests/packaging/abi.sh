#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# abi.sh SOURCE CC: the shared library against the last release's (the newest tag v*, built from its own sources): what
# changed in functions, structures and enumerations. Fails where a program that was linked with the release would break
# and the version does not say so; before 1.0 a new minor version may. Skips where there is no release yet.
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
source=$1
export CC=$2
release=$(git -C "$source" tag --list 'v[0-9]*' --sort=-version:refname 2>/dev/null | head -n 1) || true
[ -n "$release" ] || skip "no tag v* here, so no release to compare with"
command -v abidiff >/dev/null || skip "no abidiff (Debian and Ubuntu: apt install abigail-tools)"
version() { sed -n "s/^#define GLSSAO_VERSION_$2 //p" "$1/lib/include/glssao/glssao.h"; }
mkdir "$scratch/old"
git -C "$source" archive "$release" | tar -x -C "$scratch/old"
for which in old new; do
    tree=$([ $which = old ] && echo "$scratch/old" || echo "$source")
    quietly cmake -S "$tree" -B "$scratch/build-$which" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DBUILD_SHARED_LIBS=ON \
        -DGLSSAO_BUILD_EXAMPLES=OFF -DGLSSAO_BUILD_TESTS=OFF
    quietly cmake --build "$scratch/build-$which"
done
old=$scratch/old/lib/include new=$source/lib/include
status=0
abidiff --headers-dir1 "$old" --headers-dir2 "$new" "$scratch/build-old/lib/libglssao.so" "$scratch/build-new/lib/libglssao.so" ||
    status=$?
echo "$release against the tree: abidiff says $status"
[ $((status & 3)) = 0 ] || fail "abidiff failed"
# Bit 4: something changed; bit 8: what programs rely on is gone. A changed structure is both here: hosts hold them.
changed=$(abidiff --no-added-syms --headers-dir1 "$old" --headers-dir2 "$new" "$scratch/build-old/lib/libglssao.so" \
    "$scratch/build-new/lib/libglssao.so" >/dev/null && echo 0 || echo 1)
major=$(version "$scratch/old" MAJOR) minor=$(version "$scratch/old" MINOR)
if [ "$changed" = 1 ] && [ "$(version "$source" MAJOR)" = "$major" ] && { [ "$major" -gt 0 ] || [ "$(version "$source" MINOR)" = "$minor" ]; }; then
    fail "the interface changed since $release: raise the version"
fi
