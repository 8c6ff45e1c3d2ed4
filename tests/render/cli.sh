#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# cli.sh GLSSAO_RENDER: the promises of the command line: exit codes, messages that name the fault and its place, files of
# the right kind and size, the same bits every time.
set -uo pipefail
render=$1
# shellcheck source=tests/render/fail.sh
. "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/fail.sh"

# Width and height stand in a PNG's bytes 16 to 23, most significant first; the colour type in byte 25.
png_is() { # file, width, height, colour type (0 grey, 2 RGB)
    local bytes
    bytes=$(od -An -tu1 -j16 -N10 "$1" 2>/dev/null | tr -s ' \n' '  ')
    # shellcheck disable=SC2086
    set -- "$1" "$2" "$3" "$4" $bytes
    [ $# = 14 ] || { fail "$1 is no PNG"; return; }
    [ "$((($5 << 24) + ($6 << 16) + ($7 << 8) + $8)) $((($9 << 24) + (${10} << 16) + (${11} << 8) + ${12}))" = "$2 $3" ] ||
        fail "$1 is not $2 x $3"
    [ "${14}" = "$4" ] || fail "$1 has colour type ${14} instead of $4"
}

pfm_is() { # file, width, height
    [ "$(head -n 2 "$1" 2>/dev/null)" = "Pf
$2 $3" ] || fail "$1 has not the head of a $2 x $3 one-channel PFM"
    [ "$(wc -c <"$1")" -ge $(($2 * $3 * 4)) ] || fail "$1 is too short"
}

size="-s 65x37"
# shellcheck disable=SC2086
{
    want 0 "" -h
    grep -q -- --blur-rounds out || fail "help does not list the options"
    want 0 "" --version

    # Wrong usage: 2, naming option and value.
    want 2 "nothing to do"
    want 2 "nothing to do" --no-ao
    want 2 "--no-such-option" --no-such-option
    want 2 "-z" -z
    want 2 "--output" -o
    want 2 "--output" -o a.gif
    want 2 ".png" -o .png
    want 2 "--depth" --depth d.png
    want 2 "--ao" --ao a.exr
    want 2 "horizon takes" -t horizon --samples 14 -o a.png
    want 2 "--samples" -t hemisphere --samples 65 -o a.png
    want 2 '"fancy"' -t fancy -o a.png
    want 2 '"best"' --quality best -o a.png
    want 2 '"glx"' --context glx -o a.png
    want 2 '"attic"' --scene attic -o a.png
    for bad in 0x10 10x0 10 x10 10x -5x5 10x10x10 10x99999 1e2x10 99999999999999999999x10 " 10x10" ""; do
        want 2 "--size \"$bad\"" -s "$bad" -o a.png
    done
    for bad in "" abc 1x nan inf -inf 0x10 1e99 " 1" "1 " -1 1,0; do
        want 2 "--radius \"$bad\"" --radius "$bad" -o a.png
    done
    want 2 "--power" --power 65 -o a.png
    want 2 "--intensity" --intensity 1.01 -o a.png
    want 2 "--intensity" --intensity nan -o a.png
    want 2 "--samples" -t classic --samples 15 -o a.png
    want 2 "--samples" --samples 1.5 -o a.png
    want 2 "horizon takes" --set samples=13 -o a.png
    want 2 "at most 14" -t classic --set samples=15 -o a.png
    want 2 "blur-sigma" --set blur-sigma=0.09 -o a.png
    want 2 "--radius" --radius 2e11 -o a.png
    want 2 "--blur-rounds" --blur-rounds 17 -o a.png
    want 2 "--fov" --fov 180 -o a.png
    want 2 "--near" --near 0 -o a.png
    want 2 "--near 5" --near 5 --far 2 -o a.png
    for bad in 1,2 1,2,3,4 1,2,x 1,,3 nan,0,0; do
        want 2 "--eye \"$bad\"" --eye "$bad" -o a.png
    done
    want 2 "--sky-up 0,0,0: has no direction" --sky-up 0,0,0 -o a.png
    want 2 "same point" --eye 1,2,3 --target 1,2,3 -o a.png
    want 2 "--frames" --frames 0 -o a.png
    want 2 "--frames" --frames 3 --plan
    want 2 "--bench" --bench 2 --frames 3 -o a.png
    want 2 "--history" --history 64 --frames 3 -o a.png
    want 2 "--history 8: needs --frames N or --bench N" --history 8 -o a.png
    want 2 "--history 8 and --error cannot be used together" --history 8 --error 0.1 --frames 2 -o a.png
    want 2 "--history 8 and --technique raytrace" --history 8 -t raytrace --frames 2 -o a.png
    want 2 "--history 8 and --no-ao" --history 8 --no-ao --frames 2 -o a.png
    want 2 "--fps 24: needs --frames N and --time SECONDS" --fps 24 --time 1 -o a.png a.glb
    want 2 "--fps 24: reads the file again" --fps 24 --frames 2 --time 1 -o a.png -
    want 2 "--seed" --seed -1 -o a.png
    want 2 "--seed" --seed 4294967296 -o a.png
    want 2 "--no-ao" --no-ao --ao a.png
    want 2 "--plan" --plan=yes
    want 2 "a.png is named for two" -o a.png --ao a.png
    want 2 "b.glb" a.glb b.glb -o a.png
    want 2 "--scene" --scene plane a.glb -o a.png
    [ ! -e a.png ] || fail "wrong usage left a picture"

    # Could not render: 1, naming the file.
    want 1 "none.glb" -o a.png none.glb
    want 1 "no-folder/a.png" -o no-folder/a.png
    mkdir folder.png
    want 1 "folder.png" -o folder.png
    want 1 "no-folder/s.json" --stats no-folder/s.json
    # The line that reports the failure gives the library's reason. In a batch, this line alone names the job.
    want 1 "invalid argument: settings.fade_end = 0.1: less than" $size --set fade-end=0.1,fade-start=3 -o a.png
    want 1 "--camera 3" $size -o a.png --camera 3
    echo '{"asset":' >broken.gltf
    want 1 "broken.gltf" -o a.png broken.gltf
    [ ! -e a.png ] || fail "a run that failed left a picture"

    # Every output, of the right kind and size.
    want 0 "" $size -o a.png --ao a.pfm --normals n.png --depth d.pfm --stats s.json
    png_is a.png 65 37 2
    png_is n.png 65 37 2
    pfm_is a.pfm 65 37
    pfm_is d.pfm 65 37
    grep -q '^context: ' err || fail "stderr does not tell the context"
    if command -v python3 >/dev/null; then
        python3 -m json.tool s.json >json 2>err || fail "s.json is no JSON"
    fi
    for key in program library context scene triangles instances width height settings load setup prepass ao main \
        readback encode draw_calls gpu_ms wall cpu; do
        grep -q "\"$key\":" s.json || fail "s.json has no $key"
    done
    want 0 "" $size --ao a.png
    png_is a.png 65 37 0
    want 0 "" -s1x1 -o tiny.png --ao tiny.pfm
    png_is tiny.png 1 1 2

    # The same command gives the same bits; another seed gives others.
    want 0 "" $size --seed=7 -o a1.png --ao a1.pfm
    want 0 "" $size --seed=7 -o a2.png --ao a2.pfm
    cmp a1.png a2.png || fail "two runs differ"
    cmp a1.pfm a2.pfm || fail "two runs differ"
    want 0 "" $size -t classic --seed 7 --ao a3.pfm
    want 0 "" $size -t classic --seed 8 --ao a4.pfm
    ! cmp -s a3.pfm a4.pfm || fail "the seed changes nothing"
    want 0 "" $size --no-ao -o off.png
    ! cmp -s a1.png off.png || fail "--no-ao changes nothing"

    # Settings reach the effect.
    want 0 "" $size --ao p1.pfm --power 0
    ! cmp -s a1.pfm p1.pfm || fail "--power changes nothing"
    for options in "--radius 0.1" "--samples 12" "--blur-rounds 0" "--quality low" "--eye 3,2,5" "--fov 20"; do
        want 0 "" $size --ao p2.pfm $options --seed 7
        ! cmp -s a1.pfm p2.pfm || fail "$options changes nothing"
    done

    # The picture's own options, which leave accessibility as it is. The columns are matte and have no normal map.
    for options in "--sky-up 0,0,1" "--no-shadows" "--intensity 0.5" "--shadow-size 64" "--multi-bounce" "--bent-normals" "--debug-map ao" "--debug-map normals" \
        "--debug-map depth" "--debug-map random" "--debug-map shadow"; do
        want 0 "" $size --seed=7 -o p3.png --ao p3.pfm $options
        ! cmp -s a1.png p3.png || fail "$options changes nothing"
        cmp a1.pfm p3.pfm || fail "$options changes accessibility"
    done
    for options in "--mapped-normals" "--specular-occlusion"; do
        want 0 "" $size --seed=7 -o p3.png $options
        cmp a1.png p3.png || fail "$options changes a matte scene without normal maps"
    done
    want 2 "--no-shadows cannot be used" --no-shadows --shadow-size 64 -o b.png
    want 2 "--debug-map" --debug-map ao --no-ao -o b.png
    want 2 "--debug-map" --debug-map ao --ao b.png
    want 2 "bent-normals=on" --debug-map bent -o b.png
    for options in "-t classic" "--set bent-normals=off" "--history 4 --frames 2"; do
        want 2 "--bent-normals: needs -t horizon" --bent-normals -o b.png $options
    done
    want 2 "--no-ao and --bent-normals" --bent-normals --no-ao -o b.png
    want 2 '"stencil"' --debug-map stencil -o b.png

    # A picture of the surroundings, of one colour: it lights the scene, without the built-in sun.
    {
        printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n'
        for _ in $(seq 32); do printf '\100\200\100\200'; done
    } >green.hdr
    want 0 "" $size --seed=7 -o p4.png --ao p4.pfm --environment green.hdr --plan
    ! cmp -s a1.png p4.png || fail "--environment changes nothing"
    cmp a1.pfm p4.pfm || fail "--environment changes accessibility"
    grep -q '^environment  *use' out || fail "the plan uses no environment"
    grep -q '^shadow map  *skip .*no directional light' out || fail "the built-in sun shines into an environment"
    head -c 60 green.hdr >cut.hdr
    want 1 "cut.hdr: the Radiance picture is cut off" $size -o b.png --environment cut.hdr
    want 1 "none.hdr: No such file" $size -o b.png --environment none.hdr
    want 1 "a1.png: 65 x 37 pixels; an environment is twice as wide" $size -o b.png --environment a1.png
    want 2 "--environment" --environment sky.exr -o b.png
    want 0 "" $size --ao p5.pfm --environment none.hdr # which nothing reads

    # Turntable, plan, benchmark.
    want 0 "" $size --frames 3 -o turn.png
    grep -q "frame 3 of 3" err || fail "no progress"
    for i in 1 2 3; do png_is "turn-000$i.png" 65 37 2; done
    want 0 "" $size -q low --frames 3 --history 8 --ao reused.pfm --plan --stats reused.json
    grep -q '^history  *run  *2' out || fail "the plan has no history"
    grep -q '"history": 8' reused.json || fail "statistics have no history"
    want 0 "" $size -q low --frames 3 --ao alone.pfm
    cmp -s reused-0003.pfm alone-0003.pfm && fail "no picture is reused"
    [ ! -e turn.png ] || fail "a turntable leaves a picture without a number"
    cmp -s turn-0001.png turn-0002.png && fail "the turntable stands still"
    want 0 "" $size --plan
    grep -q '^main  *run' out || fail "the plan has no main pass"
    grep -q '^shadow map  *use' out || fail "the plan has no shadow map"
    grep -q '^normal maps  *skip' out || fail "the plan uses normal maps that are not there"
    want 0 "" $size --plan --stats plan.json
    for pass in inputs normals distance tiles estimate resolve blur upsample; do
        planned=$(awk -v pass=$pass '$1 == pass { print $2 == "run" ? $3 : 0 }' out)
        drawn=$(sed -n "s/.*\"name\": \"$pass\", \"draw_calls\": \([0-9]*\).*/\1/p" plan.json)
        [ -n "$planned" ] && [ "$planned" = "$drawn" ] || fail "$pass: planned $planned draws, made $drawn"
    done
    want 0 "" $size --plan --no-ao
    grep -q '^occlusion  *skip' out || fail "the plan of --no-ao runs occlusion"
    want 0 "" -s 320x180 --plan --no-ao
    grep -q '^pre-pass  *run' out || fail "the plan has no pre-pass although there are more pixels than triangles"
    want 0 "" -s 4x4 --plan --no-ao
    grep -q '^pre-pass  *skip' out || fail "the plan has a pre-pass although there are more triangles than pixels"
    want 0 "" -s 4x4 --plan --no-ao --depth d.pfm
    grep -q '^pre-pass  *run' out || fail "the plan has no pre-pass for --depth"
    want 0 "" $size --bench 3
    grep -q 'median.*p95' out || fail "the benchmark prints no times"

    # Estimates added up to an error, or for a time.
    want 0 "" $size --ao e1.pfm --error 0.02 --stats e1.json
    want 0 "" $size --ao e2.pfm --error 0.002 --stats e2.json
    grep -q "estimates in .* (at most 0.002)" out || fail "--error does not say what was reached"
    estimates() { sed -n 's/.*"estimates": \([0-9]*\).*/\1/p' "$1"; }
    [ "$(estimates e2.json)" -gt "$(estimates e1.json)" ] || fail "a smaller --error takes no more estimates"
    awk -F'[:,]' '/"sampling_error"/ { exit !($2 > 0 && $2 <= 0.002) }' e2.json || fail "--error was not reached"
    want 0 "" $size --ao e3.pfm --budget 0.001 --stats e3.json
    [ "$(estimates e3.json)" = 1 ] || fail "a budget that is spent at once takes more than one estimate"
    grep -q "estimates in .* (budget 0.001 ms)" out || fail "--budget does not say what was reached"
    want 2 "--error 0.01: only the horizon technique" -t classic --error 0.01 --ao e4.pfm
    want 2 "--budget and --bench cannot be used together" --budget 10 --bench 3
    want 2 "--error and --no-ao cannot be used together" --error 0.01 --no-ao -o e4.png

    # Programs kept for the next run, which draws the same; a folder that is not there is told.
    mkdir programs
    for run in 1 2; do
        want 0 "" $size --context egl --ao "c$run.pfm" --program-cache programs
        for file in programs/*.bin; do
            [ -s "$file" ] || fail "--program-cache keeps nothing"
            [ $run = 1 ] || [ ! "$file" -nt c1.pfm ] || fail "--program-cache compiles $file again"
        done
    done
    cmp c1.pfm c2.pfm || fail "--program-cache changes the picture"
    want 1 "--program-cache no-folder: no such folder" $size --ao c3.pfm --program-cache no-folder

    # Built-in scenes and both kinds of context.
    for scene in columns cornell steps plane; do
        want 0 "" $size --scene $scene -o scene.png
    done
    want 0 "" $size --context egl -o scene.png
    if ldconfig -p 2>/dev/null | grep -q libOSMesa; then
        want 0 "" $size --context osmesa -o scene.png
    fi

    # A file of one triangle, with a perspective and an orthographic camera.
    cat >triangle.gltf <<'GLTF'
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
 "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0.3, 0.3, 3]}, {"camera": 1, "translation": [0.3, 0.3, 3]}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.6, "znear": 0.1}},
             {"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 2, "znear": 0.1, "zfar": 10}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}
GLTF
    want 0 "" $size -o t1.png triangle.gltf
    want 0 "" $size -o t2.png --camera 1 triangle.gltf
    want 0 "" $size -o t3.png --camera 2 triangle.gltf
    cmp t1.png t2.png || fail "the first camera is not the default"
    ! cmp -s t2.png t3.png || fail "--camera changes nothing"
    want 1 "--camera 3: triangle.gltf" $size -o t4.png --camera 3 triangle.gltf
    want 1 "triangle.gltf: it has no animation" $size -o t4.png --time 1 triangle.gltf
    want 2 "--time 1: a built-in scene" --time 1 -o t4.png
    want 2 '--time "-1"' --time -1 -o t4.png triangle.gltf
    want 1 "" -s 16x16 --eye 0,0,0 --target 0,1,0 --up 0,1,0 -o t4.png
}

[ $failures = 0 ] && echo "all holds"
exit $((failures > 0))
