#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# files.sh GLSSAO_RENDER EVERY SCENES [FILE.glb]: each scene in SCENES and every EVERY-th file below SCENES/invalid either renders (exit 0,
# a picture) or is refused (exit 1, one line on stderr that names it, no picture). Skips (77) where the folder is absent.
set -uo pipefail
render=$1
every=$2
scenes=$3
engine=${4:-}
if [ ! -d "$scenes" ]; then
    echo "skipped: no folder $scenes"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
rendered=0 refused=0 failures=0
number=0
while IFS= read -r -d '' file; do
    case $file in "$scenes"/invalid/*) number=$((number + 1)) && [ $((number % every)) = 0 ] || continue ;; esac
    rm -f "$work/out.png"
    for _ in 1 2 3; do # LeakSanitizer itself can fail where a thread ends as it looks: no finding, so again
        timeout 60 "$render" -s 32x18 -o "$work/out.png" "$file" >"$work/out" 2>"$work/err"
        code=$?
        grep -q 'LeakSanitizer has encountered a fatal error' "$work/err" || break
    done
    lines=$(grep -cv '^context: ' "$work/err")
    if [ $code = 0 ] && [ -s "$work/out.png" ]; then
        rendered=$((rendered + 1))
    elif [ $code = 1 ] && [ "$lines" = 1 ] && [ ! -e "$work/out.png" ] &&
        tail -n 1 "$work/err" | grep -qF -- "$(basename -- "$file")"; then
        refused=$((refused + 1))
    else
        failures=$((failures + 1))
        echo "FAILED: $file: exit $code, $lines lines"
        sed 's/^/    /' "$work/err"
    fi
done < <(find "$scenes" "$scenes/invalid" \( -path "$scenes/*/*/*" ! -path "$scenes/invalid/*" \) -prune -o \
    \( -name '*.gltf' -o -name '*.glb' \) -print0 | sort -zu)
if [ -n "$engine" ] && ! "$render" -s 320x180 -o "$work/engine.png" "$engine" 2>"$work/err"; then
    failures=$((failures + 1))
    cat "$work/err"
fi
echo "$rendered rendered, $refused refused, $failures failures"
[ $failures = 0 ] && [ $rendered -gt 0 ] && [ $refused -gt 0 ]
