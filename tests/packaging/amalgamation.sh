#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# amalgamation.sh FOLDER: the two generated files alone, with each compiler there is, in a C and in a C++ program.
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/common.sh"
mkdir "$scratch/glssao"
cp "$1/glssao.c" "$1/glssao.h" "$scratch/glssao"
cp "$here/consumer.c" "$scratch"
cp "$here/consumer.c" "$scratch/consumer.cpp"
cd "$scratch"
tried=0
for pair in gcc:g++ clang:clang++; do
    c=${pair%:*} cxx=${pair#*:}
    command -v "$c" >/dev/null && command -v "$cxx" >/dev/null || continue
    tried=$((tried + 1))
    quietly "$c" -std=c11 -Wall -Wextra -pedantic -Werror -c glssao/glssao.c -o glssao.o
    quietly "$c" -std=c11 -Wall -Wextra -pedantic -Werror -I. consumer.c glssao.o -lm -o consumer-c
    quietly "$cxx" -std=c++17 -Wall -Wextra -pedantic -Werror -I. consumer.cpp glssao.o -lm -o consumer-cpp
    quietly ./consumer-c
    quietly ./consumer-cpp
    foreign=$(nm -g --defined-only glssao.o | awk '{print $3}' | grep -v '^glssao_' || true)
    [ -z "$foreign" ] || fail "global names without the library's prefix: $foreign"
done
[ $tried -gt 0 ] || fail "neither gcc nor clang"
echo "amalgamation: $(wc -l <glssao/glssao.c) lines, $(stat -c %s glssao/glssao.c) bytes"
