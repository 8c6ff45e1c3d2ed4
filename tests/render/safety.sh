#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# safety.sh GLSSAO_RENDER [GLSSAO_BAKE]: no program overwrites what it reads, hangs, or leaves half a file behind.
set -uo pipefail
render=$(realpath "$1")
bake=${2:+$(realpath "$2")}
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
# shellcheck source=tests/render/moving_triangle.sh
. "$here/moving_triangle.sh"
# shellcheck source=tests/render/fail.sh
. "$here/fail.sh"

want() { # code, words on stderr, program and arguments
    local code=$1 words=$2
    shift 2
    "$@" >out 2>err
    local got=$?
    [ "$got" = "$code" ] || fail "$*: exit $got instead of $code"
    [ -z "$words" ] || grep -qF -- "$words" err || fail "$*: stderr does not say \"$words\""
}
small=("$render" -s 24x16)

# A scene of three files, under names that an output may have, and surroundings of one colour.
triangle=$(printf '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\77\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\77\0\0\0\0' | base64 -w0)
base64 -d <<<"$triangle" >buffer.png
"${small[@]}" -s 8x8 --ao image.png 2>err || fail "no texture"
cat >scene.gltf <<'GLTF'
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 0}, "material": 0}]}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
 "textures": [{"source": 0}], "images": [{"uri": "image.png"}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "buffer.png"}]}
