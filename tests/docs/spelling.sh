#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# spelling.sh ROOT: codespell finds no misspelling in the repository's text. words.txt beside this script has the words that
# it takes for mistakes, one a line.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
if ! command -v codespell >/dev/null; then
    echo "spelling.sh: skipped: no codespell (Debian and Ubuntu: apt install codespell)"
    exit 77
fi
cd "$1"
codespell --ignore-words "$here/words.txt" --skip '*.png,*.jpg' README.md CHANGELOG.md CONTRIBUTING.md docs examples glsl lib tests \
    third_party
