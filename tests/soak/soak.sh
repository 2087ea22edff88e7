#!/usr/bin/env bash
# Runs a director under load, checks every camera that it publishes, and that its memory does not grow.
#
#     soak.sh [--seconds N | --hours N] [--matches 4] [--players 8] [--observers 8] [--rate 60] [--delay 0]
#             [--trace FILE] [--map MAP] [--map-name NAME] [--bin FOLDER] [--work FOLDER] [--json FILE]
#             [--max-growth-mib 4] [--secure]
#
# Players walk along the map's roadmap, or replay --trace. MAP is a file or archive.pk3:member; without it oa_dm1 of
# Debian's openarena-081-maps is used. The baked map stays in the work folder for the next run.
# With --delay S the matches are shown S seconds late: no camera may leave earlier, and latencies count from then.
# With --secure the same runs twice, first with plain DDS, then with DDS Security; secure_throughput is what a core does
# with it, as a share of what it does without.
# Memory counts as level when its median over the last quarter of the run is at most --max-growth-mib above that
# over the second quarter. Exit codes: 0 all checks passed, 1 a check failed, 2 bad usage, 77 no map.
set -euo pipefail
export LC_ALL=C  # awk and sleep agree on the decimal point

here=$(cd "$(dirname "$0")" && pwd)
bin=$here/../../build/release/bin
work=${TMPDIR:-/tmp}/camera-director-soak
seconds=60 matches=4 players=8 observers=8 rate=60 delay=0 trace='' json='' growth=4 map_name=oa_dm1 secure=
map=/usr/share/games/openarena/baseoa/pak1-maps.pk3:maps/oa_dm1.bsp

while [ $# -gt 0 ]; do
    case "$1" in
        -h|--help) sed -n '2,/^set /s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;;
        --secure) secure=1; shift; continue ;;
    esac
    [ $# -ge 2 ] || { echo "soak.sh: $1 needs a value" >&2; exit 2; }
    case "$1" in
        --seconds) seconds=$2 ;;
        --hours)
            [[ $2 =~ ^[0-9]+(\.[0-9]+)?$ ]] || { echo "soak.sh: --hours $2: expected a number" >&2; exit 2; }
            seconds=$(awk -v hours="$2" 'BEGIN { printf "%d", 3600 * hours }') ;;
        --matches) matches=$2 ;;
        --players) players=$2 ;;
        --observers) observers=$2 ;;
        --rate) rate=$2 ;;
        --delay) delay=$2 ;;
        --trace) trace=$2 ;;
        --map) map=$2 ;;
        --map-name) map_name=$2 ;;
        --bin) bin=$2 ;;
        --work) work=$2 ;;
        --json) json=$2 ;;
        --max-growth-mib) growth=$2 ;;
        *) echo "soak.sh: unknown option '$1'; --help lists the options" >&2; exit 2 ;;
    esac
    shift 2
done
[ -e "${map%%:*}" ] || { printf "soak.sh: no file %s\nneeds the package openarena-081-maps\n" "${map%%:*}" >&2; exit 77; }
for program in camera-director pose-replay synthetic-players observer-probe; do
    [ -x "$bin/$program" ] || {
        echo "soak.sh: $bin/$program is missing; build it: cmake --preset release && cmake --build --preset release" >&2
        exit 1
    }
done
mkdir -p "$work"

source "$here/../../deploy/processes.sh"
lock_domain

# write_config SECURITY: a folder of an identity, or nothing.
write_config() {
    # shellcheck disable=SC2154  # lock_domain sets it
    cat >"$work/soak.json" <<CONFIG
{
  "dds": {"domain": $domain, "security": "$1"},
  "http": {"enabled": false},
  "limits": {"participant_matches": 64, "participant_observers": 256},
  "maps": [{"name": "$map_name", "file": "$map_name.vfs", "source": "$map"}],
  "log": {"level": "warning"}
}
CONFIG
}
write_config ''
"$bin/camera-director" bake --config "$work/soak.json"

# Samples the server's resident kilobytes and processor ticks, once per second or 1000 times in total.
pause=$(awk -v s="$seconds" 'BEGIN { print (s > 1000 ? s / 1000 : 1) }')
sample() {
    awk '/^VmRSS/ { rss = $2 } END { printf "%s ", rss }' "/proc/$server/status"
    awk '{ print $14 + $15 }' "/proc/$server/stat"
}
median_of() { sort -n | awk '{ v[NR] = $1 } END { print (NR ? v[int((NR + 1) / 2)] : 0) }'; }

