#!/usr/bin/env bash
# clang-tidy over the sources; as arguments: only these files. CGAL's headers keep the analyser busy for
# ever, so server/bake is left out where it includes them.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --preset debug >/dev/null
cmake --build --preset debug --target camdir_wire camdir_freespace_schema_generated >/dev/null
files=("$@")
[ $# -gt 0 ] || mapfile -t files < <(git ls-files 'server/*.cpp' 'client-sdk/*.cpp' 'tests/unit/*.cpp')
without_cgal=()
for file in "${files[@]}"; do
    grep -q 'CGAL/' "$file" || without_cgal+=("$file")
done
printf '%s\0' "${without_cgal[@]}" |
    xargs -0 -n 4 -P "$(nproc)" clang-tidy-14 --quiet -p build/debug --extra-arg=-Wno-unknown-warning-option
