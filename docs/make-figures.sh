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
set -euo pipefail
[ $# -ge 3 ] || { sed -n 3,12p "$0"; exit 2; }
name=$1 build=$(realpath "$2") scenes=$3
docs=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
root=$(dirname "$docs")
data=$docs/data/$name
work=$root/out/figures-$name
read -ra options <<<"${OPTIONS:-}"
peers=()
[ $# -lt 4 ] || peers=(--peers "$4")
mkdir -p "$data" "$work"
export PATH=$build/tests/bench:$build/examples/render:$PATH
cd "$root"

glssao-bench --scenes "$scenes" "${peers[@]}" --frames 2 --sequence-frames 4 --split-seeds 6 --oracle-step 8 --out "$work" "${options[@]}"
glssao-bench --bent --scenes "$scenes" --out "$work" "${options[@]}"
# Views that no constant was chosen on.
glssao-bench --scenes "$scenes" --all-views --pick courtyard-2,interior-2,drive-2,ship-2,house-2,town-2,blend-mode \
  --only rays,horizon-high,horizon-ultra --frames 0 --sequence-frames 0 --split-seeds 0 --out "$work/others" "${options[@]}"
glssao-economy --scenes "$scenes" --time-size 1280x720 --frames 2 --time-scene columns --check --out "$work" "${options[@]}"
glssao-cost --frames 3 --out "$work" "${options[@]}"
FRAMES=${FRAMES:-8} "$docs/make-performance.sh" "$work" "$build"
cp "$work"/*.tsv "$data"
mkdir -p "$data-others"
cp "$work/others/"{accuracy,scenes}.tsv "$data-others"
[ -z "${MEASURE_ONLY:-}" ] || exit 0

# Of a built-in scene, which needs no credit, and of the worst places of all scenes.
cp "$work/strip-columns-horizon.png" "$docs/pictures/accuracy-horizon.png"
cp "$work/worst-horizon.png" "$docs/pictures/worst-horizon.png"
python3 "$root/tests/bench/pages/make.py" "$docs/data" "$docs"
