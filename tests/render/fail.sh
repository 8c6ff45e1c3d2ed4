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
