#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# make-performance.sh NAME BINARIES [SIZE...]: writes docs/performance-NAME.md: frames and passes by fragment and by compute
# shaders at each size (1920x1080 if none is given), and the least that a pass can take. BINARIES: the folder that holds
# glssao-bench and glssao-bandwidth; FRAMES in the environment: how many are timed, 60 if it is not there.
set -euo pipefail
name=$1 binaries=$2
shift 2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
frames=${FRAMES:-60}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
levels=horizon-low,horizon-medium,horizon-high,horizon-ultra

passes() { # path, size
    "$binaries/glssao-bench" --context egl --pick steps --size 160x90 --rays 16 --split-seeds 0 --frames "$frames" --time-size "$2" \
        --only "classic-high,$levels" --path "$1" --cache "$work/cache" --out "$work/out" 2>/dev/null |
        awk -v way="$1" '
            $1 !~ /^(classic-high|horizon-(low|medium|high|ultra))$/ { next }
            {
                split("", ms)
                for (i = 4; i < NF; i += 2)
                    ms[$i] = $(i + 1)
                printf "| %s | %s | %s |", $1, way, $2
                for (i = 1; i <= split("distance estimate blur upsample", pass, " "); i++)
                    printf " %s |", pass[i] in ms ? ms[pass[i]] : ""
                print ""
            }'
}

{
    echo "# Passes, measured ($name)"
    echo
    echo "Written by \`docs/make-performance.sh $name BINARIES${*:+ $*}\`; [performance.md](performance.md) says what they mean."
    for size in "${@:-1920x1080}"; do
        echo
        echo "## $size, scene \`steps\`, depth and normals given"
        echo
        echo "Milliseconds, median of $frames frames; the frame without timers about its passes, which hold it up."
        echo
        echo "| level | shaders | frame | distance | estimate | blur | upsample |"
        echo "|---|---|---|---|---|---|---|"
        passes fragment "$size"
        passes compute "$size"
    done
    echo
    echo "## The least that a pass can take"
    echo
    echo "\`glssao-bandwidth egl\`: maps copied texel by texel, to and fro, sizes of 1920x1080."
    echo
    "$binaries/glssao-bandwidth" egl
} >"$here/performance-$name.md"
