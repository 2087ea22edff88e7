#!/usr/bin/env bash
# check_i386.sh CMAKE GENERATOR SOURCES BUILD_TREE ROOT TEST: builds the client library and the plugin for i386 against
# the packages in ROOT, and runs there: a C program that uses the library, and the plugin in the acted server with TEST,
# which is a program of this machine. Ends with 77 when something is missing that only this test needs.
set -euo pipefail
cmake=$1 generator=$2 sources=$3 build=$4 root=$5 test=$6
skip() { echo "needs $1"; exit 77; }
command -v clang-14 >/dev/null || skip "the package clang-14"
[ -e "$root/complete" ] || skip "the i386 packages that deploy/i386-packages.sh build/i386-root unpacks"
loader=$root/lib/i386-linux-gnu/ld-linux.so.2
"$loader" --version >/dev/null 2>&1 || skip "a kernel that runs i386 programs"

# A compiler cache may change the paths from which CMake learns the system's include folders.
unset CMAKE_C_COMPILER_LAUNCHER CMAKE_CXX_COMPILER_LAUNCHER
build_library() {
    "$cmake" -G "$generator" -S "$sources" -B "$build" -DCMAKE_BUILD_TYPE=Release -DCAMERA_DIRECTOR_SERVER=OFF \
        -DCMAKE_TOOLCHAIN_FILE="$sources/client-sdk/cmake/i386.cmake" -DCMAKE_SYSROOT="$root" &&
        "$cmake" --build "$build"
}
if ! build_library >"$build.log" 2>&1; then
    cat "$build.log"
    exit 1
fi

libraries=$build/lib:$root/lib/i386-linux-gnu:$root/usr/lib/i386-linux-gnu
compile=(clang-14 --target=i686-linux-gnu --sysroot="$root" -std=gnu11 -Wall -Wextra -Werror)
"${compile[@]}" "$sources/tests/integration/sdk/consumer/consumer.c" -o "$build/bin/consumer" \
    -I"$sources/client-sdk/include" -L"$build/lib" -lcamera-director-client -Wl,-rpath-link="$libraries" -pthread
"$loader" --library-path "$libraries" "$build/bin/consumer"

"${compile[@]}" "$sources/tests/integration/halflife/host.c" -o "$build/bin/halflife-host.i386" \
    -I"$sources/client-sdk" -ldl -lm
host=$build/bin/halflife-host
printf '#!/bin/sh\nexec "%s" --library-path "%s" "%s.i386" "$@"\n' "$loader" "$libraries" "$host" >"$host"
chmod +x "$host"
CAMDIR_HALFLIFE_HOST=$host CAMDIR_HALFLIFE_PLUGIN=$build/lib/halflife/director_mm.so "$test"
