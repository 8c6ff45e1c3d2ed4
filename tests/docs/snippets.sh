#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# snippets.sh [--update] PAGE SOURCE...: every code block of PAGE is a snippet that a compiled SOURCE holds between
# "snippet: NAME" and "end" comments, word for word; with --update the page is made so.
set -euo pipefail
update=
if [ "$1" = --update ]; then
    update=1
    shift
fi
page=$1
shift
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

awk -v folder="$scratch" '
    /^ *(\/\*|#|\/\/) end( \*\/)?$/ { name = ""; next }
    /snippet: / {
        match($0, /snippet: [a-z0-9 -]+[a-z0-9]/)
        name = substr($0, RSTART + 9, RLENGTH - 9)
        if (name in seen) { print "snippet " name " stands twice" > "/dev/stderr"; exit 1 }
        seen[name] = 1
        match($0, /^ */)
        indent = RLENGTH
        next
    }
    name != "" {
        print (substr($0, 1, indent) ~ /^ *$/ ? substr($0, indent + 1) : $0) > (folder "/" name)
    }' "$@"

awk -v folder="$scratch" '
    /^<!-- snippet: .* -->$/ { name = $0; sub(/^<!-- snippet: /, "", name); sub(/ -->$/, "", name); print; next }
    /^```/ && !inside {
        if (name == "" && $0 !~ /^```(sh|text)$/) { print "line " NR ": a code block that is no snippet" > "/dev/stderr"; exit 1 }
        print
        inside = 1
        if (name != "") {
            file = folder "/" name
            if ((getline line < file) <= 0) { print "line " NR ": no snippet " name > "/dev/stderr"; exit 1 }
            do print line; while ((getline line < file) > 0)
        }
        next
    }
    /^```$/ { inside = 0; name = ""; print; next }
    inside && name != "" { next }
    { print }' "$page" >"$scratch/page.new"

if [ -n "$update" ]; then
    cp "$scratch/page.new" "$page"
elif ! diff -u "$page" "$scratch/page.new"; then
    echo "snippets.sh: $page differs from the sources; snippets.sh --update makes it follow" >&2
    exit 1
fi
