#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# meson.sh SOURCE VERSION: a Meson project that takes the library by third_party/packaging/meson's wrap from a local archive, as a static and
# as a shared library. The wrap, the port and the recipe name this version.
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/common.sh"
source=$1 version=$2 recipes=$1/third_party/packaging
for file in meson/glssao.wrap meson/packagefiles/glssao/meson.build vcpkg/vcpkg.json conan/conanfile.py; do
    grep -q "$version" "$recipes/$file" || fail "third_party/packaging/$file does not name version $version"
done
command -v meson >/dev/null || skip "no meson (Debian and Ubuntu: apt install meson)"
mkdir -p "$scratch/glssao-$version" "$scratch/use/subprojects"
cp -r "$source/lib" "$source/glsl" "$source/CMakeLists.txt" "$source/LICENSE" "$scratch/glssao-$version"
tar -C "$scratch" -czf "$scratch/archive.tar.gz" "glssao-$version"
cp -r "$recipes/meson/." "$scratch/use/subprojects"
cp "$here/consumer.c" "$scratch/use"
sed -i "s|^source_url = .*|source_url = file://$scratch/archive.tar.gz|
    s|^source_hash = .*|source_hash = $(sha256sum "$scratch/archive.tar.gz" | cut -d' ' -f1)|" "$scratch/use/subprojects/glssao.wrap"
cat >"$scratch/use/meson.build" <<'END'
project('consumer', 'c', default_options: ['c_std=c11', 'werror=true', 'warning_level=3'])
executable('consumer', 'consumer.c', dependencies: [dependency('glssao'), meson.get_compiler('c').find_library('m')])
END
for kind in static shared; do
    quietly meson setup -Ddefault_library=$kind "$scratch/$kind" "$scratch/use"
    quietly ninja -C "$scratch/$kind"
    quietly "$scratch/$kind/consumer"
done
echo "meson: static and shared"
