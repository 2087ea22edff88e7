#!/usr/bin/env bash
# Carries a scenario out on a leader and a standby - kills, stops, reloads, strangers, floods - and judges what the
# observers of real matches see meanwhile, and what the directors use.
#
#     chaos.sh [--bin FOLDER] [--work FOLDER] [SCENARIO.json] [OPTION OF chaos]...
#
# Without a scenario it is scenarios/short.json. The map is oa_dm1 of Debian's openarena-081-maps; the baked map stays in
# the work folder for the next run. --report FILE.html writes a page with plots over time, --hours N lets the scenario's
# repeated acts go on for so long. Exit codes: 0 all checks passed, 1 a check failed, 2 bad usage, 77 no map, or the
# machine was too busy to judge frames.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
bin=$here/../../build/release/bin
work=${TMPDIR:-/tmp}/camera-director-soak
scenario=$here/scenarios/short.json
archive=/usr/share/games/openarena/baseoa/pak1-maps.pk3
case "${1-}" in -h|--help) sed -n '2,/^set /s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;; esac
while [ "${1-}" = --bin ] || [ "${1-}" = --work ]; do
    [ $# -ge 2 ] || { echo "chaos.sh: $1 needs a value" >&2; exit 2; }
    if [ "$1" = --bin ]; then bin=$2; else work=$2; fi
    shift 2
done
case "${1-}" in ''|-*) ;; *) scenario=$1; shift ;; esac
[ -e "$archive" ] || { printf "chaos.sh: no file %s\nneeds the package openarena-081-maps\n" "$archive" >&2; exit 77; }

mkdir -p "$work"
cat >"$work/chaos.json" <<CONFIG
{"maps": [{"name": "oa_dm1", "file": "oa_dm1.vfs", "source": "$archive:maps/oa_dm1.bsp"}]}
CONFIG
"$bin/camera-director" bake --config "$work/chaos.json" --quiet
exec "$bin/chaos" --bin "$bin" "$scenario" "$work/oa_dm1.vfs" "$@"
