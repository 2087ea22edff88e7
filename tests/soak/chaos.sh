#!/usr/bin/env bash
# Carries a scenario out on a leader and a standby - kills, stops, reloads, strangers, floods - and judges what the
# observers of real matches see meanwhile, and what the directors use.
#
#     chaos.sh [--preset PRESET | --bin FOLDER] [--work FOLDER] [SCENARIO.json] [OPTION OF chaos]...
#
# PRESET is release, asan or tsan: it must have been built. Without a scenario it is scenarios/short.json. The map is oa_dm1
# of Debian's openarena-081-maps; the baked map stays in the work folder for the next run. --report FILE.html writes a page
# with plots over time, --hours N lets the scenario's repeated acts go on for so long.
# Of programs with sanitizers, which are slow and large, neither memory nor what observers see is judged. Every report of a
# sanitizer, from directors, game servers, strangers and observers, is printed and fails the run.
# Exit codes: 0 all checks passed, 1 a check failed, 2 bad usage, 77 no map, or the machine was too busy to judge frames.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
support=$here/../support
bin=$here/../../build/release/bin
work=${TMPDIR:-/tmp}/camera-director-soak
scenario=$here/scenarios/short.json
archive=/usr/share/games/openarena/baseoa/pak1-maps.pk3
case "${1-}" in -h|--help) sed -n '2,/^set /s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;; esac
while [ "${1-}" = --preset ] || [ "${1-}" = --bin ] || [ "${1-}" = --work ]; do
    [ $# -ge 2 ] || { echo "chaos.sh: $1 needs a value" >&2; exit 2; }
    case "$1" in
        --preset) bin=$here/../../build/$2/bin ;;
        --bin) bin=$2 ;;
        --work) work=$2 ;;
    esac
    shift 2
done
case "${1-}" in ''|-*) ;; *) scenario=$1; shift ;; esac
[ -x "$bin/chaos" ] || {
    echo "chaos.sh: $bin/chaos is missing; build it: cmake --preset PRESET && cmake --build --preset PRESET --target chaos" >&2
    exit 1
}
[ -e "$archive" ] || { printf "chaos.sh: no file %s\nneeds the package openarena-081-maps\n" "$archive" >&2; exit 77; }

# Sets `sanitized`, and lets every program that is started write its reports to $reports/PROCESS.
collect_reports() {
    sanitized=()
    if grep -q -e __asan_init -e __tsan_init "$bin/camera-director"; then sanitized=(--sanitized); fi
    reports=$work/reports
    rm -rf "$reports"
    mkdir -p "$reports"
    export ASAN_OPTIONS=log_path=$reports/asan
    export UBSAN_OPTIONS=log_path=$reports/ubsan:print_stacktrace=1
    export LSAN_OPTIONS=suppressions=$support/lsan.supp:print_suppressions=0
    export TSAN_OPTIONS=log_path=$reports/tsan:suppressions=$support/tsan.supp
}

# Fails when there are any.
show_reports() {
    local count
    count=$(find "$reports" -type f | wc -l)
    find "$reports" -type f -exec cat {} + >&2
    if [ "$count" -eq 0 ]; then echo -n "passed      "; else echo -n "FAILED      "; fi
    echo "processes with a sanitizer's report: $count, allowed: 0"
    [ "$count" -eq 0 ]
}

mkdir -p "$work"
cat >"$work/chaos.json" <<CONFIG
{"maps": [{"name": "oa_dm1", "file": "oa_dm1.vfs", "source": "$archive:maps/oa_dm1.bsp"}]}
CONFIG
collect_reports
"$bin/camera-director" bake --config "$work/chaos.json" --quiet
status=0
"$bin/chaos" --bin "$bin" "${sanitized[@]}" "$scenario" "$work/oa_dm1.vfs" "$@" || status=$?
[ ${#sanitized[@]} -eq 0 ] || show_reports || status=1
exit "$status"
