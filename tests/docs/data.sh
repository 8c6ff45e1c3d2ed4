#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# data.sh FOLDER: every table of FOLDER is tab-separated, begins with a comment that says what made it, and has as many
# columns in each row as in the row of names.
set -euo pipefail
count=0 faults=0
for table in "$1"/*.tsv; do
    [ -e "$table" ] || { echo "data.sh: no tables in $1" >&2; exit 1; }
    count=$((count + 1))
    awk -F '\t' -v name="$(basename "$table")" '
        NR == 1 && !/^# ./ { print name ": line 1 does not say what made it"; ++faults }
        /^#/ { next }
        !columns { columns = NF; next }
        NF != columns { print name ": line " NR ": " NF " columns, not " columns; ++faults }
        { ++rows }
        END {
            if (!rows) print name ": no rows"
            exit !rows || faults > 0
        }' "$table" || faults=$((faults + 1))
done
echo "$count tables, $faults with faults"
[ "$faults" = 0 ]
