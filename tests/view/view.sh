#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# view.sh GLSSAO_VIEW GLSSAO_RENDER EYES HANDS: the viewer as a person uses it: real keys and mouse on a virtual screen,
# a file dropped, the window minimised, and screenshots. Starts an X server of its own. Pictures stay in GLSSAO_VIEW_SHOTS where that names a folder.
set -uo pipefail
view=$1
render=$2
eyes=$3
hands=$4
cases=$(dirname "$(realpath "${BASH_SOURCE[0]}")")/../cases
work=${GLSSAO_VIEW_SHOTS:-$(mktemp -d)}
server=
viewer=
# shellcheck source=tests/render/moving_triangle.sh
. "$(dirname "${BASH_SOURCE[0]}")/../render/moving_triangle.sh"
# shellcheck disable=SC2086
finish() {
    kill $viewer $server 2>/dev/null
    wait
    [ -n "${GLSSAO_VIEW_SHOTS:-}" ] || rm -rf "$work"
}
trap finish EXIT
cd "$work" || exit 1
# Without -noreset it starts anew whenever its last client leaves, and refuses who comes meanwhile.
Xvfb -displayfd 4 -screen 0 800x600x24 -nolisten tcp -noreset 4>display 2>server.err &
server=$!
for try in $(seq 100); do
    [ -s display ] && break
    sleep 0.05
done
[ -s display ] || { cat server.err; exit 1; }
DISPLAY=:$(<display)
export DISPLAY
failures=0
window=

fail() {
    echo "FAILED: $*"
    failures=$((failures + 1))
}

# The newest screenshot is taken again for a while: on a busy machine a picture stands still before it is the last one, a
# title changes, or a dialog goes, a moment before the picture.
again() { # try, one, other: true where there is something to take again
    [ "$1" -lt 20 ] && { [ "$2" = "$last" ] || [ "$3" = "$last" ]; } || return 1
    sleep 0.2
    "$eyes" shot "$window" "$last"
}
same() { # what, one, other, [X,Y,WxH]
    local count try
    for try in $(seq 20); do
        count=$("$eyes" differ "$2" "$3" ${4:+"$4"})
        [ "$count" = 0 ] && return
        again "$try" "$2" "$3" || break
    done
    fail "$1: $2 and $3 differ in $count pixels"
}
different() { # what, at least, one, other
    local count try
    for try in $(seq 20); do
        count=$("$eyes" differ "$3" "$4")
        [ "$count" -ge "$2" ] 2>/dev/null && return
        again "$try" "$3" "$4" || break
    done
    fail "$1: $3 and $4 differ in $count pixels alone"
}

# The picture saved last is that one, within what rounding moves.
close() {
    local rms
    rms=$("$eyes" rms saved.png "$1")
    awk -v rms="$rms" 'BEGIN { exit !(rms != "" && rms <= 0.005) }' || fail "saved.png and $1 differ by $rms"
}

# A screenshot once the window shows something else than in the last one, and then stands still.
last=
shot() {
    "$eyes" shot "$window" "$1.png" ${last:+"$last"}
    last=$1.png
}
press() {
    xdotool key --delay 20 "$@"
    sleep 0.05
}
# Waits until the command is true, for up to a minute: a line of typed text takes two frames a letter, and sanitizers draw slowly.
await() {
    local try
    for try in $(seq 600); do
        "$@" && return
        sleep 0.1
    done
    fail "never: $*"
}
has_title() { [ "$(xdotool getwindowname "$window")" = "$1" ]; }
# The command line that the viewer prints, and the picture that it saves, after keys that come in one go with these.
save() {
    rm -f saved.png
    xdotool key --delay 1 "$@" ctrl+c ctrl+s
    await test -s saved.png
    sleep 0.1
    command=$(tail -n 1 view.out)
    case $command in "glssao-render "*) ;; *) fail "no command line: $command" ;; esac
    eval "draw ${command#glssao-render }"
    same "the command line: $command" saved.png picture.png
}
work_us() { awk '{printf "%d", $1 / 1000}' /proc/$viewer/schedstat; } # the main thread's, on the processor
draw() { "$render" "$@" 2>/dev/null || fail "glssao-render $*"; }
# Each frame alone, unless `history` says how many count.
start() {
    "$view" --history "${history:-0}" "$@" >view.out 2>view.err &
    viewer=$!
    local try
    for try in $(seq 200); do # it has the scene's name once the picture is whole
        window=$(xdotool search --onlyvisible --name '^(columns|plane|steps|cornell|moving.gltf|off1000000.glb|utm-node.glb)$' 2>/dev/null | head -n 1)
        [ -n "$window" ] && break
        kill -0 $viewer 2>/dev/null || break
        sleep 0.05
    done
    [ -n "$window" ] || { cat view.err; fail "no window"; exit 1; }
    xdotool mousemove 400 200 windowfocus "$window"
    "$eyes" shot "$window" started.png
    last=started.png
}
stop() {
    press ctrl+q
    local try
    for try in $(seq 100); do
        kill -0 $viewer 2>/dev/null || break
        sleep 0.1
    done
    [ "$try" -lt 100 ] || { fail "the viewer does not leave" && kill $viewer; }
    wait $viewer || fail "the viewer left with $?"
    viewer=
    grep -i 'opengl error\|glssao: error\|Sanitizer' view.err && fail "errors on stderr"
}

