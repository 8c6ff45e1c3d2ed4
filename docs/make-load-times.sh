#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# make-load-times.sh GLSSAO_RENDER WORK_FOLDER: times glssao-render and F3D on files of 10 million triangles, with and without
# normals, and of two 8192 x 8192 textures, as PNG and as JPEG, side by side, and writes docs/data/load-times.tsv. Needs f3d, xvfb,
# python3, ImageMagick and GNU time. Seconds are the least of three runs, in turns. F3D loads alone with --no-render.
set -euo pipefail
render=$(realpath "$1") work=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
table=$here/data/load-times.tsv
mkdir -p "$work"
cd "$work"
for normals in 0 1; do
    [ -f grid-$normals.glb ] || python3 - $normals grid-$normals.glb <<'PYTHON'
import array, json, math, struct, sys
normals, n = int(sys.argv[1]), 2237
height = lambda x, y: 0.3 * math.sin(x * 0.01) * math.cos(y * 0.013)
positions, indices = array.array('f'), array.array('I')
for y in range(n):
    for x in range(n):
        positions.extend((x * 10 / n, height(x, y), y * 10 / n))
for y in range(n - 1):
    for x in range(n - 1):
        a = y * n + x
        indices.extend((a, a + n, a + 1, a + 1, a + n, a + n + 1))
parts = [positions.tobytes(), indices.tobytes()]
if normals:
    parts.append(array.array('f', (0, 1, 0)).tobytes() * (n * n))
views, at = [], 0
for part in parts:
    views.append({'buffer': 0, 'byteOffset': at, 'byteLength': len(part)})
    at += len(part)
accessors = [{'bufferView': 0, 'componentType': 5126, 'type': 'VEC3', 'count': n * n, 'min': [0, -1, 0], 'max': [10, 1, 10]},
             {'bufferView': 1, 'componentType': 5125, 'type': 'SCALAR', 'count': len(indices)}]
attributes = {'POSITION': 0}
if normals:
    accessors.append({'bufferView': 2, 'componentType': 5126, 'type': 'VEC3', 'count': n * n})
    attributes['NORMAL'] = 2
text = json.dumps({'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0]}], 'nodes': [{'mesh': 0}],
                   'meshes': [{'primitives': [{'attributes': attributes, 'indices': 1}]}], 'accessors': accessors,
                   'bufferViews': views, 'buffers': [{'byteLength': at}]}).encode()
text += b' ' * (-len(text) % 4)
with open(sys.argv[2], 'wb') as file:
    file.write(b'glTF' + struct.pack('<II', 2, 28 + len(text) + at) + struct.pack('<I', len(text)) + b'JSON' + text +
               struct.pack('<I', at) + b'BIN\0')
    for part in parts:
        file.write(part)
PYTHON
done

# Two quads, each with a texture of its own.
for kind in png jpg; do
    [ -f textures-$kind.glb ] || python3 - $kind textures-$kind.glb <<'PYTHON'
