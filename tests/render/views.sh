#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# views.sh GLSSAO_RENDER: the views that fit the scene: equal margins, any --up, --view, --ortho, --camera none, turntables.
set -uo pipefail
render=$(realpath "$1")
cases=$(dirname "$(realpath "${BASH_SOURCE[0]}")")/../cases
# shellcheck source=tests/render/fail.sh
. "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/fail.sh"

# An L: 8 long, 1 deep, 3 high at one end, of two boxes; `rotation` as glTF writes it. It has a camera of its own.
corner() { for bit in 1 2 4; do [ $(($1 & bit)) = 0 ] && printf '\0\0\0\0' || printf '\0\0\200\77'; done; }
buffer=$({
    for k in 0 1 2 3 4 5 6 7; do corner $k; done
    for k in 0 4 6 0 6 2 1 3 7 1 7 5 0 1 5 0 5 4 2 6 7 2 7 3 0 2 3 0 3 1 4 5 7 4 7 6; do printf "\\$k"; done
} | base64 -w0)
make() { # file, rotation
    cat >"$1" <<GLTF
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 3]}],
 "nodes": [{"children": [1, 2], "rotation": [$2]}, {"mesh": 0, "scale": [8, 1, 1]},
           {"mesh": 0, "scale": [1, 2, 1], "translation": [7, 1, 0]}, {"camera": 0, "translation": [0, 0, 90]}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.6, "znear": 0.1}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]},
               {"bufferView": 1, "componentType": 5121, "count": 36, "type": "SCALAR"}],
 "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 36}],
 "buffers": [{"byteLength": 132, "uri": "data:application/octet-stream;base64,$buffer"}]}
GLTF
}
make y-up.gltf 0,0,0,1
make z-up.gltf 0.70710678,0,0,0.70710678

# take NAME ARGUMENTS...: writes the view distances of a picture to NAME.pfm.
take() {
    local name=$1
    shift
    "$render" -s 160x120 --depth "$name.pfm" "$@" >out 2>err || fail "$*: exit $?"
}
values() { # of a PFM of 160 x 120: a line a pixel, rows bottom to top
    tail -c $((160 * 120 * 4)) "$1" | od -An -v -tf4 -w4
}
# Left, right, bottom and top margin in pixels; nothing where nothing is seen.
margins() {
    values "$1.pfm" | awk '$1 > 0 { x = (NR - 1) % 160; y = int((NR - 1) / 160); n++
        if (n == 1 || x < l) l = x; if (x > r) r = x; if (n == 1 || y < b) b = y; if (y > t) t = y }
        END { if (n) print l, 159 - r, b, 119 - t }'
}
equal_margins() { # name: within two pixels, and one pair of 3 to 6
    read -r left right bottom top < <(margins "$1")
    [ $((left - right)) -ge -2 ] && [ $((left - right)) -le 2 ] && [ $((bottom - top)) -ge -2 ] && [ $((bottom - top)) -le 2 ] ||
        fail "$1: margins of $left and $right, $bottom and $top pixels"
    [ "$bottom" -le 6 ] || [ "$left" -le 6 ] || fail "$1: seen from too far off: $left, $bottom"
}
# The largest relative difference of two depth maps; "shape" if only one of them shows a surface at some pixel.
apart() {
    paste <(values "$1.pfm") <(values "$2.pfm") |
        awk '($1 > 0) != ($2 > 0) { s++ } $1 > 0 && $2 > 0 { d = ($1 - $2) / $1; d = d < 0 ? -d : d; if (d > m) m = d }
            END { print (s > 40) ? "shape" : (m > 0.001) ? m : "same" }'
}
same() { [ "$(apart "$1" "$2")" = same ] || fail "$1 and $2 differ: $(apart "$1" "$2")"; }
other() { [ "$(apart "$1" "$2")" != same ] || fail "$1 and $2 are the same"; }

take file y-up.gltf
take fitted --camera none y-up.gltf
other file fitted
equal_margins fitted
take fitted-z --camera none --up 0,0,1 z-up.gltf
same fitted fitted-z
take narrow --camera none --fov 10 y-up.gltf
equal_margins narrow
other fitted narrow

