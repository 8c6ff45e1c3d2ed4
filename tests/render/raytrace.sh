#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# raytrace.sh GLSSAO_RENDER: -t raytrace on the command line: files, statistics, same bits, and what it refuses.
set -uo pipefail
render=$1
# shellcheck source=tests/render/fail.sh
. "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/fail.sh"
always=(-t raytrace -s 65x37)

want 2 "--samples" --samples 65537 --ao a.pfm
want 2 "--samples" --samples 0 --ao a.pfm
want 2 "--blur-rounds 2" --blur-rounds 2 --ao a.pfm
want 2 "--bench 3" --bench 3
want 0 "" --samples 8 --ao a.pfm --stats a.json --seed 1
want 0 "" --samples 8 --ao b.pfm --seed 1
want 0 "" --samples 8 --ao c.pfm --seed 2
check "the same seed gives the same bits" cmp -s a.pfm b.pfm
check "another seed gives others" [ "$(cksum <a.pfm)" != "$(cksum <c.pfm)" ]
check "a PFM holds a float a pixel" [ "$(wc -c <a.pfm)" -ge $((65 * 37 * 4)) ]
check "statistics tell rays" grep -qE '"rays": [1-9][0-9]*' a.json
check "statistics tell rays a second" grep -qE '"rays_per_second": [1-9][0-9]*' a.json
check "statistics name the technique" grep -q '"technique": "raytrace"' a.json
want 0 "" --samples 8 -o p.png --ao p-ao.png --normals p-n.png --depth p.pfm --power 2
check "a picture is written" [ -s p.png ]
want 0 "" --samples 8 -o n.png --no-ao
check "occlusion darkens the picture" [ "$(cksum <p.png)" != "$(cksum <n.png)" ]
want 0 "" --samples 2 --frames 3 --ao t.png
check "a turntable is written" [ -s t-0003.png ]
[ $failures = 0 ]
