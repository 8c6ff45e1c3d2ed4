#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# run-all.sh: installs what is missing (Debian, Ubuntu), builds with clang, as it ships, and with gcc, with sanitizers
# and checks for GL errors, and runs every test in both. Stops at the first build or test run that fails; ctest's summary comes last.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

./third_party/install-packages.sh build test
export LSAN_OPTIONS=suppressions=$PWD/tests/lsan.supp:print_suppressions=0
# Pages of 2 MB, where the C library knows how: compilers and Mesa spend up to a fifth of their time on faults of small ones.
export GLIBC_TUNABLES=glibc.malloc.hugetlb=1
run() { # folder, then cmake's options
    local folder=$1
    shift
    cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DGLSSAO_WERROR=ON "$@" >/dev/null
    cmake --build "$folder"
    ctest --test-dir "$folder" --output-on-failure -j2
}
run build-clang -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++
run build-sanitize -DCMAKE_C_COMPILER=gcc -DCMAKE_CXX_COMPILER=g++ -DGLSSAO_SANITIZE=ON -DGLSSAO_CHECK_GL=ON