# Files: a flat one is framed by its vertices; one with z up is framed as its copy with y up, made by turning its JSON.
take flat --camera none "$cases/scale0.glb"
equal_margins flat
size=$(od -An -tu4 -j12 -N4 "$cases/zup.glb" | tr -d ' ')
buffer=$(tail -c +$((size + 29)) "$cases/zup.glb" | base64 -w0)
tail -c +21 "$cases/zup.glb" | head -c "$size" | sed "s/{\"mesh\": \([0-2]\)}/{\"mesh\": \1, \"rotation\": [-0.70710678, 0, 0, 0.70710678]}/g
    s|\"buffers\": \[{|&\"uri\": \"data:application/octet-stream;base64,$buffer\", |" >zup-turned.gltf
[ "$(grep -o '"rotation"' zup-turned.gltf | wc -l)" = 3 ] || fail "zup.glb has other nodes than it had"
take turned zup-turned.gltf
take zup --up 0,0,1 "$cases/zup.glb"
equal_margins zup
same turned zup
take zup-lying "$cases/zup.glb"
other zup-lying zup

# --view sees from there, whatever cameras the file has.
for view in front right back left top bottom iso -40,20 400,-90; do
    take "view$view" --view "$view" y-up.gltf
    equal_margins "view$view"
    take "ortho$view" --ortho --view "$view" y-up.gltf
    equal_margins "ortho$view"
    other "view$view" "ortho$view"
    take "view$view-z" --view "$view" --up 0,0,1 z-up.gltf
    same "view$view" "view$view-z"
done
take named --view 90,0 y-up.gltf
same named viewright
other viewfront viewback
# In parallel projection the front has the shape of what it shows: 8 wide and 3 high.
read -r left right bottom top < <(margins orthofront)
[ $((1000 * (120 - bottom - top) / (160 - left - right))) -gt 350 ] &&
    [ $((1000 * (120 - bottom - top) / (160 - left - right))) -lt 400 ] || fail "--ortho: $left $right $bottom $top"

# A turntable about --up shows the whole scene in each picture, and starts and ends at the same place.
take turn --frames 8 --camera none --up 0,0,1 z-up.gltf
take turn-y --frames 8 --camera none y-up.gltf
least=999
for i in 1 2 3 4 5 6 7 8; do
    same "turn-000$i" "turn-y-000$i"
    read -r left right bottom top < <(margins "turn-000$i")
    for margin in $left $right $bottom $top; do
        least=$((margin < least ? margin : least))
    done
done
[ "$least" -ge 2 ] && [ "$least" -le 8 ] || fail "the turntable's least margin is $least pixels"
other turn-0001 turn-0003

# A camera given by hand: what lies at its target keeps its size in parallel projection.
take by-hand --eye 4,1,20 --target 4,1,0 --camera none y-up.gltf
take by-hand-ortho --eye 4,1,20 --target 4,1,0 --ortho --camera none y-up.gltf
other by-hand by-hand-ortho
read -r a _ < <(margins by-hand)
read -r b _ < <(margins by-hand-ortho)
[ $((a - b)) -ge -6 ] && [ $((a - b)) -le 6 ] || fail "--ortho changes the size: $a and $b"

# Wrong usage.
for bad in "" 1 1,2,3 0,91 0,-91 x,0 side 1,nan; do
    want 2 "--view \"$bad\"" --view "$bad" -o a.png y-up.gltf
done
want 2 "--view and --eye cannot be used together" --view top --eye 1,1,1 -o a.png
want 2 "--view and --camera cannot be used together" --view top --camera 1 -o a.png y-up.gltf
want 2 '--camera "0"' --camera 0 -o a.png y-up.gltf
want 2 '--camera "no"' --camera no -o a.png y-up.gltf
want 1 "--up 0,0,0" --up 0,0,0 -o a.png

[ $failures = 0 ] && echo "all holds"
exit $((failures > 0))