# Nobody does anything: nothing is drawn again.
start -s 320x200 --scene plane
sleep 0.8
stop
read -r frames updates < <(sed -n 's/.*; \([0-9]*\) frames drawn, \([0-9]*\) screen updates.*/\1 \2/p' view.err)
[ "${frames:-99}" -le 2 ] || fail "$frames frames for a picture that stands still"
[ "${updates:-99}" -le 25 ] || fail "$updates screen updates while nothing happens"

# With a history, the view at rest comes to the picture of --error, whether it moved before or not, and then rests.
history=16 start -s 240x160 --scene columns -o saved.png
press g
save
[[ $command = *" --error 0.002 "* ]] || fail "left out: $command"
press Left Left
save
sleep 0.5
before=$(work_us)
sleep 1
work=$(($(work_us) - before))
[ "$work" -le 50000 ] || fail "at rest it works for $work microseconds in a second"
stop
read -r reused rests < <(sed -n 's/.*; \([0-9]*\) frames with a history, \([0-9]*\) steps at rest.*/\1 \2/p' view.err)
[ "${reused:-0}" -ge 2 ] || fail "$reused frames with a history"
[ "${rests:-0}" -ge 20 ] || fail "$rests steps at rest"

# Minimised, it does not even blink, and comes back as it was.
start -s 320x200 --scene plane
press g 4
"$hands" minimise "$window" || fail "not minimised"
sleep 0.3
before=$(work_us)
sleep 2
work=$(($(work_us) - before))
[ "$work" -le 2000 ] || fail "minimised it works for $work microseconds in 2 seconds"
"$hands" restore "$window" || fail "not restored"
xdotool windowfocus "$window"
press 1
shot restored
draw -s 320x200 --scene plane -o render-restored.png
same "restored" restored.png render-restored.png
stop

# What the command line leaves out, since glssao-render would refuse it: options of the horizon technique with another
# one, maps of occlusion where there is none.
start -s 320x200 --scene plane -o saved.png --layers 2 --error 0.0625 --path compute --debug-map ao --near 0.5 --far 90
press g
save
[[ $command = *"--near 0.5 --far 90 --layers 2 --error 0.0625 --path compute --debug-map ao"* ]] || fail "left out: $command"
press Tab
save
save Left Left bracketright 2
press f Next
await has_title columns
save
[[ $command = *"--near"* ]] && fail "another scene has the planes of the one before: $command"
stop

# Light by bent normals, which horizon alone has.
start -s 320x200 --bent-normals --scene steps -o saved.png
press g
save
[[ $command = *" --bent-normals"* ]] || fail "left out: $command"
draw -s 320x200 --scene steps -o by-accessibility.png
different "lit by bent normals" 5000 saved.png by-accessibility.png
save 2
press 1
save Tab
[[ $command = *bent* ]] && fail "bent normals of another technique: $command"
stop

# Rays: the view at rest comes near what many rays say. The camera moves and the window closes while others are traced.
if "$render" -s 320x200 -t rays --rays 64 --scene columns -o many.png 2>rays.err; then
    draw -s 320x200 --scene columns -o none.png
    start -s 320x200 -t rays -q high --adaptive-rays --scene columns -o saved.png
    press g
    for try in $(seq 60); do
        rm -f saved.png
        press ctrl+s
        await test -s saved.png
        sleep 0.2
        rms=$("$eyes" rms saved.png many.png)
        awk -v rms="$rms" 'BEGIN { exit !(rms != "" && rms <= 0.004) }' && break
    done
    [ "$try" -lt 60 ] || fail "rays come no nearer than $rms to many of them, $("$eyes" rms none.png many.png) without any"
    press Left Left
    stop
    read -r drawn < <(sed -n 's/.*; \([0-9]*\) frames drawn.*/\1/p' view.err)
    [ "${drawn:-0}" -ge 4 ] || fail "$drawn frames for 16 rounds and two views more"
