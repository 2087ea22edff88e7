#!/usr/bin/env bash
# check_i386.sh SOURCES BUILD_TREE ROOT TEST: runs the plugin that the SDK's check_i386.sh has built for i386 in the acted
# server with TEST, which is a program of this machine.
set -euo pipefail
sources=$1 build=$2 root=$3 test=$4
loader=$root/lib/i386-linux-gnu/ld-linux.so.2
libraries=$build/lib:$root/lib/i386-linux-gnu:$root/usr/lib/i386-linux-gnu
host=$build/bin/halflife-host
if ! [ -e "$build/lib/halflife/director_mm.so" ] || ! "$loader" --version >/dev/null 2>&1; then
    echo "needs what integration.sdk.i386 needs, and its build"
    exit 77
fi
clang-14 --target=i686-linux-gnu --sysroot="$root" -std=gnu11 -Wall -Wextra -Werror \
    "$sources/tests/integration/halflife/host.c" -o "$host.i386" -I"$sources/client-sdk" -ldl -lm
printf '#!/bin/sh\nexec "%s" --library-path "%s" "%s.i386" "$@"\n' "$loader" "$libraries" "$host" >"$host"
chmod +x "$host"
CAMDIR_HALFLIFE_HOST=$host CAMDIR_HALFLIFE_PLUGIN=$build/lib/halflife/director_mm.so "$test"
