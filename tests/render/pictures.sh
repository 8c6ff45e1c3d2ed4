#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# pictures.sh GLSSAO_RENDER: backgrounds, samples per pixel, formats, and standard output.
set -uo pipefail
render=$(realpath "$1")
# shellcheck source=tests/render/fail.sh
. "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/fail.sh"

bytes() { od -An -tx1 "-j$2" "-N$3" "$1" | tr -d ' \n'; }
starts() { # file, offset, hexadecimal bytes
    [ "$(bytes "$1" "$2" $((${#3} / 2)))" = "$3" ] || fail "$1 has $(bytes "$1" "$2" $((${#3} / 2))) at $2 instead of $3"
}
size="-s 65x37"
# shellcheck disable=SC2086
{
    # Formats by extension. A JPEG's size stands behind its marker of the frame, which libjpeg puts at byte 158.
    for name in a.jpg a.jpeg; do
        want 0 "" $size -o $name
        starts $name 0 ffd8ff
        od -An -v -tx1 $name | tr -d ' \n' | grep -q ffc000110800250041 || fail "$name is not 65 x 37 in colour"
    done
    want 0 "" $size -o UPPER.JPG --ao UPPER.PFM # as cameras and Windows name them
    starts UPPER.JPG 0 ffd8ff
    starts UPPER.PFM 0 5066
    if "$render" $size -o a.webp 2>err; then
        starts a.webp 0 52494646
        starts a.webp 8 57454250
    else
        grep -q "a.webp: this program was built without libwebp" err || fail "a.webp"
    fi
    want 0 "" $size --ao a.png -o b.jpg
    want 2 "--output" -o a.gif
    want 2 "a JPEG (a.jpeg)" --background none -o a.jpeg

    # Standard output: a PNG, and nothing else.
    want 0 "" $size -o a.png
    want 0 "" $size -o -
    cmp out a.png || fail "-o - writes another picture"
    want 0 "" $size --error 0.1 -o a.png
    want 0 "" $size --error 0.1 -o -
    cmp out a.png || fail "-o - writes more than the picture"
    want 2 "standard output takes one picture" --frames 2 -o -
    want 2 "standard output takes one picture" --plan -o -
    want 2 "named for two" --stats - -o -
    [ ! -e - ] || fail "a file of the name - was made"
    echo "-o -" >list
    want 1 "list: 0 of 1 jobs" --batch list
    grep -q "list:1: --output -: standard output" err || fail "a job writes to standard output"

    # Backgrounds. PNG keeps the colour type in byte 25: 2 is RGB, 6 is RGBA.
    want 0 "" $size -o sky.png
    want 0 "" $size --background sky -o sky2.png
    cmp sky.png sky2.png || fail "--background sky is not the default"
    want 0 "" $size --background none -o none.png
    starts sky.png 25 02
    starts none.png 25 06
    want 0 "" $size --background '#2080fF' -o blue.png
    want 0 "" $size --background '#000000' -o black.png
    ! cmp -s blue.png sky.png || fail "--background changes nothing"
    ! cmp -s blue.png black.png || fail "--background changes nothing"
    want 0 "" $size --ao a1.pfm -o a.png
    want 0 "" $size --background none --samples-per-pixel 3 --ao a2.pfm --depth d2.pfm -o a.png
    cmp a1.pfm a2.pfm || fail "the background or the samples change accessibility"
    want 0 "" $size --depth d1.pfm
    cmp d1.pfm d2.pfm || fail "the samples change view distance"
    # With nothing in the picture it has the background's colour, in every pixel.
    echo '{"asset": {"version": "2.0"}}' >empty.gltf
    command -v python3 >/dev/null && for color in '#2080ff' '#000001' none; do
        for samples in 1 4; do
            want 0 "" $size --background "$color" --samples-per-pixel $samples -o empty.png empty.gltf
            case $color in none) expected=00000000 ;; *) expected=${color#?} ;; esac
            [ "$(python3 - empty.png 2>err <<'PY'
import sys, zlib
d = open(sys.argv[1], "rb").read()
at, idat, channels = 8, b"", {2: 3, 6: 4}[d[25]]
while at < len(d):
    n = int.from_bytes(d[at:at + 4], "big")
    if d[at + 4:at + 8] == b"IDAT":
        idat += d[at + 8:at + 8 + n]
    at += 12 + n
rows, seen, row = zlib.decompress(idat), set(), 1 + 65 * channels
for y in range(37):
    line = bytearray(rows[y * row + 1:(y + 1) * row])
    assert rows[y * row] in (0, 1)
    for i in range(channels, len(line) * rows[y * row]):
        line[i] = (line[i] + line[i - channels]) & 255
    seen |= {bytes(line[i:i + channels]).hex() for i in range(0, len(line), channels)}
print(*seen)
PY
            )" = "$expected" ] || fail "--background $color with $samples samples gives something else"
        done
    done
    for bad in white '#fff' '#12345g' '' '#1234567'; do
        want 2 "--background \"$bad\"" --background "$bad" -o a.png
    done

    # Samples: one is the default without a GPU; more change edges, and the same number gives the same bits.
    want 0 "" $size --samples-per-pixel 1 -o s1.png
    want 0 "" $size --samples-per-pixel 4 -o s4.png --stats s4.json
    want 0 "" $size --samples-per-pixel 4 -o s4b.png
    want 0 "" $size --samples-per-pixel 5 -o s5.png
    grep -q '"samples_per_pixel": 4' s4.json || fail "--stats does not say how many samples there were"
    cmp s4.png s4b.png || fail "two runs differ"
    ! cmp -s s1.png s4.png || fail "--samples-per-pixel changes nothing"
    ! cmp -s s4.png s5.png || fail "a fifth sample changes nothing"
    for bad in 0 65 1.5; do
        want 2 "--samples-per-pixel \"$bad\"" --samples-per-pixel $bad -o a.png
    done
}

[ $failures = 0 ] && echo "all holds"
exit $((failures > 0))
