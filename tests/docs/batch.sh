#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# batch.sh PAGE GLSSAO_RENDER: the options that the page's commands give glssao-render are ones that --help lists.
set -euo pipefail
page=$1
options() { grep -oE -- '--[a-z][a-z-]*' | sort -u; }
used=$(sed -n 's/.*glssao-render \(-[^`]*\).*/\1/p' "$page" | options)
[ "$(wc -w <<<"$used")" -ge 2 ] || { echo "batch.sh: found no commands in $page" >&2; exit 1; }
unknown=$(comm -23 <(echo "$used") <("$2" --help | options))
[ -z "$unknown" ] || { echo "batch.sh: $page uses $unknown" >&2; exit 1; }
