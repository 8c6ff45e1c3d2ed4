#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# shaders.sh VALIDATOR FOLDER: the example renderer's shaders, judged by glslangValidator: each macro alone, and
# all but each one, with light; some without.
set -uo pipefail
validator=$1
cd "$2" || exit 1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
macros=(TEXTURED BASE_MAPPED COLORED MASKED DOUBLE_SIDED BLENDED NORMAL_MAPPED REFLECTIVE ROUGHNESS_MAPPED BAKED EMISSIVE
    EMISSION_MAPPED SHADOWED LIGHTS SPECULAR_OCCLUSION MULTI_BOUNCE BEHIND ENVIRONMENT FLAT MORE_UVS BENT)
programs=0 failures=0
# Put together as program.c does: shared functions behind #version.
for pass in main normals; do
    { head -n 1 $pass.frag; cat surface.glsl environment.glsl bent.glsl; tail -n +2 $pass.frag; } >"$work/$pass.frag"
done
check() {
    programs=$((programs + 1))
    if ! out=$("$validator" -l "$@" 2>&1); then
        failures=$((failures + 1))
        echo "$*: $out"
    fi
}
check_variant() { # LIT, then the macros that are 1
    local lit=$1 defines=() value
    shift
    case " $* " in *MAPPED*|*BAKED*) set -- "$@" TEXTURED ;; esac
    for macro in "${macros[@]}"; do
        value=0
        case " $* " in *" $macro "*) value=1 ;; esac
        defines+=("-D$macro=$value")
    done
    check "-DLIT=$lit" "${defines[@]}" scene.vert "$work/main.frag"
    case " $* " in
    *BLENDED*|*SHADOWED*|*LIGHTS*|*BAKED*|*EMISSI*|*REFLECTIVE*|*BOUNCE*|*SPECULAR*|*ROUGH*) ;;
    *) check "-DLIT=$lit" "${defines[@]}" scene.vert "$work/normals.frag" ;;
    esac
}
check_variant 0
check_variant 0 BASE_MAPPED COLORED MASKED
check_variant 0 BASE_MAPPED COLORED BLENDED
check_variant 0 BEHIND
check_variant 0 BASE_MAPPED COLORED MASKED BEHIND
check_variant 1 "${macros[@]}"
for i in "${!macros[@]}"; do
    check_variant 1 "${macros[i]}"
    check_variant 1 "${macros[@]:0:i}" "${macros[@]:i+1}"
done
check_variant 1 BASE_MAPPED COLORED MASKED DOUBLE_SIDED NORMAL_MAPPED
{ head -n 1 sky.frag; cat environment.glsl; tail -n +2 sky.frag; } >"$work/sky.frag"
check -DENVIRONMENT=0 sky.vert "$work/sky.frag"
check -DENVIRONMENT=1 sky.vert "$work/sky.frag"
check fullscreen.vert map.frag
check fullscreen.vert view_distance.frag
for shader in *.vert *.frag; do
    head -n 1 "$shader" | grep -qx '#version 330' || { echo "$shader does not begin with #version 330"; failures=$((failures + 1)); }
done
echo "$programs programs, $failures failures"
[ $failures = 0 ]
