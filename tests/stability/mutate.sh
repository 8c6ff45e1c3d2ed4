#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# mutate.sh [WORD]: removes each guard of guards.tsv (whose line contains WORD), one at a time, in a copy of the repository,
# and runs the test that the line names. Prints a line per guard; fails if a test passes without its guard.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cp -r "$root"/{CMakeLists.txt,LICENSE,glsl,lib,tests,examples,third_party,docs,README.md,CHANGELOG.md} "$copy"
build=$copy/build
cmake -S "$copy" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
    >/dev/null || exit 1
make() { ninja -C "$build" "$@" >"$copy/log" 2>&1; }
run() { # test, its first argument, the rest as its second
    local program=$build/tests/stability/$1
    [ -x "$program" ] || program=$build/tests/$1
    GALLIVM_PERF=nopt GLSSAO_TEST_CONTEXT=egl timeout 300 "$program" ${2:+"$2"} ${3:+"$3"} >"$copy/log" 2>&1
}
make test_hard_cases test_relations test_random test_inputs test_faults test_projections || { cat "$copy/log"; exit 1; }

held=0 loose=0
declare -A passes # with all guards
mapfile -t lines <"$here/guards.tsv"
for line in "${lines[@]}"; do
    IFS=$'\t' read -r guard file text instead command <<<"$line"
    read -r test first rest <<<"$command"
    [[ $guard == \#* || "$guard $file" != *"${1:-}"* ]] && continue
    if [ -z "${passes[$command]:-}" ]; then
        make "$test" && run "$test" "$first" "$rest" || { echo "$command fails with all guards"; cat "$copy/log"; exit 1; }
        passes[$command]=1
    fi
    cp "$copy/$file" "$copy/kept"
    TEXT=$text INSTEAD=$instead perl -0pi -e 's/\Q$ENV{TEXT}\E/$ENV{INSTEAD}/' "$copy/$file"
    if cmp -s "$copy/$file" "$copy/kept"; then
        answer="NOT FOUND in $file"
    elif ! make "$test"; then
        answer="does not build"
    elif run "$test" "$first" "$rest"; then
        answer="NOT HELD by $test"
    elif [ $? = 124 ]; then
        answer="not run to its end: $test takes too long"
    else
        answer="$test: $(grep -am1 'ERROR: \|FAILED  ] [a-z]' "$copy/log" | sed 's/^ERROR: //; s/^.*FAILED  ] //' | cut -c1-100)"
        held=$((held + 1))
    fi
    [[ $answer == $test:* ]] || loose=$((loose + 1))
    printf '%s\t%s\n' "$guard" "$answer"
    cp "$copy/kept" "$copy/$file"
done
echo "$held guards held, $loose not"
[ "$loose" = 0 ]