# start_load IDENTITIES: the server, the game servers and the observers; a folder of identities, or nothing.
start_load() {
    local network=(--domain "$domain" --match-prefix soak) observers_are=() players_are=()
    if [ -n "$1" ]; then
        players_are=(--security "$1/game-server")
        observers_are=(--security "$1/observer")
    fi
    write_config "${1:+$1/director}"
    start_program "$bin/camera-director" serve --config "$work/soak.json"
    server=$!
    if [ -n "$trace" ]; then
        start_program "$bin/pose-replay" "$trace" "${network[@]}" "${players_are[@]}" --map-name "$map_name" \
            --copies "$matches" --rate "$rate" --delay "$delay" >"$work/players.txt"
    else
        start_program "$bin/synthetic-players" "$work/$map_name.vfs" "${network[@]}" "${players_are[@]}" \
            --map-name "$map_name" --matches "$matches" --players "$players" --rate "$rate" --delay "$delay" \
            >"$work/players.txt"
    fi
    game=$!
    start_program "$bin/observer-probe" "${network[@]}" "${observers_are[@]}" --matches "$matches" \
        --observers "$observers" --map "$map" --delay "$delay" --seconds "$seconds" --json "$work/probe.json"
    probe=$!
}

# run_load IDENTITIES: sets `result`, `cores` and, when a check has failed, `failed`.
run_load() {
    local probed=0 served=0 played=0 count early last level
    start_load "$1"
    : >"$work/samples.txt"
    while running "$probe"; do
        running "$server" || fail "the server has ended"
        running "$game" || fail "the game server has ended"
        sample >>"$work/samples.txt"
        sleep "$pause"
    done
    wait "$probe" || probed=$?
    send TERM "$server"
    wait "$server" || served=$?
    send TERM "$game"
    wait "$game" || played=$?

    count=$(wc -l <"$work/samples.txt")
    early=$(awk -v n="$count" 'NR > n / 4 && NR <= n / 2 { print $1 }' "$work/samples.txt" | median_of)
    last=$(awk -v n="$count" 'NR > 3 * n / 4 { print $1 }' "$work/samples.txt" | median_of)
    cores=$(awk -v s="$pause" -v hz="$(getconf CLK_TCK)" \
        'NR == 1 { first = $2 } { last = $2 } END { print (NR > 1 ? (last - first) / hz / (s * (NR - 1)) : 0) }' \
        "$work/samples.txt")
    level=$(awk -v a="$early" -v b="$last" -v most="$growth" 'BEGIN { print (b - a <= 1024 * most ? "true" : "false") }')
    result=$(cat <<RESULT
{
  "matches": $matches, "players": $players, "observers": $observers, "rate_hz": $rate, "delay_s": $delay,
  "seconds": $seconds,
  "memory_kib": {"second_quarter": $early, "last_quarter": $last, "level": $level},
  "server_cores": $cores,
  "exit_codes": {"server": $served, "players": $played, "probe": $probed},
  "probe": $(cat "$work/probe.json")
}
RESULT
    )
    [ "$level" = true ] || echo "soak.sh: the server's memory grew from $early to $last KiB" >&2
    [ "$probed" = 0 ] && [ "$served" = 0 ] && [ "$level" = true ] || failed=1
}

make_identities() {
    local role
    rm -rf "$work/authority"
    "$authority" create "$work/authority"
    for role in director game-server observer; do
        "$authority" issue "$work/authority" "$role" "$role" '*'
    done
}

failed=0
run_load ''
if [ -n "$secure" ]; then
    authority=$here/../../deploy/security/authority.sh
    make_identities
    plain=$result plain_cores=$cores
    run_load "$work/authority/identities"
    share=$(awk -v plain="$plain_cores" -v secure="$cores" 'BEGIN { print (secure > 0 ? plain / secure : 0) }')
    result=$(printf '{\n"secure_throughput": %s,\n"plain": %s,\n"secure": %s\n}' "$share" "$plain" "$result")
fi
[ -z "$json" ] || printf '%s\n' "$result" >"$json"
printf '%s\n' "$result"
[ "$failed" = 0 ]
