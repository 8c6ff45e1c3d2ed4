#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# install-packages.sh build [test]: installs the packages of these groups in packages.txt that are missing.
# Touches nothing, and needs no network, where none is.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

if ! command -v dpkg >/dev/null; then
    echo "install-packages: this is not a Debian or Ubuntu system; packages.txt lists what is needed" >&2
    exit 0
fi

missing=() optional_missing=()
while read -r group package optional; do
    case " $* " in *" $group "*) ;; *) continue ;; esac
    if dpkg -s "$package" 2>/dev/null | grep -q '^Status: install ok installed'; then
        continue
    fi
    if [ -n "$optional" ]; then
        optional_missing+=("$package")
    else
        missing+=("$package")
    fi
done < <(grep -v '^#' "$here/packages.txt")

as_root=()
if [ "$(id -u)" != 0 ]; then
    as_root=(sudo)
fi
install() {
    echo "installing: $*"
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@" >/dev/null
}

if [ ${#missing[@]} -gt 0 ]; then
    if [ "$(id -u)" != 0 ] && ! command -v sudo >/dev/null; then
        echo "install-packages: neither root nor sudo; have root run: apt-get install ${missing[*]}" >&2
        exit 1
    fi
    "${as_root[@]}" apt-get update -qq
    install "${missing[@]}"
fi

# Only what this release has, and never a reason to stop.
for package in "${optional_missing[@]}"; do
    # Read whole: a reader that stops at the match would fail the pipe, and the package would be passed over.
    policy=$(apt-cache policy "$package" 2>/dev/null)
    if grep -q 'Candidate: [^(]' <<<"$policy"; then
        install "$package" || echo "install-packages: going on without $package" >&2
    fi
done
