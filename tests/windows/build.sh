#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# build.sh SOURCE BUILD: cross-compiles the library, static and shared, and its WGL test with mingw-w64. A warning
# fails. Skips where there is no mingw-w64.
set -euo pipefail
source=$1 build=$2
command -v x86_64-w64-mingw32-gcc-win32 >/dev/null || command -v x86_64-w64-mingw32-gcc >/dev/null || {
    echo "build.sh: skipped: no mingw-w64 (Debian and Ubuntu: apt install gcc-mingw-w64-x86-64-win32)"
    exit 77
}
for kind in static shared; do
    cmake -S "$source/tests/windows/project" -B "$build/$kind" -G Ninja --toolchain "$source/.ci/mingw-w64.cmake" \
        -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS="$([ $kind = shared ] && echo ON || echo OFF)" "-DSOURCE=$source" \
        >/dev/null
    cmake --build "$build/$kind" -j2
done
