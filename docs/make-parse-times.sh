#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# make-parse-times.sh OLD NEW WORK_FOLDER: times how two versions of glssao-render load a file of much JSON and a file of
# large buffers, in turns, and writes docs/data/parse-times.tsv. Needs python3 and GNU time.
set -euo pipefail
[ $# -eq 3 ] || { sed -n '3,4s/^# //p' "$0" >&2; exit 2; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
old=$(realpath "$1") new=$(realpath "$2")
mkdir -p "$3"
cd "$3"

python3 - <<'PYTHON'
import array, json
nodes, meshes, n = 100000, 20000, 2237
def write(name, rest, parts):
    views, at = [], 0
    with open(name + '.bin', 'wb') as file:
        for part in parts:
            views.append({'buffer': 0, 'byteOffset': at, 'byteLength': len(part)})
            at += len(part)
            file.write(part)
    json.dump({'asset': {'version': '2.0'}, **rest, 'bufferViews': views,
               'buffers': [{'byteLength': at, 'uri': name + '.bin'}]}, open(name + '.gltf', 'w'))

def accessor(view, kind, component, count):
    return {'bufferView': view, 'componentType': component, 'type': kind, 'count': count, 'min': [0, 0, 0], 'max': [1, 1, 1]}

write('nodes', {
    'nodes': [{'name': 'node %d' % i, 'mesh': i % meshes, 'translation': [i * 0.37, i % 7 / 3, i % 11 / 3],
               'rotation': [0, 0, 0, 1]} for i in range(nodes)],
    'meshes': [{'primitives': [{'attributes': {'POSITION': 2 * i, 'NORMAL': 2 * i + 1}}]} for i in range(meshes)],
    'accessors': [accessor(i % 2, 'VEC3', 5126, 3) for i in range(2 * meshes)]},
    [array.array('f', [0, 0, 0, 1, 0, 0, 0, 1, 0]).tobytes(), array.array('f', [0, 0, 1] * 3).tobytes()])
positions, indices = array.array('f'), array.array('I')
for y in range(n):
    for x in range(n):
        positions.extend((x, (x * y) % 17, y))
for y in range(n - 1):
    for x in range(n - 1):
        a = y * n + x
        indices.extend((a, a + n, a + 1, a + 1, a + n, a + n + 1))
write('grid', {
    'nodes': [{'mesh': 0}], 'meshes': [{'primitives': [{'attributes': {'POSITION': 0, 'NORMAL': 2}, 'indices': 1}]}],
    'accessors': [accessor(0, 'VEC3', 5126, n * n), {'bufferView': 1, 'componentType': 5125, 'type': 'SCALAR', 'count': len(indices)},
                  accessor(2, 'VEC3', 5126, n * n)]},
    [positions.tobytes(), indices.tobytes(), array.array('f', (0, 1, 0)).tobytes() * (n * n)])
PYTHON

# The seconds that loading takes and the program's largest MiB.
measure() {
    /usr/bin/time -o memory -f %M "$1" -s 16x16 --no-ao --no-shadows -o a.png --stats stats.json "$2" >/dev/null 2>&1
    python3 -c 'import json, re; print("%.2f\t%d" % (float(re.search(r"\"load\": *([0-9.]+)", open("stats.json").read())[1]) / 1000,
        int(open("memory").read()) / 1024))'
}
{
    printf '# docs/make-parse-times.sh OLD NEW /tmp/parse-times\n'
    printf '%s\t%s\t%s\t%s\t%s\t%s\n' file run old_seconds old_mib new_seconds new_mib
    for file in nodes.gltf grid.gltf; do
        for run in 1 2 3; do
            printf '%s\t%s\t%s\t%s\n' $file $run "$(measure "$old" $file)" "$(measure "$new" $file)"
        done
    done
} >"$here/data/parse-times.tsv.part"
mv "$here/data/parse-times.tsv.part" "$here/data/parse-times.tsv"
