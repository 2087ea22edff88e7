#!/usr/bin/env bash
# clang-tidy over all sources, several files of a folder at a time as the release build compiles them, and shellcheck over
# all scripts; or clang-tidy over the files that are named. Leaves out what includes CGAL's headers, on which clang-tidy does
# not end.
#     lint.sh [FILE ...]
set -euo pipefail
cd "$(dirname "$0")/.."

case "${1:-}" in -h|--help) sed -n '2,/^set /s/^# \{0,1\}//p' deploy/lint.sh; exit 0 ;; esac
preset=release
[ $# -eq 0 ] || preset=debug
if [ $# -eq 0 ]; then
    mapfile -t scripts < <(find deploy tests client-sdk .ci -type f -exec grep -lE '^#!/(usr/bin/env bash|bin/sh)' {} +)
    shellcheck -x -S warning "${scripts[@]}"
fi
cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset" --target camdir_wire camdir_freespace_schema_generated >/dev/null

compiled() {
    sed -n 's/^ *"file": "\(.*\)".*/\1/p' "build/$preset/compile_commands.json" |
        grep -E "^$PWD/(build/$preset/)?(server|client-sdk|tests/unit)/.*\.(cpp|cxx)$" | sort -u
}
files=("$@")
[ $# -gt 0 ] || mapfile -t files < <(compiled)
without_cgal=()
for file in "${files[@]}"; do
    grep -q 'CGAL/' "$file" || without_cgal+=("$file")
done
# The unity build includes .cpp files.
printf '%s\0' "${without_cgal[@]}" |
    xargs -0 -n 1 -P "$(nproc)" clang-tidy-14 --quiet -p "build/$preset" --checks=-bugprone-suspicious-include \
        --extra-arg=-Wno-unknown-warning-option
