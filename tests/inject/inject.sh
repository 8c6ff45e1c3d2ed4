#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# inject.sh LIBRARY CHECK FOLDER FOREIGN: the preload library in the dropin programs with their own effect off, under Xvfb: in the
# fixed-function one and in the core one, which draw into their window; switched off by the environment and by a signal; in a program of ours that draws as many others do (foreign.c), where the
# picture must be that of a program that hands over its matrix itself. Then in Debian's gears, and in an OpenGL ES program, which
# must run on and get one line that says why nothing happens.
set -euo pipefail
library=$1 check=$2 folder=$3 foreign=$4
if ! command -v xvfb-run >/dev/null; then
    echo "inject.sh: skipped: no xvfb-run (Debian and Ubuntu: apt install xvfb xauth)"
    exit 77
fi
if [ -z "${INSIDE_XVFB:-}" ]; then
    INSIDE_XVFB=1 LIBGL_ALWAYS_SOFTWARE=1 exec xvfb-run -a -s "-screen 0 800x600x24 -noreset" bash "$0" "$@"
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
fail() {
    echo "inject.sh: $*" >&2
    cat log >&2
    exit 1
}
inject() { # name command...
    local name=$1
    shift
    GLSSAO_INJECT_BEFORE=$name-before.ppm GLSSAO_INJECT_PICTURE=$name-after.ppm GLSSAO_INJECT_FRAME=3 \
        LD_PRELOAD=$library timeout 60 "$@" >log 2>&1 || fail "$name: exit code $?"
}

export GLSSAO_INJECT_RADIUS=0.5
for options in "" "--samples 4" "--egl"; do
    # shellcheck disable=SC2086
    inject legacy "$folder/dropin-legacy" --no-ao --frames 5 $options
    grep -q 'glssao-inject: on: 640 x 480, field of view 45.8 degrees, near 0.1, far 50' log || fail "legacy $options: not on"
    "$check" legacy-after.ppm legacy-before.ppm || fail "legacy $options: wrong picture"
done
# Wrong values are named and not used.
GLSSAO_INJECT_FOV=200 GLSSAO_INJECT_NEAR=0.1 GLSSAO_INJECT_FAR=50 GLSSAO_INJECT_POWER=65 GLSSAO_INJECT_QUALITY=best \
    inject wrong "$folder/dropin-legacy" --no-ao --frames 5
for words in 'FOV=200 is not a number from 1 to 179' 'a projection needs all of' 'POWER=65 is not a number from 0 to 64' 'QUALITY=best is none of'; do
    grep -q "$words" log || fail "wrongly told: nothing says \"$words\""
done
cmp wrong-after.ppm legacy-after.ppm || fail "what was told wrongly is used"
GLSSAO_INJECT_FOV=45.8 GLSSAO_INJECT_NEAR=0.1 GLSSAO_INJECT_FAR=50 inject told "$folder/dropin-legacy" --no-ao --frames 5
"$check" told-after.ppm told-before.ppm || fail "projection told by hand: wrong picture"
GLSSAO_INJECT_BEFORE=switched-before.ppm GLSSAO_INJECT_PICTURE=switched-after.ppm GLSSAO_INJECT_FRAME=120 GLSSAO_INJECT_QUALITY=low \
    LD_PRELOAD=$library "$folder/dropin-legacy" --no-ao >log 2>&1 &
for _ in $(seq 200); do
    grep -q 'glssao-inject: on' log && break
    sleep 0.05
done
kill -USR1 $! && wait $! || fail "switched off by a signal: exit code $?"
grep -q 'glssao-inject: on' log && cmp switched-before.ppm switched-after.ppm || fail "the signal does not switch off"
GLSSAO_INJECT_OFF=1 inject off "$folder/dropin-legacy" --no-ao --frames 5
cmp off-before.ppm off-after.ppm || fail "the picture changes although switched off"
inject core "$folder/dropin" --no-ao --frames 5
mv core-after.ppm core-with.ppm
GLSSAO_INJECT_OFF=1 inject core "$folder/dropin" --no-ao --frames 5
"$check" core-with.ppm core-after.ppm || fail "core: wrong picture"
for modes in "ubo ortho" "mapped reversed" range; do
    # shellcheck disable=SC2086
    {
        inject modes "$foreign" $modes --frames 5
        "$foreign" $modes own --frames 2 --picture modes-own.ppm
    }
    "$check" --alike modes-after.ppm modes-before.ppm modes-own.ppm || fail "$modes: wrong picture"
