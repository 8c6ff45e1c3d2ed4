#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# recipes.sh SOURCE: the recipes of vcpkg and Conan do what they say, without either: stand-ins for the functions that they call
# configure, build and install this source tree with the recipe's own options. A consumer then finds the package.
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/common.sh"
source=$(realpath "$1") recipes=$(realpath "$1")/third_party/packaging

mkdir "$scratch/use"
cp "$here/cmake/CMakeLists.txt" "$here/consumer.c" "$scratch/use"

# What both recipes promise: CMake knows every option, and a project that asks for the package builds and runs.
try() { # name, prefix
    ! grep -q 'not used by the project' "$scratch/log-$1" || { cat "$scratch/log-$1"; fail "$1: CMake does not know an option"; }
    quietly cmake -S "$scratch/use" -B "$scratch/use-$1" -G Ninja -DWAY=find_package -DCMAKE_PREFIX_PATH="$2"
    quietly cmake --build "$scratch/use-$1"
    quietly "$scratch/use-$1/consumer"
}

cat >"$scratch/vcpkg.cmake" <<END
set(VERSION 0)
set(CURRENT_PACKAGES_DIR "$scratch/vcpkg")
function(vcpkg_download_distfile out)
  set(\${out} archive PARENT_SCOPE)
endfunction()
function(vcpkg_extract_source_archive out)
  set(\${out} "$source" PARENT_SCOPE)
endfunction()
function(vcpkg_cmake_configure)
  cmake_parse_arguments(p "" "SOURCE_PATH" "OPTIONS" \${ARGN})
  execute_process(COMMAND \${CMAKE_COMMAND} -S \${p_SOURCE_PATH} -B "$scratch/build-vcpkg" -G Ninja -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_INSTALL_PREFIX=\${CURRENT_PACKAGES_DIR} -DCMAKE_INSTALL_LIBDIR=lib \${p_OPTIONS} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
function(vcpkg_cmake_install)
  execute_process(COMMAND \${CMAKE_COMMAND} --build "$scratch/build-vcpkg" --target install COMMAND_ERROR_IS_FATAL ANY)
endfunction()
function(vcpkg_cmake_config_fixup)
  cmake_parse_arguments(p "" "CONFIG_PATH" "" \${ARGN})
  file(GLOB found "\${CURRENT_PACKAGES_DIR}/\${p_CONFIG_PATH}/glssao*onfig.cmake")
  if(NOT found)
    message(FATAL_ERROR "no package configuration in \${p_CONFIG_PATH}")
  endif()
endfunction()
function(vcpkg_fixup_pkgconfig)
  file(GLOB_RECURSE found "\${CURRENT_PACKAGES_DIR}/*.pc")
  if(NOT found)
    message(FATAL_ERROR "no .pc file")
  endif()
endfunction()
function(vcpkg_install_copyright)
  cmake_parse_arguments(p "" "" "FILE_LIST" \${ARGN})
  foreach(file IN LISTS p_FILE_LIST)
    file(COPY \${file} DESTINATION "\${CURRENT_PACKAGES_DIR}/share")
  endforeach()
endfunction()
include("$recipes/vcpkg/portfile.cmake")
END
cmake -P "$scratch/vcpkg.cmake" >"$scratch/log-vcpkg" 2>&1 || { cat "$scratch/log-vcpkg"; fail "the vcpkg port"; }
try vcpkg "$scratch/vcpkg"

if ! command -v python3 >/dev/null; then
    echo "recipes.sh: no python3 here: the Conan recipe was not tried"
    exit
fi
mkdir -p "$scratch/conan-stand-in/conan/tools"
cat >"$scratch/conan-stand-in/conan/__init__.py" <<'END'
class ConanFile:
    pass
END
touch "$scratch/conan-stand-in/conan/tools/__init__.py"
cat >"$scratch/conan-stand-in/conan/tools/files.py" <<'END'
import os
import shutil


def get(recipe, url, strip_root=False):
    assert recipe.version in url and strip_root


def copy(recipe, pattern, source, target):
    os.makedirs(target, exist_ok=True)
    shutil.copy(os.path.join(source, pattern), target)
END
cat >"$scratch/conan-stand-in/conan/tools/cmake.py" <<'END'
import subprocess


def cmake_layout(recipe, src_folder):
    assert src_folder


class CMakeToolchain:
    def __init__(self, recipe):
        self.recipe, self.cache_variables = recipe, {}

    def generate(self):
        self.recipe.flags = [f"-D{name}={'ON' if value is True else 'OFF' if value is False else value}"
                             for name, value in self.cache_variables.items()]


class CMake:
    def __init__(self, recipe):
        self.recipe = recipe

    def run(self, *words):
        subprocess.run(["cmake", *words], check=True)

    def configure(self):
        r = self.recipe
        self.run("-S", r.source_folder, "-B", r.build_folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                 f"-DCMAKE_INSTALL_PREFIX={r.package_folder}", "-DCMAKE_INSTALL_LIBDIR=lib",
                 f"-DBUILD_SHARED_LIBS={'ON' if r.options.shared else 'OFF'}", *r.flags)

    def build(self):
        self.run("--build", self.recipe.build_folder)

    def install(self):
        self.run("--install", self.recipe.build_folder)
END
cat >"$scratch/conan.py" <<'END'
import glob
import sys
from types import SimpleNamespace

recipes, source, scratch, shared = *sys.argv[1:4], sys.argv[4] == "shared"
sys.path[:0] = [scratch + "/conan-stand-in", recipes + "/conan"]
from conanfile import Glssao  # noqa: E402

r = Glssao()
r.options, r.settings = SimpleNamespace(shared=shared, fPIC=True), SimpleNamespace(os="Linux")
r.source_folder, r.build_folder, r.package_folder = source, f"{scratch}/build-conan-{shared}", f"{scratch}/conan-{sys.argv[4]}"
properties = {}
r.cpp_info = SimpleNamespace(set_property=properties.__setitem__)
for step in ("layout", "source", "generate", "build", "package", "package_info"):
    getattr(r, step)()
assert properties["cmake_target_name"] == "glssao::glssao"
for name in r.cpp_info.libs:
    assert glob.glob(f"{r.package_folder}/lib/lib{name}.{'so' if shared else 'a'}"), name
assert glob.glob(r.package_folder + "/licenses/LICENSE") and glob.glob(r.package_folder + "/include/glssao/glssao.h")
END
for kind in static shared; do
    PYTHONDONTWRITEBYTECODE=1 python3 "$scratch/conan.py" "$recipes" "$source" "$scratch" $kind >"$scratch/log-conan-$kind" 2>&1 ||
        { cat "$scratch/log-conan-$kind"; fail "the Conan recipe, $kind"; }
    try conan-$kind "$scratch/conan-$kind"
done
echo "recipes: vcpkg and Conan"
