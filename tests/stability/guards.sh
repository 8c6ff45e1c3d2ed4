#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# guards.sh: fails if the text of a guard in guards.tsv is no longer in its file. mutate.sh, which takes minutes, tests more.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
missing=0 count=0
while IFS=$'\t' read -r guard file text _; do
    [[ $guard == \#* ]] && continue
    count=$((count + 1))
    grep -qF -- "$text" "$here/../../$file" || {
        echo "$guard: not in $file: $text"
        missing=$((missing + 1))
    }
done <"$here/guards.tsv"
echo "$count guards, $missing not in their files"
[ "$missing" = 0 ] && [ "$count" -gt 0 ]
