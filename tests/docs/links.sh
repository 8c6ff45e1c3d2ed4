#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# links.sh ROOT: every relative link and picture of every page exists, and so does the heading that its #fragment names;
# and so does every page that a source file mentions as docs/NAME.md. Web addresses are not fetched.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/pages.sh"
cd "$1"
find_pages
count=0 dead=0

# The fragments of a page, as GitHub makes them: lower case, no punctuation, hyphens for spaces.
fragments() {
    awk '/^```/ { fenced = !fenced } !fenced && /^#+ / { sub(/^#+ /, ""); print }' "$1" |
        tr '[:upper:] ' '[:lower:]-' | sed 's/[^a-z0-9_-]//g'
}
complain() { # page, target, what is wrong
    echo "$1: $2: $3"
    dead=$((dead + 1))
}
for page in "${pages[@]}"; do
    while read -r target; do
        count=$((count + 1))
        file=${target%%#*} fragment=
        [[ $target != *#* ]] || fragment=${target#*#}
        path=$page
        if [ -n "$file" ]; then
            path=$(dirname "$page")/$file
            [ -e "$path" ] || { complain "$page" "$target" "no such file"; continue; }
        fi
        [ -z "$fragment" ] || fragments "$path" | grep -qxF -- "$fragment" || complain "$page" "$target" "no such heading"
    done < <(grep -oE '\]\([^) ]+\)' "$page" | sed 's/^](//; s/)$//' | grep -vE '^[a-z]+:')
done
while IFS=: read -r source target; do
    count=$((count + 1))
    [ -e "$target" ] || complain "$source" "$target" "no such page"
done < <(grep -roE '\bdocs/[a-z0-9_/-]+\.md' docs examples glsl lib tests third_party --exclude='*.md')
echo "${#pages[@]} pages, $count links, $dead dead"
[ "$dead" = 0 ] && [ "$count" -gt 50 ]
