#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# make-peer-check.sh BUILD SCENES NODE_MODULES: makes docs/pictures/peers-check.png and docs/data/peers-check.tsv. For each peer
# the picture has the recording as glssao-bench replays it, left, and the package's own renderer in headless Chromium, right.
# Needs chromium and ImageMagick's convert and compare.
set -euo pipefail
[ $# = 3 ] || { sed -n 3,6p "$0"; exit 2; }
command="docs/make-peer-check.sh BUILD SCENES NODE_MODULES"
build=$(realpath "$1") scenes=$(realpath "$2") modules=$(realpath "$3")
docs=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
peers=$docs/../tests/bench/peers
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
width=480 height=270
list="three-gtao three-ssao three-sao n8ao postprocessing-ssao babylon-ssao2"

"$build/tests/bench/glssao-bench" --peers "$modules" --scenes "$scenes" --pick cornell-box --only "${list// /,}" --most-rays 0 --rays 16 \
    --size ${width}x$height --split-seeds 0 --frames 0 --sequence-frames 0 --cache "$work/cache" --out "$work" 2>/dev/null
node "$peers/browser.mjs" "$modules" "$scenes/extra-cornell-box/cornellBox.glb" "$work"/cache/peers-*/jobs.tsv "$work"
rows=()
{
    printf '# %s\npeer\trms_difference\n' "$command"
    for peer in $list; do
        # The middle panel of the strip, at half the size; sky, which the panel paints, is left out at both sides.
        convert "$work/strip-cornell-box-$peer.png" -crop "$((width / 2 - 60))x$((height / 2))+$((width / 2 + 4 + 30))+0" +repage "$work/a.png"
        convert "$work/$peer.png" -filter box -resize "$((width / 2))x" -crop "$((width / 2 - 60))x$((height / 2))+30+0" +repage "$work/b.png"
        difference=$(compare -metric RMSE "$work/a.png" "$work/b.png" null: 2>&1 || true)
        printf '%s\t%s\n' "$peer" "$(sed 's/.*(\(.*\))/\1/' <<<"$difference")"
        convert "$work/a.png" "$work/b.png" +append "$work/row-$peer.png"
        rows+=("$work/row-$peer.png")
    done
} >"$docs/data/peers-check.tsv"
convert "${rows[@]}" -bordercolor white -border 2 -append -depth 8 "$docs/pictures/peers-check.png"
cat "$docs/data/peers-check.tsv"
