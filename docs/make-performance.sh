#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# make-performance.sh NAME BINARIES [SIZE...]: writes docs/performance-NAME.md: frames and passes by fragment and by compute
# shaders at each size (1920x1080 if none is given), and the least that a pass can take. BINARIES: the folder that holds
# glssao-bench, glssao-bandwidth and glssao-render, which is asked on a software rasteriser; FRAMES in the environment: how
# many are timed, 60 if it is not there.
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

# On a software rasteriser glssao-bench knows no passes; there the frame is their sum.
rendered() { # path, size
    local level technique quality
    for level in "classic high" "horizon low" "horizon medium" "horizon high" "horizon ultra"; do
        read -r technique quality <<<"$level"
        "$binaries/glssao-render" --context egl --scene steps -s "$2" -t "$technique" -q "$quality" --set tiles=off --path "$1" \
            --bench "$frames" -o "$work/picture.png" 2>/dev/null |
            awk -v level="$technique-$quality" -v way="$1" '
                /, GPU +median/ {
                    name = $1
                    sub(",", "", name)
                    ms[name] = $4
                    sum += $4
                }
                END {
                    printf "| %s | %s | %.1f |", level, way, sum
                    for (i = 1; i <= split("distance estimate blur upsample", pass, " "); i++)
                        printf " %s |", pass[i] in ms ? sprintf("%.1f", ms[pass[i]]) : ""
                    print ""
                }'
    done
}

"$binaries/glssao-bandwidth" egl >"$work/bandwidth"
measure=passes how="the frame without timers about its passes, which hold it up"
if grep -q -e llvmpipe -e softpipe "$work/bandwidth"; then
    measure=rendered how="\`glssao-render --bench\`, tiles off${LP_NUM_THREADS:+, LP_NUM_THREADS=$LP_NUM_THREADS}; the frame is the sum of its passes"
fi
{
    echo "# Passes, measured ($name)"
    echo
    echo "Written by \`docs/make-performance.sh $name BINARIES${*:+ $*}\`; [performance.md](performance.md) says what they mean."
    for size in "${@:-1920x1080}"; do
        echo
        echo "## $size, scene \`steps\`, depth and normals given"
        echo
        echo "Milliseconds, median of $frames frames; $how."
        echo
        echo "| level | shaders | frame | distance | estimate | blur | upsample |"
        echo "|---|---|---|---|---|---|---|"
        $measure fragment "$size"
        $measure compute "$size"
    done
    echo
    echo "## The least that a pass can take"
    echo
    echo "\`glssao-bandwidth egl\`: maps copied texel by texel, to and fro, sizes of 1920x1080."
    echo
    cat "$work/bandwidth"
} >"$here/performance-$name.md"
