#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# commands.sh ROOT BUILD: what the pages tell a reader to type exists. In code spans and sh blocks of every page:
#   glssao-NAME --option      the program's --help lists the option
#   --option alone            some program's --help lists it
#   tests/x.sh and the like   the file exists
#   build/path/program        the build has it
#   snake_case, GLSSAO_NAME   the name occurs in the sources
# foreign.txt has the words that belong to other programs.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/pages.sh"
build=$(cd "$2" && pwd)
cd "$1"
find_pages
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# A line a code span or line of an sh block: page, tab, code.
for page in "${pages[@]}"; do
    awk -v page="$page" '
        /^```sh$/ { fenced = 1; next }
        /^```/ { if (fenced) fenced = 0; else skipped = !skipped; next }
        skipped { next }
        fenced { sub(/(^| )#.*/, ""); if ($0 != "") print page "\t" $0; next }
        { text = text " " $0 } # a span may go on in the next line
        END { n = split(text, part, "`"); for (i = 2; i <= n; i += 2) print page "\t" part[i] }' "$page"
done >"$scratch/code"

options() { grep -oE -- '(^|[ |[(])--[a-z][a-z-]*' | grep -oE -- '--[a-z-]*' | sort -u; }
for name in render view bake bench tune economy; do
    program=$(find "$build/examples" "$build/tests" -type f -executable -name "glssao-$name")
    [ -z "$program" ] || "$program" --help | options | sed "s/^/glssao-$name /" >>"$scratch/options"
done
grep -q glssao-render "$scratch/options" || { echo "commands.sh: no glssao-render in $build" >&2; exit 1; }
grep -v '^#' "$here/foreign.txt" >"$scratch/foreign"

find tests docs examples third_party lib glsl >"$scratch/paths"
(cd "$build" && find examples tests -type f -executable) >"$scratch/built"
git ls-files >"$scratch/files" 2>/dev/null || find . -type f -not -path './build*' -not -path './.git/*' >"$scratch/files"
grep -vE '\.(md|png|jpg|glb)$' "$scratch/files" | xargs cat | grep -aoE '[A-Za-z_][A-Za-z0-9_]*' | sort -u >"$scratch/words"

awk -F '\t' -v folder="$scratch" '
    function load(file, set, line) { while ((getline line < file) > 0) set[line] = 1; close(file) }
    function complain(text) { print $1 ": " text; ++faults }
    # Calls check() on each match of `pattern` that begins at a word.
    function each(text, pattern, what, word, before) {
        while (match(text, pattern)) {
            word = substr(text, RSTART, RLENGTH)
            before = RSTART > 1 ? substr(text, RSTART - 1, 1) : " "
            text = substr(text, RSTART + RLENGTH)
            if (before !~ /[A-Za-z0-9_\/-]/) check(what, word)
        }
    }
    function check(what, word) {
        if (word in foreign) return
        if (what == "option") {
            ++count
            if (known != "" ? !((known, word) in has) : !(word in any))
                complain((known != "" ? known " has no " : "no program has ") word)
        } else if (what == "path") {
            if (word !~ /[A-Z][A-Z][A-Z]/ && !(++count && word in paths)) complain("no " word)
        } else if (what == "built") {
            sub(/^build[^\/]*\//, "", word)
            if (!(++count && word in built)) complain("the build has no " word)
        } else if (!(++count && word in words)) complain("no " word " in the sources")
    }
    BEGIN {
        load(folder "/words", words)
        load(folder "/foreign", foreign)
        load(folder "/paths", paths)
        load(folder "/built", built)
        while ((getline line < (folder "/options")) > 0) {
            split(line, part, " ")
            has[part[1], part[2]] = any[part[2]] = program[part[1]] = 1
        }
    }
    {
        known = ""
        rest = $2
        if (match($2, /glssao-[a-z]+ /) && substr($2, RSTART, RLENGTH - 1) in program) {
            known = substr($2, RSTART, RLENGTH - 1)
            rest = substr($2, RSTART + RLENGTH)
        }
        if (known != "" || rest ~ /^--/) each(rest, "--[a-z][a-z-]*", "option")
        each($2, "(tests|docs|examples|third_party|lib|glsl)/[A-Za-z0-9_./-]*[A-Za-z0-9_-]", "path")
        each($2, "build(-clang|-sanitize)?/(examples|tests)/[A-Za-z0-9_./-]*[A-Za-z0-9_-]", "built")
        each($2, "[a-z][a-z0-9]*_[a-z0-9_]+", "name")
        each($2, "GLSSAO_[A-Z0-9_]+", "name")
    }
    END {
        print count " names, " faults + 0 " faults"
        exit faults > 0 || count < 200
    }' "$scratch/code"
