#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# state_covers_api.sh HEADER TEST.c: every public function is called in the test that compares the host's state.
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
missing=()
for name in $(names_of_header "$1"); do
    grep -q "\b$name(" "$2" || missing+=("$name")
done
[ ${#missing[@]} = 0 ] || fail "$(basename "$2") does not call: ${missing[*]}"
