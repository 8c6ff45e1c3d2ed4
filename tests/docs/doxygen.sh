#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# doxygen.sh SOURCE: the reference of the public header is made without a warning, so no symbol lacks a comment.
set -euo pipefail
if ! command -v doxygen >/dev/null; then
    echo "doxygen.sh: skipped: no doxygen (Debian and Ubuntu: apt install doxygen)"
    exit 77
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$1"
(cat docs/Doxyfile && echo "OUTPUT_DIRECTORY = $scratch") | doxygen -
grep -q glssao_compute "$scratch/html/glssao_8h.html" || { echo "doxygen.sh: no glssao_compute in the reference" >&2; exit 1; }
