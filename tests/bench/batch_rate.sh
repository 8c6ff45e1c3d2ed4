#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# batch_rate.sh GLSSAO_RENDER [VIEWS [PROCESSES [OPTIONS...]]]: pictures a second of one --batch of VIEWS views of a scene
# (500, the built-in columns at 512x384 unless OPTIONS say otherwise), of PROCESSES of the same views in a process each,
# one after the other, and of as many of them side by side as there are cores; and the ratios. Checks that the files agree.
set -euo pipefail
render=$(realpath "$1")
views=${2:-500} processes=${3:-${2:-500}}
shift "$(($# < 3 ? $# : 3))"
options=(-s 512x384 "$@")
cores=$(nproc)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/batch" "$work/each" "$work/side"

awk -v n="$views" 'BEGIN { for (i = 0; i < n; i++) {
    a = 6.283185307 * i / n
    printf "-o %04d.png --eye %.6f,%.6f,%.6f --target 0,1,0 --up 0,1,0\n", i, 7 * sin(a), 3 + sin(3 * a), 7 * cos(a) } }' >"$work/list"
head -n "$processes" "$work/list" >"$work/some"

seconds() { # a command: prints how long it took
    local start end
    start=$(date +%s.%N)
    "$@" >/dev/null 2>"$work/err" || { cat "$work/err" >&2; exit 1; }
    end=$(date +%s.%N)
    awk -v a="$start" -v b="$end" 'BEGIN { printf "%.3f", b - a }'
}
batch() { (cd "$work/batch" && "$render" "${options[@]}" --batch ../list); }
each() { (cd "$work/each" && xargs -a ../some -L 1 "$render" "${options[@]}"); }
side() { (cd "$work/side" && xargs -a ../some -L 1 -P "$cores" "$render" "${options[@]}"); }

batch_s=$(seconds batch)
each_s=$(seconds each)
side_s=$(seconds side)
for file in "$work"/each/*.png; do
    cmp "$file" "$work/batch/$(basename "$file")"
    cmp "$file" "$work/side/$(basename "$file")"
done
awk -v n="$views" -v m="$processes" -v c="$cores" -v b="$batch_s" -v e="$each_s" -v s="$side_s" 'BEGIN {
    printf "one batch of %d:                 %8.2f s, %8.2f pictures a second\n", n, b, n / b
    printf "%d processes, one at a time:     %8.2f s, %8.2f pictures a second; the batch is %.1f times that\n", m, e, m / e, n / b / (m / e)
    printf "%d processes, %d side by side:    %8.2f s, %8.2f pictures a second; the batch is %.1f times that\n", m, c, s, m / s, n / b / (m / s) }'
