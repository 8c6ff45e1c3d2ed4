#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# install.sh SOURCE BUILD CC: `cmake --install` of the static build and of a shared one, used by find_package and by
# pkg-config from a scratch folder; what the shared library exports; the static library inside a shared one.
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/common.sh"
source=$1 build=$2 cc=$3 wanted=$(version_of "$1")
cp -r "$here/cmake/." "$here"/*.c "$scratch"
cd "$scratch"
export CC=$cc
unset DESTDIR

quietly cmake --install "$build" --prefix "$scratch/static"
quietly cmake -S "$source" -B shared-build -G Ninja -DBUILD_SHARED_LIBS=ON -DGLSSAO_BUILD_EXAMPLES=OFF -DGLSSAO_BUILD_TESTS=OFF
quietly cmake --build shared-build -j2
quietly cmake --install shared-build --prefix "$scratch/shared"

for kind in static shared; do
    prefix=$scratch/$kind
    quietly cmake -S . -B "use-$kind" -G Ninja -DWAY=find_package -DWANTED=$wanted "-DCMAKE_PREFIX_PATH=$prefix"
    quietly cmake --build "use-$kind"
    quietly "use-$kind/consumer"
    pc=$(dirname "$(find "$prefix" -name glssao.pc)")
    flags=$(PKG_CONFIG_PATH=$pc pkg-config --cflags --libs glssao) || fail "pkg-config does not find the $kind library"
    # shellcheck disable=SC2086
    quietly "$cc" -std=c11 -Wall -Wextra -pedantic -Werror consumer.c $flags -o "by-pkg-config-$kind"
    LD_LIBRARY_PATH=$(dirname "$pc") quietly "./by-pkg-config-$kind"
done

if cmake -S . -B refuse -G Ninja -DWAY=find_package -DWANTED=99 "-DCMAKE_PREFIX_PATH=$scratch/shared" >/dev/null 2>&1; then
    fail "find_package(glssao 99) found version $wanted"
fi

library=$(find shared -name 'libglssao.so')
soname=$(readelf -d "$library" | grep -oP 'SONAME.*\[\K[^]]+')
[ "$soname" = "libglssao.so.$wanted" ] || fail "soname is '$soname', not that of version $wanted"
[ -e "$(dirname "$library")/$soname" ] || fail "$soname is not installed"
names_of_header shared/include/glssao/glssao.h >wanted
[ "$(wc -l <wanted)" -ge 15 ] || fail "only $(wc -l <wanted) functions found in the header"
nm -D --defined-only "$library" | awk '{print $3}' | sort >exported
diff wanted exported || fail "the shared library exports something else than the header declares (< header, > library)"

archive=$(find static -name 'libglssao.a')
foreign=$(nm -g --defined-only "$archive" | awk 'NF == 3 {print $3}' | grep -v '^glssao_' || true)
[ -z "$foreign" ] || fail "global names without the library's prefix: $foreign"

# Hidden visibility keeps the glssao__ names in; --exclude-libs the public ones.
quietly "$cc" -std=c11 -fPIC -shared -Istatic/include plugin.c "$archive" -lm -Wl,--exclude-libs,ALL -o libplugin.so
quietly "$cc" -std=c11 plugin_host.c -L. -lplugin -Wl,-rpath,"$scratch" -o plugin_host
quietly ./plugin_host
[ "$(nm -D --defined-only libplugin.so | awk '{print $3}')" = plugin_version ] || fail "the plugin exports more than its own function"

echo "install: $(wc -l <wanted) functions, $soname, stripped $(strip -o stripped "$library" && stat -c %s stripped) bytes"
