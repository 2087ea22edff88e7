#!/usr/bin/env bash
# Installs the client library to a new prefix, and builds and runs programs against it as its users would: the examples
# with CMake's find_package, a C and a C++ program with pkg-config. Compiles the code samples of its README.
set -euo pipefail
cmake=$1 generator=$2 build_tree=$3 cc=$4 cxx=$5 sanitize=$6
sources=$(cd "$(dirname "$0")/consumer" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix
sanitize_flags=()
[ -z "$sanitize" ] || sanitize_flags=("-fsanitize=$sanitize")

"$cmake" --install "$build_tree" --component client-sdk --prefix "$work/first" >/dev/null
mv "$work/first" "$prefix"   # an installed tree may be moved

"$cmake" -G "$generator" -S "$prefix/share/doc/camera-director/examples" -B "$work/examples" \
    -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$cc" -DCMAKE_C_FLAGS="${sanitize_flags[*]}" >/dev/null
"$cmake" --build "$work/examples" >/dev/null
"$work/examples/example-game-server" --domain 83 --seconds 0.2
status=0
"$work/examples/example-observer" --domain 83 --seconds 0.2 || status=$?
[ "$status" -eq 1 ]  # there is no director

export PKG_CONFIG_PATH=$prefix/lib/pkgconfig:$prefix/lib64/pkgconfig
read -ra cflags <<<"$(pkg-config --cflags camera-director-client)"
read -ra flags <<<"$(pkg-config --cflags --libs camera-director-client)"
warnings=(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror)
"$cc" -std=c11 "${warnings[@]}" "${sanitize_flags[@]}" "$sources/consumer.c" -o "$work/consumer-c" "${flags[@]}" -pthread
"$cxx" -std=c++20 "${warnings[@]}" "${sanitize_flags[@]}" "$sources/consumer.cpp" -o "$work/consumer-cxx" "${flags[@]}" -pthread
"$cxx" -std=c++20 -fno-exceptions -fno-rtti "${warnings[@]}" "${sanitize_flags[@]}" "$sources/consumer.cpp" \
    -o "$work/consumer-cxx-bare" "${flags[@]}" -pthread
if "$cxx" -std=c++17 -fsyntax-only "$sources/consumer.cpp" "${cflags[@]}" 2>"$work/errors"; then exit 1; fi
grep -m 1 'error:' "$work/errors" | grep -q 'needs C++20: compile with -std=c++20'
library_dir=$(dirname "$(find "$prefix" -name libcamera-director-client.so)")
for program in consumer-c consumer-cxx consumer-cxx-bare; do
    LD_LIBRARY_PATH=$library_dir "$work/$program"
done

# The README's fenced blocks of one language, as one file.
samples() {
    awk -v fence="\`\`\`$1" '$0 == fence { on = 1; next } /^```/ { on = 0 } on' \
        "$prefix/share/doc/camera-director/client-sdk/README.md" >"$work/sample.$1"
    [ -s "$work/sample.$1" ] || { echo "README.md has no code sample in $1" >&2; exit 1; }
}
samples c
"$cc" -std=c11 "${warnings[@]}" -c "$work/sample.c" -o "$work/sample-c.o" "${cflags[@]}"
samples cpp
"$cxx" -std=c++20 "${warnings[@]}" -c "$work/sample.cpp" -o "$work/sample-cpp.o" "${cflags[@]}"
