#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# make-samples-price.sh GLSSAO_RENDER [SCENES]: writes docs/data/samples-per-pixel.tsv: for each number of samples a pixel,
# how far the picture is from the ray-traced one of 16 samples (RMSE), and the processor time of the whole run. 640x360, horizon
# at HIGH. Other work on the machine lengthens the times: compare rows of one run.
set -euo pipefail
render=$(realpath "$1")
scenes=${2:+$(realpath "$2")}
out=$(dirname "$(realpath "${BASH_SOURCE[0]}")")/data/samples-per-pixel.tsv
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# RMSE of two pictures, 0 to 1, over all channels.
cat >rmse.py <<'PY'
import sys, zlib

def pixels(path):
    d = open(path, "rb").read()
    width, height = int.from_bytes(d[16:20], "big"), int.from_bytes(d[20:24], "big")
    at, data = 8, b""
    while at < len(d):
        n = int.from_bytes(d[at:at + 4], "big")
        if d[at + 4:at + 8] == b"IDAT":
            data += d[at + 8:at + 8 + n]
        at += 12 + n
    rows, out, step = zlib.decompress(data), bytearray(), 1 + 3 * width
    for y in range(height):  # glssao-render uses the filters None and Sub
        line = bytearray(rows[y * step + 1:(y + 1) * step])
        for i in range(3, len(line) * rows[y * step]):
            line[i] = (line[i] + line[i - 3]) & 255
        out += line
    return out

a, b = pixels(sys.argv[1]), pixels(sys.argv[2])
print("%.5f" % ((sum((x - y) ** 2 for x, y in zip(a, b)) / len(a)) ** 0.5 / 255))
PY
number() { sed -n "s/.*\"$1\": \([0-9.]*\).*/\1/p" stats.json; }
{
    echo "# docs/make-samples-price.sh GLSSAO_RENDER SCENES"
    printf 'scene\tsamples\trmse\tcpu_ms\n'
    for scene in columns cornell steps flight-helmet dutch-ship ivy-house; do
        file=$(ls "${scenes:-none}/$scene"/*.gl* 2>/dev/null | head -n 1 || true)
        arguments=("$file")
        [ -n "$file" ] || arguments=(--scene "$scene")
        case $scene in flight-helmet | dutch-ship | ivy-house) [ -n "$file" ] || continue ;; esac
        "$render" -s 640x360 -t raytrace --samples 512 --samples-per-pixel 16 -o truth.png "${arguments[@]}" 2>/dev/null
        for samples in 1 2 4 8 16; do
            for _ in 1 2; do # the first fills the driver's cache
                "$render" -s 640x360 --samples-per-pixel $samples -o picture.png --stats stats.json "${arguments[@]}" 2>/dev/null
            done
            printf '%s\t%d\t%s\t%.0f\n' $scene $samples "$(python3 rmse.py truth.png picture.png)" "$(number cpu)"
        done
    done
} >table.tsv
cp table.tsv "$out"
