#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# presets.sh SOURCE: every configure preset configures; the one for Windows where mingw-w64 is there.
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$1"
mapfile -t presets < <(cmake --list-presets | sed -n 's/^ *"\(.*\)" .*/\1/p')
[ "${presets[*]}" = "release debug sanitize windows" ] || fail "presets: ${presets[*]}"
for preset in "${presets[@]}"; do
    [ "$preset" != windows ] || command -v x86_64-w64-mingw32-gcc >/dev/null || continue
    quietly cmake --preset "$preset" -B "$scratch/$preset"
done
