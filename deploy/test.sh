#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test that a change must pass:
# formatting, the release build with unit and integration tests and a short soak, unit tests under the
# address and undefined-behaviour sanitizers.
#   --all   also the thread sanitizer, clang-tidy, and every fuzzer for a minute
set -euo pipefail
cd "$(dirname "$0")/.."

all=false
case "${1:-}" in
    "") ;;
    --all) all=true ;;
    *) echo "usage: deploy/test.sh [--all]" >&2; exit 2 ;;
esac

step() { printf '\n== %s (%s s)\n' "$1" "$SECONDS"; }

# One line that counts on a terminal; in a log only what failed, with its output, and the summary.
run_tests() {
    if [[ -t 1 ]]; then
        ctest --progress "$@"
    else
        ctest "$@" | grep -vE '^ +Start +[0-9]+: |^ *[0-9]+/[0-9]+ Test .*( Passed |\*\*\*Skipped )'
    fi
}

step "Packages"
groups=(build map test)
$all && groups+=(lint)
deploy/install-packages.sh "${groups[@]}"

step "Formatting"
git ls-files -z '*.cpp' '*.hpp' '*.c' '*.h' | xargs -0 clang-format-14 --dry-run --Werror

step "Release build"
cmake --preset release
cmake --build --preset release

step "Release tests: unit, integration, soak"
run_tests --preset release

step "Address and undefined-behaviour sanitizers: unit tests"
cmake --preset asan
cmake --build --preset asan --target unit-tests
run_tests --preset asan --label-regex '^unit$'

if $all; then
    step "Thread sanitizer: unit and integration tests"
    cmake --preset tsan
    cmake --build --preset tsan
    run_tests --preset tsan --label-regex '^(unit|integration)$'

    step "clang-tidy"
    deploy/lint.sh

    step "Fuzzers"
    cmake --preset fuzz
    cmake --build --preset fuzz --target fuzz-tests
    for corpus in tests/fuzz/corpus/*/; do
        name=$(basename "$corpus")
        found=build/fuzz/corpus/$name
        mkdir -p "$found"
        build/fuzz/bin/fuzz-"$name" -max_total_time=60 -timeout=30 -rss_limit_mb=4096 "$found" "$corpus"
    done
fi

step "All passed"
