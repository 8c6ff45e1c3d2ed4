#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# format.sh [--fix]: names the C and C++ files of lib, examples and tests that clang-format would change, or changes
# them. Versions of clang-format differ in what they write, so it is 14 or none (skipped). The public header is laid out
# by hand, for its table of calls and its columns of comments.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
for format in clang-format-14 clang-format; do
    "$format" --version 2>/dev/null | grep -q 'version 14\.' && break || format=
done
[ -n "$format" ] || { echo "format.sh: skipped: no clang-format 14 (Debian 12: apt install clang-format-14)"; exit 77; }
mapfile -d '' files < <(find lib examples tests ! -path '*/glssao/glssao.h' \( -name '*.c' -o -name '*.h' -o -name '*.cpp' \) -print0 | sort -z)
[ ${#files[@]} -gt 100 ] || { echo "format.sh: only ${#files[@]} files found" >&2; exit 1; }
if [ "${1:-}" = --fix ]; then
    "$format" -i "${files[@]}"
    exit
fi
wrong=$("$format" --dry-run "${files[@]}" 2>&1 | sed -n 's/^\([^ :]*\):[0-9].*/\1/p' | sort -u)
[ -z "$wrong" ] || { printf 'not as .clang-format has it: %s\n' $wrong "(.ci/format.sh --fix formats them)" >&2; exit 1; }