else
    grep -q 'this glssao-render was built without Embree' rays.err || fail "$(cat rays.err)"
    "$view" -t rays 2>rays.err && fail "rays without Embree"
    grep -q 'this glssao-view was built without Embree' rays.err || fail "$(cat rays.err)"
fi

# A file at a time.
moving_triangle moving.gltf 0.3
start -s 320x200 -o saved.png --time 0.5 moving.gltf
press g
save
draw -s 320x200 -o resting.png moving.gltf
different "the file at half a second and as it stands" 500 saved.png resting.png
stop

# Far from the origin the camera turns as at it: what is seen there is what a copy shows whose nodes are moved back.
for file in "off1000000.glb 1000000.0 0.0 -1000000.0" "utm-node.glb 512345.678 35.2 -5401234.5"; do
    read -r name x y z <<<"$file"
    far="$x, $y, $z"
    LC_ALL=C sed "s/$far/$(printf "%${#far}s" '0, 0, 0')/g" "$cases/$name" >near.glb
    start -s 320x200 -o saved.png "$cases/$name"
    press g
    save
    draw -s 320x200 -o framed.png near.glb
    close framed.png
    xdotool mousemove 200 100 mousedown 1 mousemove 230 90 mousemove 260 80 mouseup 1
    xdotool click 4
    save
    different "turned" 2000 saved.png framed.png
    view_arguments=$(sed -n 's/.*\(--eye [^ ]* --target [^ ]*\).*/\1/p' <<<"$command" | awk -F'[ ,]' -v x="$x" -v y="$y" -v z="$z" '{
        printf "--eye %.9f,%.9f,%.9f --target %.9f,%.9f,%.9f", $2 - x, $3 - y, $4 - z, $6 - x, $7 - y, $8 - z }')
    # shellcheck disable=SC2086
    draw -s 320x200 $view_arguments -o turned.png near.glb
    close turned.png
    stop
done

# It overwrites nothing that it reads, and saves in the formats that glssao-render has.
draw -s 64x32 --scene plane -o sky.png
cp sky.png sky-kept.png
start -s 320x160 --scene plane --environment sky.png -o sky.png
press ctrl+s
await grep -q 'sky.png: would overwrite' view.err
cmp sky.png sky-kept.png || fail "the viewer overwrote the picture that lights the scene"
stop
start -s 320x160 --scene plane -o saved.jpg
press ctrl+s
await test -s saved.jpg
stop

# The panel leaves a part of the window free, and the scene is in it; the command line says where the camera stands.
start -s 800x400 --camera none --scene cornell -o saved.png
save
[[ $command = *" --eye "*" --target "* ]] || fail "with the panel, the command line has no camera: $command"
draw -s 800x400 --camera none --scene cornell -o whole.png
different "framed beside the panel" 20000 saved.png whole.png
press g
save
[[ $command = *" --eye "* ]] && fail "without the panel, the command line has a camera: $command"
same "framed without the panel" saved.png whole.png
stop
start -s 800x400 --view 60,40 --ortho --scene steps -o saved.png
save
press g
save
[[ $command = *" --view 60,40 --ortho"* ]] || fail "left out: $command"
stop

# Several samples a pixel and a background, with and without occlusion; maps belong to the pixels' centres.
start -s 640x400 --samples-per-pixel 3 --background '#204060' --scene steps -o saved.png
save
[[ $command = *" --background '#204060'"*" --samples-per-pixel 3"* ]] || fail "left out: $command"
draw -s 640x400 --background '#204060' --scene steps -o one-sample.png
press g
save
different "several samples" 500 saved.png one-sample.png
save 2
[[ $command = *" --no-ao"* ]] || fail "not off: $command"
press 1 n
shot sampled-normals
draw -s 640x400 --scene steps --normals render-normals.png
same "normals under several samples" sampled-normals.png render-normals.png
stop
start -s 640x400 --background none --scene cornell -o saved.png
save
[ "$(od -An -tu1 -j25 -N1 saved.png)" -eq 6 ] || fail "a picture without background has no alpha"
stop

# Options that it has not are refused, as its help says.
"$view" --help >help
for option in --ao --normals --depth --frames --stats --plan --bench --context --margin --batch; do
    grep -q -- " $option " help && fail "the help has $option"
    "$view" "$option" x.png 2>view.err
    [ $? = 2 ] || fail "$option is taken"
    grep -q -- "$option: glssao-render takes it" view.err || fail "$option: stderr says $(<view.err)"
done

start -s 640x400 --set tiles=on -o saved.png
press g # the panel away
shot on
draw -s 640x400 --set tiles=on -o render-on.png
draw -s 640x400 --no-ao -o render-off.png
same "on the screen is what glssao-render draws" on.png render-on.png
different "the panel is seen" 20000 started.png on.png

press 2
shot off
same "off" off.png render-off.png
different "on and off" 2000 on.png off.png

press 3
shot split
same "left of the line" split.png off.png 0,40,200x340
same "right of the line" split.png on.png 440,40,200x340
xdotool mousemove 320 200 mousedown 1 mousemove 250 210 mousemove 120 200 mouseup 1
shot moved
same "right of the moved line" moved.png on.png 140,40,480x340
same "left of the moved line" moved.png off.png 0,40,100x340
different "the line moved" 300 split.png moved.png

press 4
for try in 1 2 3 4 5; do # on a busy machine it may blink back before the look that sees it still
    "$eyes" shot "$window" blink.png
    "$eyes" shot "$window" blink-other.png blink.png
    [ "$("$eyes" differ blink.png blink-other.png)" = 0 ] || break
done
last=blink-other.png
different "blink" 2000 blink.png blink-other.png
press 1
sleep 0.3
"$eyes" shot "$window" still.png
last=still.png

# Maps.
draw -s 640x400 --set tiles=on --ao render-ao.png --normals render-normals.png
press o
shot ao
same "accessibility" ao.png render-ao.png
press n
shot normals
same "normals" normals.png render-normals.png
for map in u v x h z; do
    before=$last
    press $map
    shot map-$map
    different "map $map" 20000 map-$map.png "$before"
done
[ "$("$eyes" colors map-z.png)" -gt 1 ] || fail "no tile is left out, or the map does not show it"
press t
shot truth # black until the first rays are there
[ "$("$eyes" colors truth.png)" -gt 50 ] || shot truth
[ "$("$eyes" colors truth.png)" -gt 50 ] || fail "no difference to the ray-traced reference"
press p

# The camera by mouse and key; the command line makes the same picture.
xdotool mousemove 400 200 mousedown 1 mousemove 430 190 mousemove 470 180 mouseup 1
xdotool click 4
press comma
press bracketright
press w
shot turned
different "dragging turns" 20000 on.png turned.png
save
same "what is saved is what is shown" saved.png turned.png 0,0,640x300

# Help, another scene, a file by its name, one that is broken.
press F1
shot help
different "help" 20000 turned.png help.png
press F1
shot closed
press Next
await has_title cornell
shot cornell
different "the next scene" 50000 turned.png cornell.png
cat >triangle.gltf <<'GLTF'
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [4, 1, 1]}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}
GLTF
echo '{"asset":' >broken.gltf
press ctrl+o
shot opening
xdotool type --delay 5 triangle.gltf
press Return
await has_title triangle.gltf
shot triangle
different "the opened file" 50000 cornell.png triangle.png
press ctrl+o
shot opening
press ctrl+a
xdotool type --delay 5 broken.gltf
press Return
await grep -q 'glssao-view: .*broken.gltf' view.err
has_title triangle.gltf || fail "a broken file took the scene away"
press Escape
shot closed
sed 's/"scale": \[4, 1, 1\]/"scale": [1, 4, 1]/' triangle.gltf >'dropped one.gltf'
"$hands" drop "$window" "$PWD/dropped one.gltf" || fail "the dropped file is refused"
await has_title 'dropped one.gltf'
shot dropped
different "the dropped file" 20000 triangle.png dropped.png
cp broken.gltf 'broken too.gltf'
"$hands" drop "$window" "$PWD/broken too.gltf" || fail "the dropped file is refused"
await grep -q 'glssao-view: .*broken too.gltf' view.err
has_title 'dropped one.gltf' || fail "a broken file that was dropped took the scene away"

# A picture that lights the scene, and one that is none.
{
    printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n'
    for _ in $(seq 32); do printf '\100\200\100\200'; done
} >'light it.hdr'
"$hands" drop "$window" "$PWD/light it.hdr" || fail "the dropped picture is refused"
shot lit
different "the dropped picture" 100000 dropped.png lit.png
save
[[ $command = *"--environment"*"light it.hdr"* ]] || fail "the command line has no environment: $command"
echo no picture >none.hdr
"$hands" drop "$window" "$PWD/none.hdr" || fail "the dropped picture is refused"
await grep -q 'glssao-view: .*none.hdr: neither a sound' view.err
save

# Resized: the camera that frames the scene follows.
xdotool windowsize "$window" 300 400
sleep 0.3
save
[[ $command = *" -s 300x400 "* ]] || fail "the picture did not take the window's size: $command"
stop

[ $failures = 0 ] && echo "all holds"
exit $((failures > 0))
