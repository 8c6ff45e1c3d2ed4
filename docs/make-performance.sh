#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# make-performance.sh FOLDER BUILD [SIZE...]: writes FOLDER/passes.tsv, frames and passes by fragment and by compute shaders at
# each size (1920x1080 if none is given), and FOLDER/bandwidth.tsv, the least that a pass can take. BUILD: the build folder.
# FRAMES in the environment: how many are timed, 20 by default. LEVELS there: not all levels, but these.
set -euo pipefail
[ $# -ge 2 ] || { sed -n 3,5p "$0"; exit 2; }
folder=$1 build=$(realpath "$2")
shift 2
command="docs/make-performance.sh FOLDER BUILD${*:+ $*}"
frames=${FRAMES:-20}
bench=$build/tests/bench
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$folder"
levels=${LEVELS:-classic-high horizon-low horizon-medium horizon-high horizon-ultra}
# On a software rasteriser glssao-cost times these.
alone="horizon-low-depth horizon-medium-depth horizon-high-depth horizon-ultra-depth"

"$bench/glssao-bandwidth" egl $((frames < 7 ? frames : 7)) >"$work/bandwidth"
renderer=$(head -n 1 "$work/bandwidth")
head() { # the columns' names
    printf '# %s\n# context=%s\tsoftware=%d\tframes=%d\n' "$command" "$renderer" "$software" "$frames"
    local IFS=$'\t'
    echo "$*"
}

# On a GPU: frames without timers about their passes, which delay them; passes from timers.
measured() { # path, size
    "$bench/glssao-bench" --context egl --pick steps --size 160x90 --rays 16 --most-rays 0 --sequence-frames 0 --split-seeds 0 \
        --frames "$frames" --time-size "$2" --only "${levels// /,},${alone// /,}" \
        --path "$1" --cache "$work/cache" --out "$work/out" 2>/dev/null
    awk -F '\t' -v levels="$levels $alone" -v way="$1" -v size="$2" '
        BEGIN { split(levels, list, " "); for (i in list) wanted[list[i]] = 1 }
        !/^#/ && !("median_ms" in column) { for (i = 1; i <= NF; i++) column[$i] = i; next }
        $1 in wanted && $column["median_ms"] != "" {
            print $1 "\t" way "\t" size "\t" $column["median_ms"] "\t" $column["normals_ms"] "\t" \
                $column["distance_ms"] "\t" $column["estimate_ms"] "\t" $column["blur_ms"] "\t" $column["upsample_ms"]
        }' "$work/out/accuracy.tsv"
}

# On a software rasteriser timer queries mean nothing: glssao-render finishes after each pass, and the frame is their sum.
rendered() { # path, size
    local level
    for level in $levels; do
        "$build/examples/render/glssao-render" --context egl --scene steps -s "$2" -t "${level%-*}" -q "${level#*-}" --set tiles=off \
            --path "$1" --bench "$frames" -o "$work/picture.png" 2>/dev/null |
            awk -v level="$level" -v way="$1" -v size="$2" '
                /, GPU +median/ { name = $1; sub(",", "", name); ms[name] = $4; sum += $4 }
                END { print level "\t" way "\t" size "\t" sum "\t\t" ms["distance"] "\t" ms["estimate"] "\t" ms["blur"] "\t" ms["upsample"] }'
    done
}

software=0 measure=measured
if [[ $renderer == *llvmpipe* || $renderer == *softpipe* ]]; then
    software=1 measure=rendered
fi
{
    head level shaders size frame normals distance estimate blur upsample
    for size in "${@:-1920x1080}"; do
        $measure fragment "$size"
        $measure compute "$size"
    done
} >"$folder/passes.tsv"
{
    head what how ms gb_per_s
    awk -F ' *[|] *' 'NF == 6 && $4 + 0 > 0 { print $2 "\t" $3 "\t" $4 "\t" $5 }' "$work/bandwidth"
} >"$folder/bandwidth.tsv"
