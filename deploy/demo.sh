#!/usr/bin/env bash
# The main job on a real map: bakes oa_dm1 (kept for the next run), starts the director, replays 30 s of a real
# match of 8 players over DDS, again and again, and shows what 8 observers receive.
#
#     demo.sh [--seconds N] [--json FILE]
#
# Runs until Ctrl-C, or for N seconds. Ends with a summary; exit code 1 when a camera was in an obstacle, moved
# through one, jumped undeclared, or a camera frame was missing.
set -euo pipefail
caller=$PWD
cd "$(dirname "$0")/.."

seconds=0 json=
while [ $# -gt 0 ]; do
    [ $# -ge 2 ] || { echo "demo.sh: usage: demo.sh [--seconds N] [--json FILE]" >&2; exit 2; }
    case "$1" in
        --seconds) seconds=$2 ;;
        --json) json=$2; [[ $json = /* ]] || json=$caller/$json ;;
        *) echo "demo.sh: unknown option '$1'; usage: demo.sh [--seconds N] [--json FILE]" >&2; exit 2 ;;
    esac
    shift 2
done

deploy/install-packages.sh build map
[ -e build/release/build.ninja ] || cmake --preset release
cmake --build --preset release --target camera-director pose-replay observer-probe

bin=build/release/bin
work=build/demo
map=/usr/share/games/openarena/baseoa/pak1-maps.pk3:maps/oa_dm1.bsp
mkdir -p "$work"

# A DDS domain of its own, held as long as this script runs.
locks=${TMPDIR:-/tmp}/camera-director-test-domains
mkdir -p "$locks"
for domain in $(shuf -i 1-80) ""; do
    [ -n "$domain" ] || { echo "demo.sh: every DDS domain from 1 to 80 is taken, see $locks" >&2; exit 1; }
    exec 9>"$locks/$domain"
    flock -n 9 && break
done

cat >"$work/demo.json" <<CONFIG
{
  "dds": {"domain": $domain},
  "http": {"port": 0},
  "maps": [{"name": "oa_dm1", "file": "oa_dm1.vfs", "source": "$map"}]
}
CONFIG
"$bin/camera-director" bake --config "$work/demo.json"

started=()
stop() {
    for pid in "${started[@]}"; do kill -TERM "$pid" 2>/dev/null || true; done
    for pid in "${started[@]}"; do wait "$pid" 2>/dev/null || true; done
}
trap stop EXIT
# Ctrl-C reaches the observers, who end with their summary; the rest is ended after them.
trap : INT
trap 'exit 143' TERM

setsid "$bin/camera-director" serve --config "$work/demo.json" 2>"$work/director.log" 9>&- &
started+=($!)
setsid "$bin/pose-replay" deploy/demo/match.csv.gz --domain "$domain" --match-prefix demo --map-name oa_dm1 \
    >"$work/replay.log" 2>&1 9>&- &
started+=($!)

echo "The director's log: $work/director.log. One observer a player:" >&2
"$bin/observer-probe" --domain "$domain" --match-prefix demo --observers 8 --by-player --map "$map" \
    --seconds "$seconds" ${json:+--json "$json"} 9>&- &
probe=$!
started+=("$probe")
status=0
wait "$probe" || status=$?
while kill -0 "$probe" 2>/dev/null; do  # the wait was interrupted
    status=0
    wait "$probe" || status=$?
done
if [ "$status" -ne 0 ]; then
    echo "demo.sh: the observers found something wrong; the director's last words:" >&2
    tail -n 5 "$work/director.log" >&2
fi
exit "$status"
