#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# commit_titles.sh ROOT: no commit made since the rule (CONTRIBUTING.md) has a title of more than 72 characters, or one
# that ends with a full stop.
set -euo pipefail
since=2026-11-29T15:00:00Z # the rule's first day; older titles are left as they are
if ! git -C "$1" rev-parse --verify -q HEAD >/dev/null 2>&1; then
    echo "commit_titles.sh: skipped: no git history in $1"
    exit 77
fi
git -C "$1" log --no-merges --since="$since" --format='%h %s' | awk '
    { ++count; title = substr($0, index($0, " ") + 1) }
    length(title) > 72 { print $1 ": " length(title) " characters: " title; ++faults }
    title ~ /\.$/ { print $1 ": ends with a full stop: " title; ++faults }
    END { print count + 0 " titles, " faults + 0 " faults"; exit faults > 0 }'