done
# The effect is drawn before the frame ends, so the picture without it comes from a run that is switched off.
for mode in weapon icon small pick post shared resolve contexts; do
    inject on "$foreign" $mode --frames 5
    GLSSAO_INJECT_OFF=1 inject off "$foreign" $mode --frames 5
    "$foreign" $mode own --frames 3 --picture own.ppm
    "$check" --alike on-after.ppm off-after.ppm own.ppm || fail "$mode: wrong picture"
done
# Numbers have a decimal point in every locale.
mkdir locales
if localedef -i de_DE -f UTF-8 locales/de_DE.UTF-8 >/dev/null 2>&1; then
    GLSSAO_INJECT_BEFORE=german-before.ppm GLSSAO_INJECT_PICTURE=german.ppm GLSSAO_INJECT_FRAME=3 LOCPATH=$PWD/locales \
        LD_PRELOAD=$library "$foreign" german --frames 5 >log 2>&1 || fail "german: exit code $?"
    grep -q 'on: .* field of view 45.8 degrees, near 0.1, .*radius 0.5$' log || fail "german: numbers are not read or written as such"
else
    echo "inject.sh: no localedef here: a decimal comma was not tried"
fi
# What was said is corrected when it no longer holds.
LD_PRELOAD=$library "$foreign" zoom --frames 150 >log 2>&1 || fail "zoom: exit code $?"
[ "$(grep -o 'field of view [0-9.]*' log | tr '\n' ,)" = 'field of view 45.8,field of view 22.9,' ] || fail "zoom: not told once each"
LD_PRELOAD=$library "$foreign" several --frames 500 >log 2>&1 || fail "several: exit code $?"
[ "$(grep -c 'glssao-inject: off: ' log)" = 1 ] || fail "several: not told that the effect is off"
unset GLSSAO_INJECT_RADIUS
# An empty depth buffer is told of once, with what to do: after 60 frames, or after 3 seconds where frames are few.
for modes in "empty --frames 70" "empty demand --frames 10"; do
    # shellcheck disable=SC2086
    LD_PRELOAD=$library "$foreign" $modes >log 2>&1 || fail "$modes: exit code $?"
    [ "$(grep -c 'glssao-inject: ' log)" = 1 ] &&
        grep -q 'the depth buffer is empty: .* try it with its post-processing and anti-aliasing switched off, and see docs/inject.md' log ||
        fail "$modes: not told once what to do"
done
LD_PRELOAD=$library "$foreign" empty --frames 50 >log 2>&1 || fail "empty: exit code $?"
! grep -q 'glssao-inject: ' log || fail "empty: told too early"
# A program that draws on demand gets the effect with its second picture of a scene, not after the frames of one that draws all the time.
GLSSAO_INJECT_FRAME=4 GLSSAO_INJECT_PICTURE=demand.ppm LD_PRELOAD=$library "$foreign" demand --frames 5 >log 2>&1 || fail "demand: exit code $?"
grep -q 'glssao-inject: on: ' log || fail "demand: not on after three redraws"

for gears in glxgears eglgears_x11; do
    command -v $gears >/dev/null || { echo "inject.sh: no $gears here (mesa-utils)"; continue; }
    inject $gears $gears
    grep -q 'glssao-inject: on: 300 x 300, field of view 22.6 degrees, near 5, far 60' log || fail "$gears: not on"
    ! cmp -s $gears-before.ppm $gears-after.ppm || fail "$gears: the picture does not change"
done
if command -v es2gears_x11 >/dev/null; then
    inject es2gears es2gears_x11
    [ "$(grep -c 'glssao-inject: ' log)" = 1 ] && grep -q 'no effect in this context (OpenGL ES' log ||
        fail "es2gears: not told in one line why nothing happens"
    cmp es2gears-before.ppm es2gears-after.ppm || fail "es2gears: the picture changes"
fi
echo "inject: good"
