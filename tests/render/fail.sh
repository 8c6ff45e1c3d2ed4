# SPDX-License-Identifier: MIT
# fail.sh, read by tests that run a program in a folder of their own: makes the folder, enters it, and counts what went wrong.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

# The last run's stderr is expected in the file err.
fail() {
    echo "FAILED: $*"
    sed 's/^/    /' err
    failures=$((failures + 1))
}

# want CODE WORDS ARGUMENTS...: `$render`, with `always` and these arguments, ends with this code, and WORDS (fixed text) are in its last
# line on stderr.
always=()
want() {
    local code=$1 words=$2
    shift 2
    "$render" "${always[@]}" "$@" >out 2>err
    local got=$?
    [ "$got" = "$code" ] || fail "$*: exit $got instead of $code"
    [ -z "$words" ] || tail -n 1 err | grep -qF -- "$words" || fail "$*: the last line does not say \"$words\""
}
check() { # words, then a command
    local words=$1
    shift
    "$@" || fail "$words"
}
