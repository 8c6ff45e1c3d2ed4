#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# abi.sh [--record] SOURCE CC: compares the shared library's interface with the one recorded in abi.xml: functions, structures,
# enumerations and the soname. Any difference fails, so that none is made by accident. --record records the interface as it is
# now. Until 1.0 the soname holds major and minor version: raise the minor version if programs built with a release would break.
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
record=
if [ "$1" = --record ]; then
    record=1
    shift
fi
source=$1 recorded=$1/tests/packaging/abi.xml
export CC=$2
command -v abidw >/dev/null || skip "no abidw (Debian and Ubuntu: apt install abigail-tools)"
quietly cmake -S "$source" -B "$scratch/build" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DBUILD_SHARED_LIBS=ON \
    -DGLSSAO_BUILD_EXAMPLES=OFF -DGLSSAO_BUILD_TESTS=OFF
quietly cmake --build "$scratch/build" -j2
library=$scratch/build/lib/libglssao.so
if [ -n "$record" ]; then
    abidw --headers-dir "$source/lib/include" --drop-private-types --no-show-locs --no-comp-dir-path --no-corpus-path \
        --type-id-style hash --out-file "$scratch/abi.xml" "$library"
    sed "s|path='$(realpath "$source")/|path='|" "$scratch/abi.xml" >"$recorded"
    exit
fi
status=0
abidiff "$recorded" "$library" >"$scratch/difference" || status=$?
[ $status = 0 ] && exit
cat "$scratch/difference"
# Bit 8: what programs rely on is gone or has changed; bits 1 and 2: abidiff itself failed.
[ $((status & 3)) = 0 ] || fail "abidiff failed"
[ $((status & 8)) = 0 ] || echo "programs that were built with the recorded interface would break"
fail "the interface differs from tests/packaging/abi.xml; if that is meant, run: tests/packaging/abi.sh --record . ${CC##*/}"
