#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# debian.sh SOURCE VERSION BUILD: the Debian metadata names this version, its soname and what is installed.
# third_party/build-debian.sh builds the packages, which takes minutes.
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
source=$1 version=$2 build=$3 debian=$1/third_party/debian
command -v dpkg-parsechangelog >/dev/null || skip "no dpkg-parsechangelog"
packaged=$(dpkg-parsechangelog -l "$debian/changelog" -S Version)
[ "${packaged%-*}" = "$version" ] || fail "changelog says $packaged, the header $version"
package=libglssao$(version_of "$source")
grep -q "^Package: $package\$" "$debian/control" && [ -e "$debian/$package.install" ] || fail "no package $package for this soname"
unset DESTDIR
quietly cmake --install "$build" --prefix "$scratch/usr"
# Whatever is installed lies in some package; the shared library comes from another build.
while read -r file; do
    found=
    while read -r pattern; do
        pattern=${pattern//\*\//}
        # shellcheck disable=SC2053
        case "$file" in $pattern | $pattern/*) found=1 ;; esac
    done < <(cat "$debian"/*.install)
    [ -n "$found" ] || fail "$file is installed and in no package"
done < <(cd "$scratch" && find usr -type f)
