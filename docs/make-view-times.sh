#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# make-view-times.sh GLSSAO_VIEW SCENES: writes docs/data/view-times.tsv: for every scene in the folder, how long the viewer
# takes to start and to draw a frame at 1280x720 while the camera turns. Needs xvfb-run and xdotool.
#   first picture, with occlusion   from the start of the window system, with Mesa's shader cache filled
#   frame                           median while the camera turns: pre-pass, occlusion and main pass
set -euo pipefail
[ $# = 2 ] || { sed -n 3,4p "$0"; exit 2; }
if [ -z "${INSIDE_XVFB:-}" ]; then
    INSIDE_XVFB=1 LIBGL_ALWAYS_SOFTWARE=1 exec xvfb-run -a -s "-screen 0 1280x800x24 -noreset" bash "$0" "$@"
fi
view=$(realpath "$1")
scenes=$(realpath "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
table=$(dirname "$(realpath "$0")")/data/view-times.tsv
model=$(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -n 1)
{
    echo "# docs/make-view-times.sh: glssao-view at 1280x720 on llvmpipe, $(nproc) cores (${model:-unknown})," \
        "load average $(cut -d ' ' -f 1 /proc/loadavg), horizon high, Mesa's shader cache filled"
    printf 'scene\tfirst picture, ms\twith occlusion, ms\tframe, ms\tcolumns = 1\n'
} >"$table"
columns=
row() { # name, arguments
    local name=$1 window= first occluded frame pid
    shift
    "$view" -s 1280x720 "$@" 2>"$work/err" >/dev/null &
    pid=$!
    for _ in $(seq 600); do # the scene's name is the title once the picture is whole
        window=$(xdotool search --onlyvisible --name "^$(basename "${*: -1}" | sed 's/[.]/\\./g')\$" 2>/dev/null | head -n 1) || true
        [ -n "$window" ] && break
        kill -0 $pid 2>/dev/null || break
        sleep 0.1
    done
    if [ -n "$window" ]; then
        xdotool mousemove 900 400 windowfocus "$window" key --repeat 24 --delay 60 Left
        sleep 0.5
        xdotool key ctrl+q
    fi
    wait $pid || true
    read -r first occluded frame < <(sed -n 's/.*shown after \([0-9]*\) ms, with occlusion after \([0-9]*\) ms.*takes \([0-9.]*\) ms$/\1 \2 \3/p' "$work/err") || true
    [ -n "${frame:-}" ] || { echo "$name: $(head -n 1 "$work/err")" >&2; return 0; }
    columns=${columns:-$frame}
    printf '%s\t%s\t%s\t%s\t%s\n' "$name" "$first" "$occluded" "$frame" \
        "$(awk "BEGIN {printf \"%.2f\", $frame / $columns}")" >>"$table"
}
for name in columns cornell steps plane; do # once without being counted, so that the cache is filled
    [ -n "$columns" ] || { "$view" -s 64x64 --scene columns >/dev/null 2>&1 & sleep 5; kill $! 2>/dev/null || true; wait || true; }
    row "$name (built in)" --scene $name
done
while read -r file; do
    row "${file#"$scenes"/}" "$file"
done < <(find "$scenes" -mindepth 2 -maxdepth 2 \( -name '*.glb' -o -name '*.gltf' \) -not -path '*/invalid/*' | sort)
