#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# subdirectory.sh SOURCE CC: add_subdirectory and FetchContent from a local path, in a project that knows C alone; and
# add_subdirectory in a project that compiles its sources in one unit.
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/common.sh"
source=$1
export CC=$2
cp -r "$here/cmake/." "$here/consumer.c" "$scratch"
cd "$scratch"
for way in add_subdirectory fetch_content; do
    quietly cmake -S . -B "$way" -G Ninja -DWAY=$way "-DGLSSAO=$source" -DCMAKE_INSTALL_PREFIX="$scratch/prefix-$way"
    quietly cmake --build "$way" -j2
    quietly "$way/consumer"
    # The host's own choices stay the host's.
    grep -q '^CMAKE_BUILD_TYPE:STRING=$' "$way/CMakeCache.txt" || fail "$way sets the host's build type"
    quietly cmake --install "$way"
    [ ! -e "$scratch/prefix-$way" ] || fail "$way installs into the host's prefix: $(find "$scratch/prefix-$way" -type f)"
done
quietly cmake -S . -B unity -G Ninja -DWAY=add_subdirectory "-DGLSSAO=$source" -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=0
quietly cmake --build unity -j2
quietly unity/consumer
