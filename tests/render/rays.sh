#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# rays.sh GLSSAO_RENDER: -t rays and --rays on the command line: files, the plan, same bits, batches, and what they refuse.
set -uo pipefail
render=$1
# shellcheck source=tests/render/fail.sh
. "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/fail.sh"
always=(-s 65x37)

want 2 "--rays" --rays 0 --ao a.pfm
want 2 "--rays" --rays 65 --ao a.pfm
want 2 "--rays 2 and --technique raytrace" --rays 2 -t raytrace --ao a.pfm
want 2 "--rays 2 and --no-ao" --rays 2 --no-ao -o a.png
want 2 "--rays 2 and --error" --rays 2 --error 0.1 --ao a.pfm
want 2 "--adaptive-rays: no rays are traced" --adaptive-rays --ao a.pfm
want 2 "--rays 17: at most 16" --adaptive-rays --rays 17 --ao a.pfm
want 2 "--samples 3: --rays sets" -t rays --samples 3 --ao a.pfm
want 0 "" -t rays --ao a.pfm --plan --stats a.json
check "the plan says what is traced" grep -qE '^tracing +run +0 +65x37 +4 rays' out
check "the plan says that nothing corrects" grep -qE '^rays +skip' out
check "statistics name the technique" grep -q '"technique": "rays"' a.json
want 0 "" -t rays --ao b.pfm
check "the same rays give the same bits" cmp -s a.pfm b.pfm
want 0 "" -t rays --rays 9 --ao c.pfm
check "the number of rays counts" [ "$(cksum <a.pfm)" != "$(cksum <c.pfm)" ]
want 0 "" --ao d.pfm --plan
check "no rays without being asked" grep -qE '^tracing +skip' out
want 0 "" --rays 2 --ao e.pfm --plan
check "rays correct" grep -qE '^rays +run' out
check "a correction changes the result" [ "$(cksum <d.pfm)" != "$(cksum <e.pfm)" ]
want 0 "" -t rays --adaptive-rays --ao k.pfm --plan
check "the plan says that counts differ" grep -qE '^tracing +run +0 +65x37 +about 4 rays' out
check "counts differ" [ "$(cksum <a.pfm)" != "$(cksum <k.pfm)" ]
for quality in low medium high ultra; do
    want 0 "" -t rays -q $quality --margin 8 -o $quality.png --samples-per-pixel 2
    want 0 "" -t classic -q $quality --rays 1 --ao $quality.pfm --frames 2
done
printf '%s\n' '-t rays --ao f.pfm' '-t rays -q low --ao g.pfm' '--rays 1 --ao h.pfm' '-t classic -o i.png' >list
want 0 "" --batch list
check "a batch traces as a single job does" cmp -s a.pfm f.pfm
check "batches mix" [ -s g.pfm -a -s h.pfm -a -s i.png ]
[ $failures = 0 ]
