#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test that a change must pass: formatting, layers, the release build with
# integration tests (matches on OpenArena's own server and client among them), a short soak and unit tests, and unit
# tests under the address and undefined-behaviour sanitizers; each unit test but those of benchmarks in one of the two.
#     test.sh [--all]
# --all: also networks that are cut, a scenario of chaos, all unit tests in the release build and, with another scenario,
# under these sanitizers and the thread sanitizer, the benchmarks and their tests, clang-tidy, every fuzzer for a minute, the
# client library on i386, and the Debian packages in an empty Debian
set -euo pipefail
cd "$(dirname "$0")/.."
. deploy/processes.sh

all=false
case "${1:-}" in
    "") ;;
    -h|--help) sed -n '2,/^set /s/^# \{0,1\}//p' deploy/test.sh; exit 0 ;;
    --all) all=true ;;
    *) echo "usage: deploy/test.sh [--all]" >&2; exit 2 ;;
esac

# The number of skipped tests in a JUnit report, and, on the same line, what they need: each prints a line "needs ...".
describe_skipped() {
    awk '
        /<testcase / { skipped = 0 }
        /<skipped message="SKIP_/ { skipped = 1; ++count }
        skipped && sub(/^[ \t]*(<system-out>)?needs /, "") && !seen[$0]++ {
            if (sub(/^\$CAMERA_DIRECTOR_SHARED\//, "")) files = files (files ? ", " : "") $0
            else others = others (others ? ", " : "") $0
        }
        END {
            if (files) files = files " below $CAMERA_DIRECTOR_SHARED"
            needs = files (files && others ? ", and " : "") others
            if (!needs) needs = "something that they do not name"
            print count + 0, "tests skipped" (count ? ": they need " needs : "")
        }' "$1"
}

# run_tests PRESET [CTEST OPTION ...]: one line that counts on a terminal; in a log only what failed, with its
# output, and the summary. Then what was skipped.
skipped=0
run_tests() {
    local report=$PWD/build/$1/tests.xml status=0 described
    local command=(ctest --preset "$1" --output-junit "$report" "${@:2}")
    rm -f "$report"
    if [ -t 1 ]; then
        "${command[@]}" --progress || status=$?
    else
        "${command[@]}" | grep -vE '^ +Start +[0-9]+: |^ *[0-9]+/[0-9]+ Test .*( Passed |\*\*\*Skipped )' || status=$?
    fi
    if [ -e "$report" ]; then
        described=$(describe_skipped "$report")
        echo "$described"
        skipped=$((skipped + ${described%% *}))
    fi
    return "$status"
}

step "Packages"
groups=(build map test game)
$all && groups+=(lint)
deploy/install-packages.sh "${groups[@]}"
! $all || deploy/i386-packages.sh build/i386-root

step "Formatting, layers"
find client-sdk server tests -name '*.[ch]pp' -print0 -o -name '*.[ch]' -print0 |
    xargs -0 clang-format-14 --dry-run --Werror
deploy/layers.sh

# What reads the bytes of others, and what has threads, is tested under the sanitizers alone; the rest as it runs: MAP.vfs
# and queries, cameras and the baker, whose results are those of the optimised build.
sanitized=(base config dds director evaluation http live recording scene sdk soak)
either() { (IFS='|'; echo "($*)"); }
left_out="unit-$(either "${sanitized[@]}")|fuzz-.*|unit-paper|integration-(all-maps|paper)"
left_out+='|bench-(all-maps|delaunay|direction|display|movers|openarena|paper|queries|serve)|raw-director'

step "Release build"
cmake --preset release
if $all; then
    cmake --build --preset release
else
    # Benchmarks with their tests are left out, too.
    mapfile -t targets < <(ninja -C build/release -t targets all | sed -nE 's/: C(XX)?_.*_LINKER_.*//p' |
        grep -vE "^bin/($left_out)$")
    cmake --build --preset release --target "${targets[@]}"
fi

step "Release tests: unit, integration, soak; the build with sanitizers beside them"
# Most of these tests wait. What is compiled meanwhile takes what they leave of the processors.
cmake --preset asan
programs=(fuzz-tests "${sanitized[@]/#/unit-}")
! $all || programs=(unit-tests chaos)
nice -n 19 ninja -C build/asan "${programs[@]}" >build/asan/build.log 2>&1 &
sanitized_build=$!

# The sight of one map in ten, by their numbers: that of all takes minutes. No chaos: its gaps are also those of
# a busy machine.
some=()
$all || some=(--label-exclude '^chaos$' --exclude-regex
    "SightOnMap[^ ]*[012456789]( |\$)|^(${left_out//-/[.-]})(\.|_NOT_BUILT)")
run_tests release "${some[@]}"

step "Address and undefined-behaviour sanitizers: the rest of the build"
wait "$sanitized_build" || { cat build/asan/build.log; fail "the build with sanitizers failed, see above"; }

step "Address and undefined-behaviour sanitizers: unit tests, chaos"
if $all; then
    # Queries and cameras on real maps: minutes of the same code that the random worlds run.
    run_tests asan --label-regex '^unit$' --exclude-regex '^unit\.(camera|freespace)-maps(\.|$)'
    run_tests asan --tests-regex '^soak\.chaos$'
else
    run_tests asan --tests-regex "^(fuzz|unit\.$(either "${sanitized[@]}"))\."
fi

if $all; then
    step "Thread sanitizer: unit and integration tests, chaos"
    cmake --preset tsan
    cmake --build --preset tsan
    # Sight on all maps runs on one thread, and would take the sanitizer hours.
    run_tests tsan --label-regex '^(unit|integration)$' --exclude-regex 'SightOnMap'
    run_tests tsan --tests-regex '^soak\.chaos$'

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

    step "Debian packages"
    deploy/package.sh
    if [ "$(id -u)" -eq 0 ]; then deploy/test-package.sh; else sudo deploy/test-package.sh; fi
fi

if [ "$skipped" -eq 0 ]; then
    step "All passed"
else
    step "All passed, $skipped skipped: see what they need above"
fi
