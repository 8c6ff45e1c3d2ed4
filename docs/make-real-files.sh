#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# make-real-files.sh GLSSAO_RENDER WORK_FOLDER: draws the glTF files of Debian's assimp-testmodels and of two npm packages, and
# versions of some that gltf-transform packs, and writes what became of each to docs/data/real-files.tsv. Needs npm, ImageMagick
# and assimp-testmodels. WORK_FOLDER keeps the pictures, and sheet-*.jpg to look at.
set -euo pipefail
render=$(realpath "$1") work=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
table=$here/data/real-files.tsv
mkdir -p "$work/pictures" "$work/packed"
cd "$work"
if [ ! -d node_modules/@webxr-input-profiles ]; then
    npm install --no-audit --no-fund --ignore-scripts --silent @webxr-input-profiles/assets@1.0.20 @gltf-transform/cli@4.5.1
fi

# draw FILE PICTURE: "drawn", or the message; then the warnings and the triangles, tab between them.
draw() {
    local status=0
    rm -f "$2" stats.json
    timeout 120 "$render" -s 640x360 --samples-per-pixel 4 -o "$2" --stats stats.json "$1" 2>log || status=$?
    local warnings
    warnings=$(sed -n "s|^.*: warning: ||p" log | paste -sd';' | sed 's/;/; /g')
    if [ $status = 0 ]; then
        printf 'drawn\t%s\t%s' "$warnings" "$(grep -o '"triangles": [0-9]*' stats.json | grep -o '[0-9]*$')"
    else
        printf 'exit %d: %s\t%s\t' $status "$(tail -n 1 log | sed "s|^glssao-render: ||; s|$1: ||; s|$work/||g")" "$warnings"
    fi
}

# difference A B: RMSE of two pictures.
difference() {
    compare -metric RMSE "$1" "$2" null: 2>&1 | grep -o '([^)]*)' | tr -d '()' || true
}

# texture_difference FILE PACKED: what the packing took from the textures, RMSE over all of them; nothing where there are none.
texture_difference() {
    local side
    rm -rf textures && mkdir -p textures/a textures/b
    for side in a b; do
        node_modules/.bin/gltf-transform cp "$1" textures/$side/scene.gltf >/dev/null 2>&1
        grep -oP '"uri": *"\K[^"]*\.(png|jpe?g|webp)(?=")' textures/$side/scene.gltf >textures/$side/list || true
        shift
    done
    paste textures/a/list textures/b/list | while read -r a b; do
        difference "textures/a/$a" "textures/b/$b"
    done | awk '{ sum += $1 * $1 } END { if (NR) printf "%.3g", sqrt(sum / NR) }'
}

{
    printf '# docs/make-real-files.sh build/examples/render/glssao-render /tmp/real-files\n'
    printf 'source\tfile\tbytes\tversion\ttexture_rmse\trmse\tresult\twarnings\ttriangles\n'
    n=0
    while IFS=$'\t' read -r source root file; do
        n=$((n + 1))
        picture=pictures/$(printf '%03d' $n).png
        printf '%s\t%s\t%d\tas it is\t\t\t%s\n' "$source" "$file" "$(stat -c %s "$root/$file")" "$(draw "$root/$file" "$picture")"
        # Every eighth file of those that are drawn is packed in eight ways. Lossy WebP, and JPEG as a rule, halve the resolution
        # of colour at any quality.
        if [ $((n % 8)) = 0 ] && [ -s "$picture" ]; then
            for way in draco meshopt 'meshopt --level high' quantize webp 'webp --quality 90' 'jpeg --quality 90' 'webp --lossless true'; do
                packed=packed/$n-${way// /}.glb
                read -ra words <<<"$way"
                [[ $way = jpeg* ]] && words+=(--formats '*')
                node_modules/.bin/gltf-transform "${words[@]}" "$root/$file" "$packed" >/dev/null 2>&1 || continue
                result=$(draw "$packed" "pictures/$(printf '%03d' $n)-${way// /}.png")
                lost=
                [[ $way = webp* || $way = jpeg* ]] && lost=$(texture_difference "$root/$file" "$packed")
                rmse=$(difference "$picture" "pictures/$(printf '%03d' $n)-${way// /}.png")
                printf '%s\t%s\t%d\t%s\t%s\t%s\t%s\n' "$source" "$file" "$(stat -c %s "$packed")" "$way" "$lost" "$rmse" "$result"
            done
            # What lossy WebP loses is its own: the same picture from its textures as another decoder has them, in PNG files.
            lossy=$(printf '%03d' $n)-webp.png decoded=packed/$n-webp-decoded.glb
            if node_modules/.bin/gltf-transform png --formats '*' packed/$n-webp.glb $decoded >/dev/null 2>&1; then
                result=$(draw $decoded "pictures/decoded-$lossy")
                rmse=$(difference "pictures/$lossy" "pictures/decoded-$lossy")
                printf '%s\t%s\t%d\twebp against itself decoded to PNG\t\t%s\t%s\n' "$source" "$file" "$(stat -c %s $decoded)" "$rmse" "$result"
            fi
        fi
    done < <(
        find /usr/share/assimp/models/glTF2 \( -name '*.gltf' -o -name '*.glb' \) -printf 'assimp-testmodels\t/usr/share/assimp/models/glTF2\t%P\n' | sort
        find node_modules/@webxr-input-profiles/assets/dist -name '*.gl*' -printf 'webxr-input-profiles\tnode_modules/@webxr-input-profiles/assets/dist\t%P\n' | sort
    )
} >"$table.part"
mv "$table.part" "$table"
montage pictures/*.png -tile 12x -geometry 160x90+1+1 sheet-%d.jpg
awk -F'\t' 'NR > 2 { n[$7 == "drawn" ? "drawn" : "refused"]++; if ($6 > worst) worst = $6 }
    END { printf "%d drawn, %d refused; the worst RMSE of a packed version is %s\n", n["drawn"], n["refused"], worst }' "$table"