import array, json, struct, subprocess, sys, zlib
kind, n = sys.argv[1], 8192
chunk = lambda name, data: struct.pack('>I', len(data)) + name + data + struct.pack('>I', zlib.crc32(name + data))
def picture(turn):
    wave = bytes((x * 7 + turn * 50 + (x >> 4) * 31) & 255 for x in range(3 * n))
    pack, rows = zlib.compressobj(1), b''
    for y in range(n):
        rows += pack.compress(b'\0' + wave[3 * (y // 3 % n):] + wave[:3 * (y // 3 % n)])
    png = b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', n, n, 8, 2, 0, 0, 0))
    png += chunk(b'IDAT', rows + pack.flush()) + chunk(b'IEND', b'')
    return png if kind == 'png' else subprocess.run(['convert', 'png:-', '-quality', '90', 'jpg:-'], input=png, check=True,
                                                    capture_output=True).stdout
parts = [array.array('f', (-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0)).tobytes(),
         array.array('f', (0, 1, 1, 1, 1, 0, 0, 0)).tobytes(), array.array('I', (0, 1, 2, 0, 2, 3)).tobytes(), picture(0), picture(1)]
views, data = [], b''
for part in parts:
    views.append({'buffer': 0, 'byteOffset': len(data), 'byteLength': len(part)})
    data += part + b'\0' * (-len(part) % 4)
accessors = [{'bufferView': 0, 'componentType': 5126, 'type': 'VEC3', 'count': 4, 'min': [-1, -1, 0], 'max': [1, 1, 0]},
             {'bufferView': 1, 'componentType': 5126, 'type': 'VEC2', 'count': 4},
             {'bufferView': 2, 'componentType': 5125, 'type': 'SCALAR', 'count': 6}]
quads = [{'primitives': [{'attributes': {'POSITION': 0, 'TEXCOORD_0': 1}, 'indices': 2, 'material': i}]} for i in (0, 1)]
text = json.dumps({'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0, 1]}], 'meshes': quads,
                   'nodes': [{'mesh': i, 'translation': [2.1 * i, 0, 0]} for i in (0, 1)],
                   'materials': [{'pbrMetallicRoughness': {'baseColorTexture': {'index': i}}} for i in (0, 1)],
                   'textures': [{'source': i} for i in (0, 1)], 'accessors': accessors, 'bufferViews': views,
                   'images': [{'bufferView': 3 + i, 'mimeType': 'image/png' if kind == 'png' else 'image/jpeg'} for i in (0, 1)],
                   'buffers': [{'byteLength': len(data)}]}).encode()
text += b' ' * (-len(text) % 4)
with open(sys.argv[2], 'wb') as file:
    file.write(b'glTF' + struct.pack('<II', 2, 28 + len(text) + len(data)) + struct.pack('<I', len(text)) + b'JSON' + text +
               struct.pack('<I', len(data)) + b'BIN\0' + data)
PYTHON
done

# run NUMBER COMMAND...: adds seconds, processor seconds of both kinds and KiB to times-NUMBER.
run() {
    local number=$1
    shift
    /usr/bin/time -a -o "times-$number" -f '%e %U %S %M' "$@" >/dev/null 2>&1
}

# row FILE PROGRAM NUMBER: the least seconds and processor seconds, and the largest MiB.
row() {
    awk -v file="$1" -v program="$2" '{ c = $2 + $3; if (NR == 1 || $1 < s) s = $1; if (NR == 1 || c < p) p = c; if ($4 > m) m = $4 }
        END { printf "%s\t%s\t%.2f\t%.2f\t%.0f\n", file, program, s, p, m / 1024 }' "times-$3"
}

load_seconds() {
    awk -F'[:,]' '/"load"/ { for (i = 1; i < NF; i++) if ($i ~ /"load"/) printf "%.2f\n", $(i + 1) / 1000 }' stats.json
}

{
    printf '# docs/make-load-times.sh build/examples/render/glssao-render /tmp/load-times\n'
    printf 'file\tprogram\tseconds\tprocessor_seconds\tmib\n'
    for file in grid-1.glb grid-0.glb textures-png.glb textures-jpg.glb; do
        rm -f times-* loads
        # In turns, so that what else the machine does meets all alike.
        for _ in 1 2 3; do
            run 0 f3d --no-render $file
            run 1 xvfb-run -a f3d $file --output=f3d.png --resolution=640,360
            run 2 "$render" -s 640x360 --no-ao --no-shadows -o a.png --stats stats.json $file
            load_seconds >>loads
            run 3 xvfb-run -a f3d --ssao $file --output=f3d.png --resolution=640,360
            run 4 "$render" -s 640x360 --no-shadows -o a.png $file
            run 5 "$render" -s 640x360 -o a.png $file
        done
        row $file 'f3d --no-render' 0
        row $file f3d 1
        row $file 'f3d --ssao' 3
        row $file 'glssao-render --no-ao --no-shadows' 2
        printf '%s\tglssao-render, loading\t%s\t\t\n' $file "$(sort -g loads | head -1)"
        row $file 'glssao-render --no-shadows' 4
        row $file glssao-render 5
    done
} >"$table.part"
mv "$table.part" "$table"
