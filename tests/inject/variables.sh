#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# variables.sh ROOT: the man page and docs/inject.md name exactly the variables that the library reads, and the man page has
# no faults.
set -euo pipefail
cd "$1"
names() { grep -oE 'GLSSAO_INJECT_[A-Z]+' "$@" | sed 's/.*://' | sort -u; }
names examples/inject/options.c >/dev/null
for page in docs/man/glssao-inject.7 docs/inject.md; do
    diff <(names examples/inject/options.c) <(names "$page") || { echo "variables.sh: $page (>) differs from options.c (<)" >&2; exit 1; }
done
command -v mandoc >/dev/null || { echo "variables.sh: no mandoc: the man page was not checked (apt install mandoc)"; exit 0; }
mandoc -T lint -W warning docs/man/glssao-inject.7
