#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# corpus.sh SCENES OUT: a corpus for fuzz_gltf: every glTF file of at most 16 KB below SCENES, valid or not, its .bin files
# embedded, since the target sees one file alone.
set -euo pipefail
scenes=$1 out=$2
mkdir -p "$out"
n=0
while IFS= read -r -d '' file; do
    n=$((n + 1))
    copy=$out/$(printf '%04d' "$n")-$(basename "$file")
    cp "$file" "$copy"
    if [[ $file != *.gltf ]]; then
        continue
    fi
    while read -r bin; do
        at=$(dirname "$file")/$bin
        if [ -f "$at" ] && [ "$(stat -c %s "$at")" -le 12288 ]; then
            printf 's|"%s"|"data:application/octet-stream;base64,%s"|\n' "$bin" "$(base64 -w0 "$at")" | sed -i -f - "$copy"
        fi
    done < <(grep -ao '"[A-Za-z0-9_.-]*\.bin"' "$file" | tr -d '"' | sort -u)
done < <(find "$scenes" \( -name '*.gltf' -o -name '*.glb' \) -size -17k -print0 | sort -z)
echo "$n files in $out"
