#!/usr/bin/env bash
# check_exported_symbols.sh NM LIBRARY LIST: checks that the library exports exactly the listed symbols. A missing one
# breaks existing programs, and an additional one would have to be kept.
set -euo pipefail
nm=$1 library=$2 listed=$3
diff --label listed --label exported --unified "$listed" \
    <("$nm" --dynamic --defined-only "$library" | awk '{print $3}' | LC_ALL=C sort)
