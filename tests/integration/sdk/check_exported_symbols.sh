#!/usr/bin/env bash
# Checks that the shared library exports exactly the symbols of exported_symbols.txt: a missing one breaks existing
# programs, and an additional one would have to be kept.
set -euo pipefail
nm=$1 library=$2
listed=$(dirname "$0")/exported_symbols.txt
diff --label listed --label exported --unified "$listed" \
    <("$nm" --dynamic --defined-only "$library" | awk '{print $3}' | LC_ALL=C sort)
