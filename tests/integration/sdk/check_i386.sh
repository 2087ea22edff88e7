#!/usr/bin/env bash
# check_i386.sh CMAKE GENERATOR SOURCES BUILD_TREE ROOT: builds the client library, the examples and the plugin for i386
# against the packages in ROOT, and runs there what uses the library: programs in C and C++, and the layout of its
# structs. Ends with 77 when something is missing that only this test needs.
set -euo pipefail
cmake=$1 generator=$2 sources=$3 build=$4 root=$5
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
target=(--target=i686-linux-gnu --sysroot="$root" -Wall -Wextra -Werror -I"$sources/client-sdk/include")
library=(-L"$build/lib" -lcamera-director-client "-Wl,-rpath-link=$libraries" -pthread)
consumer=$sources/tests/integration/sdk/consumer/consumer
clang-14 -std=c11 "${target[@]}" -fsyntax-only "$sources/tests/unit/sdk/header_layout.c"
clang-14 -std=gnu11 "${target[@]}" "$consumer.c" -o "$build/bin/consumer-c" "${library[@]}"
clang++-14 -std=c++20 -fno-exceptions -fno-rtti "${target[@]}" "$consumer.cpp" -o "$build/bin/consumer-cxx" "${library[@]}"
for program in consumer-c consumer-cxx; do
    "$loader" --library-path "$libraries" "$build/bin/$program"
done
