#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# build-debian.sh [FOLDER]: stages the committed tree with third_party/debian as its debian folder in FOLDER (a new one
# under /tmp), builds libglssao0.2, libglssao-dev and glssao-tools there, and runs lintian if it is installed. Needs
# dpkg-dev, debhelper and the build group of packages.txt.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=${1:-$(mktemp -d)}
mkdir -p "$folder"
version=$(dpkg-parsechangelog -l "$root/third_party/debian/changelog" -S Version)
staged=$folder/glssao-${version%-*}
rm -rf "$staged"
mkdir "$staged"
git -C "$root" archive HEAD | tar -x -C "$staged"
tar -C "$folder" --exclude=debian -czf "$folder/glssao_${version%-*}.orig.tar.gz" "$(basename "$staged")"
mv "$staged/third_party/debian" "$staged/debian"
cd "$staged"
dpkg-buildpackage -us -uc -b
if command -v lintian >/dev/null; then
    lintian --fail-on error "$folder/glssao_${version}_$(dpkg --print-architecture).changes"
fi
ls -l "$folder"/*.deb
