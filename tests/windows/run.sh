#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# run.sh REFERENCE BUILD: runs the WGL tests of build.sh under Wine, on a virtual screen with Mesa's software rasteriser,
# and compares their pictures with those that REFERENCE makes here. Skips where Wine or Xvfb is missing.
set -euo pipefail
reference=$1 build=$2
for wine in wine64 /usr/lib/wine/wine64 wine; do
    command -v "$wine" >/dev/null && break || wine=
done
[ -n "$wine" ] || { echo "run.sh: skipped: no Wine (Debian and Ubuntu: apt install wine64)"; exit 77; }
command -v xvfb-run >/dev/null || { echo "run.sh: skipped: no xvfb-run (Debian and Ubuntu: apt install xvfb xauth)"; exit 77; }
[ -e "$build/static/windows_test.exe" ] || { echo "run.sh: skipped: nothing was built for Windows"; exit 77; }
if [ -z "${INSIDE_XVFB:-}" ]; then
    INSIDE_XVFB=1 LIBGL_ALWAYS_SOFTWARE=1 exec xvfb-run -a -s "-screen 0 800x600x24 -noreset" bash "$0" "$@"
fi
scratch=$(mktemp -d)
export WINEPREFIX=$scratch/wine WINEDEBUG=-all WINEDLLOVERRIDES="mscoree,mshtml=" WINEARCH=win64
server=$(command -v wineserver64 || command -v /usr/lib/wine/wineserver64 || command -v wineserver)
clean_up() {
    "$server" -k 2>/dev/null || true # of this prefix alone
    rm -rf "$scratch"
}
trap clean_up EXIT
# Beside other programs Wine 8 now and then can't load its own kernel32.dll from a prefix that it is still making.
for attempt in 1 2 3 none; do
    [ $attempt != none ] || { echo "run.sh: Wine starts no program: $(tail -1 "$scratch/boot")" >&2; exit 1; }
    timeout 120 "$wine" wineboot --init >"$scratch/boot" 2>&1 && "$server" -w && break
    "$server" -k 2>/dev/null || true
    rm -rf "$WINEPREFIX"
done
"$reference" "$scratch/pictures.raw"
for kind in static shared; do
    mkdir "$scratch/$kind"
    echo "$kind:"
    timeout 300 "$wine" "$build/$kind/windows_test.exe" "Z:${scratch//\//\\}\\pictures.raw" "Z:${scratch//\//\\}\\$kind" \
        2> >(grep -v 'configuration\|syswow64' >&2)
done
