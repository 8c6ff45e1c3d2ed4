#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# lengths.sh ROOT: no page of lengths.tsv is longer than it says, and no line of these pages longer than a screen holds.
# Tables, links and commands are as wide as they must be.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cd "$1"
checked=0 faults=0
complain() {
    echo "$*"
    faults=$((faults + 1))
}
while IFS=$'\t' read -r pattern most; do
    [[ $pattern == \#* ]] && continue
    for page in $pattern; do
        [ -f "$page" ] || { complain "$page: no such page"; continue; }
        checked=$((checked + 1))
        lines=$(wc -l <"$page")
        [ "$lines" -le "$most" ] || complain "$page: $lines lines, more than $most"
        wide=$(awk '/^```/ { fenced = !fenced } !fenced && !/^\|/ && !/^Made by `/ && !/\]\(/ && length($0) > 150 { print NR; exit }' "$page")
        [ -z "$wide" ] || complain "$page:$wide: longer than 150 characters"
    done
done <"$here/lengths.tsv"
echo "$checked pages, $faults faults"
[ "$faults" = 0 ] && [ "$checked" -gt 20 ]