GLTF
sed -i 's/, "TEXCOORD_0": 0//' scene.gltf # positions are no texture coordinates
"${small[@]}" -s 16x8 -o sky.png 2>err || fail "no surroundings"
mkdir kept
cp buffer.png image.png scene.gltf sky.png kept/
ln -s image.png link.png
intact() {
    local file
    for file in kept/*; do
        cmp "$file" "$(basename "$file")" >&2 || fail "$1 changed $(basename "$file")"
        cp "$file" .
    done
}

# Outputs that are inputs of the same job, under any of their names.
for output in "-o image.png" "--ao buffer.png" "--normals ./image.png" "-o link.png" "--stats scene.gltf" \
    "-o $PWD/image.png"; do
    # shellcheck disable=SC2086
    want 1 "which this job reads" "${small[@]}" $output scene.gltf
    intact "$output"
done
want 1 "sky.png: would overwrite" "${small[@]}" --environment sky.png -o sky.png
intact "the environment"
want 1 "which this job reads" "${small[@]}" -o new.png --ao image.png scene.gltf
[ ! -e new.png ] || fail "something was written before the job was refused"
ln buffer.png turn-0002.png
want 1 "turn-0002.png: would overwrite buffer.png" "${small[@]}" --frames 3 -o turn.png scene.gltf
[ ! -e turn-0001.png ] || fail "a turntable began to write"
intact "a turntable"
rm turn-0002.png
printf -- '-o image.png scene.gltf\n-o list.txt.png scene.gltf\n--stats list.txt\n-o sky.png scene.gltf\n' >list.txt
cp list.txt kept.txt
want 1 "2 of 4 jobs done, 2 failed" "${small[@]}" --batch list.txt # sky.png is no input of the last job
for line in ":1: image.png: would overwrite" ":3: list.txt: would overwrite"; do
    grep -qF -- "$line" err || fail "the batch does not say \"$line\""
done
cmp list.txt kept.txt || fail "the list was overwritten"
cp kept/sky.png .
intact "a batch"
want 0 "" "${small[@]}" -o over.png scene.gltf
want 0 "" "${small[@]}" -o over.png scene.gltf # what is no input is replaced
want 0 "" "${small[@]}" -o in.png - <scene.gltf
cmp in.png over.png || fail "a scene from standard input looks different"
want 1 "would overwrite" "${small[@]}" --stats scene.gltf - <scene.gltf
intact "a scene from standard input"
echo "-o x.png -" >stdin.txt
want 1 "standard input" "${small[@]}" --batch stdin.txt

if [ -n "$bake" ]; then
    want 0 "" "$bake" -o baked.glb scene.gltf
    cp baked.glb kept/
    want 1 "baked.glb: would overwrite" "$bake" -o baked.glb baked.glb
    want 1 "baked.glb: would overwrite" "$bake" -o ./baked.glb baked.glb
    intact "the baker"
    cp buffer.png buffer.glb
    sed 's/buffer.png/buffer.glb/' scene.gltf >other.gltf
    want 1 "buffer.glb: would overwrite" "$bake" --in-place -o buffer.glb other.gltf
    cmp buffer.png buffer.glb || fail "the baker overwrote a buffer"
    want 2 "--in-place: the result is a .glb" "$bake" --in-place scene.gltf
    want 2 "standard input" "$bake" -o x.glb -
    want 0 "" "$bake" --in-place baked.glb
    ! cmp -s baked.glb kept/baked.glb || fail "--in-place changed nothing"
    [ "$(head -c 4 baked.glb)" = glTF ] || fail "--in-place left something else"
    rm kept/baked.glb
fi

# Output that cannot be printed is a failure, reported once. A closed stream's number goes to no file. A write-protected file stays.
for arguments in --help --version "-s 24x16 --plan" "-s 24x16 --bench 1" "-s 24x16 -o -" "-s 24x16 --stats -"; do
    for target in /dev/full "&-"; do
        # shellcheck disable=SC2086
        eval "\"$render\" $arguments 2>err >$target"
        [ $? = 1 ] || fail "$arguments >$target does not fail"
        [ "$(grep -c '^glssao-render: standard output: ' err)" = 1 ] || fail "$arguments >$target is not told once"
    done
done
want 0 "" "${small[@]}" --frames 3 -o open.png
"${small[@]}" --frames 3 -o closed.png <&- >&- 2>&- || fail "closed streams: exit $?"
for i in 1 2 3; do cmp open-000$i.png closed-000$i.png || fail "closed streams change picture $i"; done
(ulimit -f 1 && "$render" -s 640x360 -o limited.png 2>err)
[ $? = 1 ] && grep -q '^glssao-render: limited.png: File too large' err || fail "a limit on the size of files is not told"
[ -z "$(ls limited.png* 2>/dev/null)" ] || fail "a limit on the size of files leaves a part"
chmod 444 over.png
if [ ! -w over.png ]; then # root may write
    want 1 "Permission denied" "${small[@]}" -o over.png scene.gltf
fi
chmod 644 over.png

# A FIFO that nobody writes to does not hang a job; a list may come through one.
mkfifo pipe.hdr list.fifo
want 1 "pipe.hdr: not a regular file" timeout 20 "${small[@]}" --environment pipe.hdr -o x.png
want 1 "pipe.hdr: not a regular file" timeout 20 "${small[@]}" -o x.png pipe.hdr
echo "-o fifo.png" >list.fifo &
want 0 "1 of 1 jobs done" timeout 20 "${small[@]}" --batch list.fifo

# Time.
long=(-t raytrace --samples 65536 -s 640x480)
if "$render" -t raytrace -s 4x4 -o x.png 2>err; then
    want 1 "--timeout 0.5: not done by then" timeout 20 "$render" "${long[@]}" -o late.png --timeout 0.5
    printf -- '-o 1.png\n%s -o 2.png\n-o 3.png\n' "${long[*]}" >list
    want 1 "list: 2 of 3 jobs done, 1 failed; 2 pictures" timeout 60 "${small[@]}" --batch list --timeout 5
    grep -qF "list:2: --timeout 5: not done by then" err || fail "the late job is not named"
    [ -s 1.png ] && [ -s 3.png ] && [ ! -e 2.png ] || fail "--timeout: the wrong jobs were done"

    # Signals: the job ends, the summary comes, and nothing half written stays.
    for isolate in "" --isolate; do
        rm -f [123].png
        # shellcheck disable=SC2086
        "$render" -s 24x16 --batch list $isolate >out 2>err &
        batch=$!
        for _ in $(seq 200); do
            [ -s 1.png ] && break
            sleep 0.05
        done
        sleep 0.3
        kill -TERM $batch
        wait $batch
        got=$?
        [ $got = 143 ] || fail "SIGTERM $isolate: exit $got"
        grep -qF "list: stopped by signal 15" err || fail "SIGTERM $isolate: not said"
        grep -qF "list: 1 of 3 jobs done, 1 failed; 1 pictures" err || fail "SIGTERM $isolate: no summary"
        [ ! -e 2.png ] && [ ! -e 3.png ] || fail "SIGTERM $isolate: more jobs were done"
    done
fi
for name in INT TERM; do # while a large picture is written
    rm -f big.png
    "$render" -s 5000x5000 --no-ao --no-shadows -o big.png >out 2>err &
    job=$!
    for _ in $(seq 400); do
        compgen -G 'big.png.*.part' >/dev/null && break
        sleep 0.02
    done
    compgen -G 'big.png.*.part' >/dev/null || fail "no file is being written"
    kill -s $name $job
    wait $job
    [ $? -gt 128 ] || fail "SIG$name does not end it"
    [ ! -e big.png ] || fail "SIG$name leaves half a picture"
    compgen -G '*.part' && fail "SIG$name leaves a temporary file"
done

# A job in a process of its own writes the same files. Killing one harms no other.
printf -- '-o i1.png\n-o i2.png none.glb\n-o i3.png --scene steps\n' >list
want 1 "list: 2 of 3 jobs done, 1 failed; 2 pictures" "${small[@]}" --batch list --isolate
grep -qF "list:2: none.glb" err || fail "the job that failed is not named"
for i in 1 3; do cp i$i.png isolated$i.png; done
want 1 "" "${small[@]}" --batch list
for i in 1 3; do cmp i$i.png isolated$i.png || fail "--isolate changes a picture"; done
printf -- '-s 5000x5000 --no-ao --no-shadows -o k1.png\n-o k2.png\n' >list
"${small[@]}" --batch list --isolate >out 2>err &
batch=$!
for _ in $(seq 400); do
    compgen -G 'k1.png.*.part' >/dev/null && break
    sleep 0.02
done
kill -KILL "$(ls k1.png.*.part | sed 's/k1.png.\([0-9]*\)-.*/\1/')"
wait $batch
grep -qF "list:1: its process died: Killed" err || fail "the crash is not told: $(tail -n 2 err)"
grep -qF "list: 1 of 2 jobs done, 1 failed; 1 pictures" err || fail "the crash costs more than its job"
[ -s k2.png ] || fail "the job after the crash was not done"
[ ! -e k1.png ] || fail "the crash left a picture"
want 2 "--isolate: needs a list" "$render" --isolate -o x.png
want 2 '--timeout "0"' "$render" --timeout 0 -o x.png
compgen -G '*.part' && fail "temporary files are left"

[ $failures = 0 ] && echo "all holds"
exit $((failures > 0))
