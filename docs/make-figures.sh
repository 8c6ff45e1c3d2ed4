#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# make-figures.sh NAME BUILD SCENES [NODE_MODULES]: measures everything that docs says in figures on this machine, into
# docs/data/NAME, and fills the pages and charts. BUILD: the build folder.
# SCENES: the folder of test scenes. NODE_MODULES: the folder of the peers, from
#     npm install three n8ao postprocessing @babylonjs/core
# Traced truths and the peers' recordings are kept in out/bench-cache for the next run. More options for glssao-bench,
# glssao-economy and glssao-cost come from OPTIONS in the environment, for instance a smaller size. Needs gnuplot and python3;
# with MEASURE_ONLY=1 neither, and the pages are filled later, by
#     python3 tests/bench/pages/make.py docs/data docs
# A machine without node takes the recordings in out/bench-cache/peers-* of another one as NODE_MODULES. They are for one --size and
# --time-size; glssao-bench --record with these, --scenes and --peers makes them without measuring.
# make-figures.sh --quick BUILD FOLDER: the same with built-in scenes at a small size, into pages and data in FOLDER. Tests run it.
set -euo pipefail
[ $# -ge 3 ] || { sed -n 3,13p "$0"; exit 2; }
name=$1 build=$(realpath "$2")
docs=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
root=$(dirname "$docs")
read -ra options <<<"${OPTIONS:-}"
scenes=(--scenes "$3") others=courtyard-2,interior-2,drive-2,ship-2,house-2,town-2,blend-mode
moves=(--pick "columns,garage,dutch-ship,zdm2,cycloidal" --size 480x270 --rays 128 --sequence-frames 32)
peers=() cheap=() sizes=() work=$root/out/figures-$name
[ $# -lt 4 ] || peers=(--peers "$4")
if [ "$name" = --quick ]; then
    name=llvmpipe scenes=() others=columns moves=(--pick columns --rays 16 --sequence-frames 32) cheap=(--pick columns) sizes=(160x90)
    mkdir -p "$3"
    work=$(realpath "$3")
    options+=(--quick --check --size 160x90 --time-size 160x90 --frames 2 --split-seeds 4 --cache "$work/cache")
    export LEVELS=horizon-low FRAMES=1
    command -v gnuplot >/dev/null || MEASURE_ONLY=1
    rm -rf "$work/docs"
    mkdir -p "$work/docs/pictures"
    cp "$docs"/*.md "$work/docs"
    docs=$work/docs
fi
data=$docs/data/$name
mkdir -p "$data" "$work"
export PATH=$build/tests/bench:$build/examples/render:$PATH
cd "$root"

glssao-bench --bent "${scenes[@]}" --out "$work" "${options[@]}" "${cheap[@]}"
glssao-bench "${scenes[@]}" "${peers[@]}" --frames 2 --sequence-frames 4 --split-seeds 6 --oracle-step 8 --out "$work" "${options[@]}"
# Views that no constant was chosen on.
glssao-bench "${scenes[@]}" --all-views --only rays,horizon-high,horizon-ultra --out "$work/others" "${options[@]}" --pick "$others" \
  --frames 0 --sequence-frames 0 --split-seeds 0
glssao-economy "${scenes[@]}" --time-size 1280x720 --frames 2 --time-scene columns --check --out "$work" "${options[@]}" "${cheap[@]}"
glssao-motion "${scenes[@]}" --only low,high,ultra,rays --out "$work" "${options[@]}" "${moves[@]}" >"$work/motion.tsv"
glssao-cost --frames 3 --out "$work" "${options[@]}"
FRAMES=${FRAMES:-8} "$root/docs/make-performance.sh" "$work" "$build" "${sizes[@]}"
cp "$work"/*.tsv "$data"
mkdir -p "$data-others"
cp "$work/others/"{accuracy,scenes}.tsv "$data-others"
[ -z "${MEASURE_ONLY:-}" ] || exit 0

# Of a built-in scene, which needs no credit, and of the worst places of all scenes.
cp "$work/strip-columns-horizon.png" "$docs/pictures/accuracy-horizon.png"
cp "$work/worst-horizon.png" "$docs/pictures/worst-horizon.png"
if [ "$1" != --quick ]; then
    python3 "$root/tests/bench/pages/make.py" "$docs/data" "$docs"
else
    python3 "$root/tests/bench/pages/make.py" "$docs/data" "$docs" 2>&1 | tee "$work/pages.log"
    # There are no peers and no scenes for judging, and a plane of so few pixels has no frame change.
    if grep 'llvmpipe.* keeps' "$work/pages.log" | grep -v 'block peers\|block beaten\| judging \| frame_change '; then
        exit 1
    fi
fi
