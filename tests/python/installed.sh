#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# installed.sh BUILD PYTHON FOLDER: what `cmake --install` puts below a prefix works there: the module, in FOLDER, finds its
# library and the renderer from its own place, also after the prefix was moved.
. "$(dirname "${BASH_SOURCE[0]}")/../packaging/common.sh"
build=$1 python=$2 folder=$3
"$python" -c "import numpy" 2>/dev/null || skip "no numpy (Debian and Ubuntu: apt install python3-numpy)"
unset DESTDIR GLSSAO_LIBRARY GLSSAO_RENDER
quietly cmake --install "$build" --prefix "$scratch/first"
mv "$scratch/first" "$scratch/moved"
cd "$scratch"
export PYTHONPATH=$scratch/moved/$folder LD_LIBRARY_PATH=$(dirname "$(find moved -name 'libglssao.*' | head -1)")
"$python" -c '
import glssao
depth = glssao.render(output="depth", size=(64, 36), fov=45)
result = glssao.occlusion(depth, glssao.perspective(45, 64, 36), 0.5)
assert glssao.__file__.startswith("'"$scratch"'/moved/"), glssao.__file__
assert result.shape == (36, 64) and result.max() == 1.0 and result.min() < 0.9, (result.min(), result.max())' ||
    fail "the installed module does not work"
[ -e "$PYTHONPATH/glssao/py.typed" ] || fail "no py.typed: type checkers would not look at the hints"
