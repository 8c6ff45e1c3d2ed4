#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# decisions.sh [--update] FOLDER: FOLDER/README.md lists every record NNNN-name.md of the folder, in order, with the title
# of its first line. --update writes the list.
set -euo pipefail
update=
if [ "$1" = --update ]; then
    update=1
    shift
fi
cd "$1"
fail() { echo "decisions.sh: $*" >&2; exit 1; }
records=([0-9][0-9][0-9][0-9]-*.md)
[ -e "${records[0]}" ] || fail "no records in $1"
scratch=$(mktemp)
trap 'rm -f "$scratch"' EXIT
sed '/^- \[/,$d' README.md >"$scratch"
last=
for record in "${records[@]}"; do
    number=${record%%-*}
    [ "$number" != "$last" ] || fail "two records have the number $number"
    last=$number
    title=$(sed -n "1s/^# $number: //p" "$record")
    [ -n "$title" ] || fail "$record does not begin with \"# $number: \" and a title"
    echo "- [$number]($record) $title" >>"$scratch"
done
if [ -n "$update" ]; then
    cp "$scratch" README.md
else
    diff README.md "$scratch" || fail "the list (<) differs from the records (>); decisions.sh --update writes it"
fi
