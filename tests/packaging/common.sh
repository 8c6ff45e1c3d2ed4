# SPDX-License-Identifier: MIT
# What the packaging tests share: a scratch folder outside the tree, and the ways to fail and to skip.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

fail() {
    echo "$(basename "$0"): $*" >&2
    exit 1
}

skip() {
    echo "$(basename "$0"): skipped: $*"
    exit 77
}

# quietly COMMAND...: its output only where it fails.
quietly() {
    "$@" >"$scratch/output" 2>&1 || { cat "$scratch/output"; fail "failed: $*"; }
}

# names_of_header HEADER: the functions it declares for export, sorted.
names_of_header() {
    grep -oP '^GLSSAO_API [^;(]*\bglssao_\w+(?=\()' "$1" | grep -oP 'glssao_\w+$' | sort
}

# version_of SOURCE: major.minor, as the header has it; until 1.0 the soname holds both.
version_of() {
    sed -n 's/^#define GLSSAO_VERSION_M[A-Z]* //p' "$1/lib/include/glssao/glssao.h" | paste -sd.
}
