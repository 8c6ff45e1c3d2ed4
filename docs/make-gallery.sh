#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# make-gallery.sh GLSSAO_RENDER SCENES GLSSAO_BENCH: makes docs/gallery.md and its pictures in docs/pictures/gallery. SCENES is the
# folder of test scenes; credit for each stands in the page. Needs ImageMagick's convert, and a glssao-render with Embree.
set -euo pipefail
[ $# = 3 ] || { sed -n 3,4p "$0"; exit 2; }
render=$(realpath "$1")
scenes=$(realpath "$2")
bench=$(realpath "$3")
docs=$(dirname "$(realpath "$0")")
out=$docs/pictures/gallery
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

page=$docs/gallery.md
cat >"$page" <<'PAGE'
# Gallery

Each strip shows a scene without occlusion, with it (the default: horizon, high), and with ray-traced accessibility (512 rays a
pixel). Only ambient light differs. `docs/make-gallery.sh` renders them at twice the size shown.
PAGE

strip() { # name, title, credit, options of glssao-render...
    local name=$1 title=$2 credit=$3
    shift 3
    "$render" -s 640x480 --no-ao -o "$work/off.png" "$@"
    "$render" -s 640x480 -o "$work/on.png" "$@"
    "$render" -s 640x480 -t raytrace -o "$work/truth.png" "$@"
    convert "$work/off.png" "$work/on.png" "$work/truth.png" +append -resize 50% -quality 88 -strip "$out/$name.jpg"
    printf '\n## %s\n\n%s\n\n![%s: off, on, ray-traced](pictures/gallery/%s.jpg)\n' "$title" "$credit" "$title" "$name" >>"$page"
}

strip columns "Columns" "Built in. Radius 0.5." --scene columns --eye 3,4,-9 --target 0,1,-1
strip steps "Steps" "Built in. Radius 0.5." --scene steps --radius 0.5
strip garage "Garage" "By Brandon Jones and others, CC BY 3.0. Radius 0.5 m." --eye 0.5,1.6,1.5 --target -0.5,0.9,-3 --fov 70 \
    --radius 0.5 "$scenes/garage-interior/garage.gltf"
strip courtyard "Courtyard" "From godot-demo-projects, CC BY 4.0. Radius 3." --eye 0,-2,0 --target 20,-3,10 --fov 65 --radius 3 \
    "$scenes/zdm2-courtyard/zdm2.glb"
strip hermes "Hermes" "Three D Scans, no copyright claimed; retopology by Keijiro Takahashi. Radius 0.15 m." --eye 1.1,1.1,1.9 \
    --target 0,0.8,0 --fov 44 --radius 0.15 "$scenes/hermes-scan/hermes.glb"
strip helmet "Flight Helmet" "Donated by Microsoft for glTF testing, converted by Gary Hsu, CC0. Radius 0.06 m." \
    --eye 0.35,0.5,0.8 --target -0.02,0.36,0.02 --radius 0.06 "$scenes/flight-helmet/FlightHelmet.gltf"
strip ship "Dutch ship" "Poly Haven, CC0. Radius 1 m." --eye 9,7,9 --target 1,3.5,0 --radius 1 \
    "$scenes/dutch-ship/dutch_ship_medium_1k.gltf"
strip drive "Cycloidal drive" "By Michael Dawson-Haggerty, MIT. Radius 6 mm." --eye 60,70,75 --target 0,0,-14 --fov 42 --radius 6 \
    "$scenes/cycloidal-drive/cycloidal.glb"
strip mannequin "Mannequiny" "By GDQuest and contributors, CC BY 4.0. Radius 0.2 m." --eye 1.2,1.5,2.4 --target 0,0.9,0 \
    --radius 0.2 "$scenes/mannequin-skinned/mannequiny.glb"

cat >>"$page" <<'PAGE'

## Bent normals

A matte surface above, a glossy one below, under a dim sky with one lamp: lit by accessibility alone, by bent normals as
`glssao-render --bent-normals` does, and by rays (HIGH, `glssao-bench --bent`; [accuracy-bent.md](accuracy-bent.md) has the errors).
PAGE
"$bench" --bent --scenes "$scenes" --pick steps,zdm2,hermes --size 640x360 --rays 256 --cache "$work/cache" --out "$work/bent"
for name in steps:Steps zdm2-courtyard:Courtyard hermes-scan:Hermes; do
    convert "$work/bent/bent-${name%%:*}.png" -resize 50% -quality 88 -strip "$out/bent-${name%%:*}.jpg"
    printf '\n![%s: accessibility, bent normals, ray-traced](pictures/gallery/bent-%s.jpg)\n' "${name#*:}" "${name%%:*}" >>"$page"
done
