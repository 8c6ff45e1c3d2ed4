#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# batch.sh GLSSAO_RENDER CONTEXT: --batch writes the same files as one process per job, reports the jobs that fail and
# does the rest. Shards divide a list among them.
set -uo pipefail
render=$(realpath "$1") context=$2
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
# shellcheck source=tests/render/moving_triangle.sh
. "$here/moving_triangle.sh"
# shellcheck source=tests/render/fail.sh
. "$here/fail.sh"
mkdir batch each none

# want CODE WORDS ARGUMENTS...: this exit code, and WORDS (fixed text) on stderr.
want() {
    local code=$1 words=$2
    shift 2
    "$render" --context "$context" "$@" >out 2>err
    local got=$?
    [ "$got" = "$code" ] || fail "$*: exit $got instead of $code"
    [ -z "$words" ] || grep -qF -- "$words" err || fail "$*: stderr does not say \"$words\""
}

moving_triangle "a b.gltf" 0.3
moving_triangle c.gltf 0.5

# Surroundings of one colour.
{
    printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n'
    for _ in $(seq 32); do printf '\100\200\100\200'; done
} >green.hdr

# Each job differs from the one before in something that a pipeline keeps, some with targets of the same size. The first
# job returns at the end. They are written as a shell reads them, for the processes below.
cat >list <<'LIST'
# The defaults are the command line's.
-o $to/01.png --ao $to/01.pfm --depth $to/01-d.pfm

-o $to/02.png -s 40x30 --margin 8 --layers 2   # larger, with more targets
-s 56x46 -o '$to/04 #.png' --normals $to/03.png --scene cornell --seed 9 --shadow-size 64 --debug-map normals
-o "$to/05.png" --error 0.02 --time 0.5 a\ b.gltf
-t classic -o $to/06.png --environment green.hdr --frames 2 "a "'b.gltf'
-t hemisphere -q low -o $to/07.png --mapped-normals c.gltf
--time 0.25 --frames 3 --fps 4 --history 4 -o $to/09.png c.gltf
-o $to/08.png --ao $to/08.pfm --depth $to/08-d.pfm
LIST
sed 's/\$to/batch/' list | sed 's/\$to/batch/;s/\$to/batch/' >batch.txt
sed 's/\$to/each/' list | sed 's/\$to/each/;s/\$to/each/' >each.txt

printf '\xef\xbb\xbf-o windows.png\r\n\r\n' >windows.txt
want 0 "windows.txt: 1 of 1 jobs done" -s 24x16 --batch windows.txt
[ -s windows.png ] || fail "a list with a byte order mark and carriage returns makes other files"
want 0 "batch.txt: 8 of 8 jobs done, 0 failed; 16 pictures in " -s 33x21 --batch batch.txt --cache 0
while IFS= read -r line; do
    eval "set -- $line"
    [ $# = 0 ] || want 0 "" -s 33x21 "$@"
done <each.txt
[ "$(ls each | wc -l)" = 16 ] || fail "not all files were made, one by one"
diff -r batch each || fail "a batch's files are not those of a process a job"
# The third picture of an animation shows the file at its time: nothing occludes a triangle.
want 0 "" -s 33x21 --time 0.75 -o third.png c.gltf
cmp third.png batch/09-0003.png || fail "an animation's picture is not the file at its time"
cmp -s batch/09-0001.png batch/09-0002.png && fail "the animation stands still"
cmp batch/01.pfm batch/08.pfm || fail "the same job gave something else after others"

finish() {
    [ $failures = 0 ] && echo "all holds"
    exit $((failures > 0))
}
[ "$context" = egl ] || finish # the rest has nothing to do with the context

# With all scenes kept, and in shards: the same, each job done once.
for shard in 0 1; do
    rm -rf batch
    mkdir batch
    jobs=4
    want 0 "batch.txt, shard $shard/2: $jobs of $jobs jobs done" -s 33x21 --batch batch.txt --shard $shard/2
    for file in batch/*; do
        cmp "$file" "each/$(basename "$file")" && rm "each/$(basename "$file")" || fail "$file: shard $shard/2"
    done
done
[ -z "$(ls each)" ] || fail "no shard made $(ls each)"

# Jobs that fail, and why; the jobs between them are done. A list from standard input.
ln -s /dev/full full.png
echo kept >kept.png
cat >bad <<'LIST'
-o none/1.png
-o none/2.png missing.glb
-o full.png
-o none/../none/1.png
-o none/x.png "open
--shard 0/2 -o none/x.png
-o kept.png none
-o nowhere/x.png
-o none/x.png -t classic --samples 15
-o none/x.png --camera 2 c.gltf
-o none/3.png c.gltf
LIST
want 1 "standard input: 2 of 11 jobs done, 9 failed; 2 pictures" -s 16x16 --batch - <bad
sed -n 's/^glssao-render: standard input:\([0-9]*\): .*/\1/p' err >lines
[ "$(tr '\n' ' ' <lines)" = "2 3 4 5 6 7 8 9 10 " ] || fail "other lines failed"
for words in ":2: missing.glb" ":3: full.png: No space left" ":4: $(realpath none)/1.png: line 1 also writes this file" \
    ':5: a " without' ":6: --shard" ":8: nowhere/x.png" ":9: --samples" ":10: --camera 2"; do
    grep -qF -- "$words" err || fail "stderr does not say \"$words\""
done
[ "$(cat none/1.png none/3.png | wc -c)" -gt 100 ] || fail "the good jobs left no pictures"
[ "$(ls none | wc -l)" = 2 ] || fail "something else is left: $(ls none)"
[ "$(cat kept.png)" = kept ] || fail "a job that failed spoiled a file"

# Wrong usage.
: >empty
want 0 "empty: 0 of 0 jobs done" --batch empty
want 1 "no-list: No such file" --batch no-list
want 2 "needs a list" --shard 0/2 -o x.png
for bad in 2/2 1 1/ /2 -1/2 0/0 1/2/3; do
    want 2 "--shard \"$bad\"" --batch empty --shard "$bad"
done
want 2 "--batch and --bench" --batch empty --bench 3
printf -- '-o a.png\0\n' >zero
want 1 "not text" --batch zero

finish
