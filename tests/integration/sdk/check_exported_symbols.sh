#!/usr/bin/env bash
# The shared library exports exactly what exported_symbols.txt lists: a symbol that disappears breaks programs that are
# linked already, and one that appears becomes a promise.
set -euo pipefail
nm=$1 library=$2
listed=$(dirname "$0")/exported_symbols.txt
diff --label listed --label exported --unified "$listed" \
    <("$nm" --dynamic --defined-only "$library" | awk '{print $3}' | LC_ALL=C sort)
