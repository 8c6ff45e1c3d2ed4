#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# man.sh PAGE PROGRAM: the man page has no faults, and tells of exactly the options that --help does.
set -euo pipefail
page=$1 program=$2
if ! command -v mandoc >/dev/null; then
    echo "man.sh: skipped: no mandoc (Debian and Ubuntu: apt install mandoc)"
    exit 77
fi
# STYLE: the date's form, and that other pages are not installed here.
mandoc -T lint -W warning "$page"
options() { grep -oE -- '--[a-z][a-z-]*' | sort -u; }
diff <("$program" --help | options) <(mandoc -T ascii "$page" | sed 's/.\x08//g' | options) || {
    echo "man.sh: $(basename "$page") and --help differ (< help, > page)" >&2
    exit 1
}
