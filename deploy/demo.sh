#!/usr/bin/env bash
# The whole system on a real map: bakes oa_dm1 (and keeps the result for the next run), starts the director, replays
# 30 s of a recorded match of 8 players over DDS in a loop, and shows what 8 observers receive. Anyone on this machine
# can watch in a browser: it prints the link, and in the end how to watch it again.
#
#     demo.sh [--seconds N] [--json FILE]
#     demo.sh --openarena [--seconds N] [--video FILE.mp4]
#
# Runs until Ctrl-C, or for N seconds, and ends with a summary (--json also writes it to FILE). Exit code 1 when a
# camera was in an obstacle, moved through one or jumped without declaring a cut, or when a camera frame was missing.
#
# --openarena: a live match of 8 bots on OpenArena's server instead, which spectators can join, for N seconds (30). It
# ends with a video, by default build/demo/openarena.mp4: the director's camera beside the game's own chase camera,
# both following one player; and with a contact sheet of it, FILE.png. Needs no display.
set -euo pipefail
export LC_ALL=C  # numbers have a decimal point
caller=$PWD
cd "$(dirname "$0")/.."

usage() {
    echo "demo.sh: $1; usage: demo.sh [--seconds N] [--json FILE]" \
        "or demo.sh --openarena [--seconds N] [--video FILE.mp4]" >&2
    exit 2
}
seconds='' json='' openarena=false video=''
while [ $# -gt 0 ]; do
    case "$1" in
        -h|--help) sed -n '2,/^set /s/^# \{0,1\}//p' deploy/demo.sh; exit 0 ;;
        --openarena) openarena=true; shift; continue ;;
        --seconds|--json|--video) [ $# -ge 2 ] || usage "$1 needs a value" ;;
        *) usage "unknown option '$1'" ;;
    esac
    case "$1" in
        --seconds)
            seconds=$2
            [[ $seconds =~ ^[0-9]{1,6}(\.[0-9]+)?$ && $seconds =~ [1-9] ]] ||
                usage "--seconds '$seconds': expected a number above 0, at most 999999" ;;
        --json)
            json=$2
            [[ $json = /* ]] || json=$caller/$json
            [ -d "$(dirname "$json")" ] || usage "--json '$2': no folder $(dirname "$json")" ;;
        --video)
            video=$2
            [[ $video != *.png ]] || usage "--video '$video': that is the contact sheet's name; expected FILE.mp4"
            [[ $video = /* ]] || video=$caller/$video ;;
    esac
    shift 2
done
$openarena || [ -z "$video" ] || usage "--video needs --openarena"
! $openarena || [ -z "$json" ] || usage "--json does not go with --openarena"

source deploy/processes.sh
bin=build/release/bin
work=build/demo
map=/usr/share/games/openarena/baseoa/pak1-maps.pk3:maps/oa_dm1.bsp
mkdir -p "$work"
groups=(build map) targets=(camera-director pose-replay observer-probe)
if $openarena; then
    source deploy/openarena/game.sh
    source deploy/openarena/live.sh
    video=${video:-$PWD/$work/openarena.mp4}
    for output in "$video" "$(sheet_of "$video")"; do check_output "$output"; done
    groups+=(game film) targets=(camera-director camera_director_openarena)
    seconds=${seconds:-30}
    [[ $seconds =~ ^0*[1-9][0-9]*(\.|$) ]] || usage "--seconds '$seconds': expected at least 1 with --openarena"
fi

step "Packages"
deploy/install-packages.sh "${groups[@]}"
! $openarena || check_tools

lock_checkout
step "Build (the first one takes some minutes)"
foreground cmake --preset release
foreground cmake --build --preset release --target "${targets[@]}"
lock_domain

cat >"$work/demo.json" <<CONFIG
{
  "dds": {"domain": $domain},
  "http": {"port": 0},
  "recording": {"folder": "recordings", "disk_mib": 64},
  "maps": [{"name": "oa_dm1", "file": "oa_dm1.vfs", "source": "$map"}]
}
CONFIG
step "Bake oa_dm1 (only when $work/oa_dm1.vfs is missing or out of date)"
foreground "$bin/camera-director" bake --config "$work/demo.json"

run "$work/director.log" "$bin/camera-director" serve --config "$work/demo.json"

# Of the page that shows the match. Empty while the director does not listen yet.
link() { sed -n 's|.*http: listening on \(.*\) port \(.*\)|http://\1:\2/|p' "$work/director.log"; }
director=$!
while [ -z "$(link)" ]; do
    running "$director" || { tail -n 5 "$work/director.log" >&2; fail "the director ended, see above"; }
    sleep 0.1
done
step "Watch the match in a browser: $(link)"

watch_again() {
    send TERM "$director"  # which then writes what it has recorded
    while running "$director"; do wait "$director" || true; done
    local recordings=("$1"/recordings/*/sync)
    [ ! -e "${recordings[-1]}" ] || echo "Watch it again, from its beginning:
    $PWD/$bin/camera-director play $PWD/$(dirname "${recordings[-1]}") $PWD/$1/oa_dm1.vfs --map $map" >&2
}

if $openarena; then
    work=$work/openarena
    at_exit() {
        local spectator
        for spectator in director chase; do rm -rf "$(video_folder "$spectator")"; done
        [ "$1" -ne 1 ] || echo "The director's messages: ${work%/*}/director.log" >&2
    }
    step "A live match of ${#bots[@]} bots, $seconds s"
    start_match
    how_to_connect
    film_match "$seconds" "$video"
    watch_again "${work%/*}"
    exit 0
fi

run "$work/replay.log" "$bin/pose-replay" deploy/demo/match.csv.gz --events deploy/demo/events.csv --domain "$domain" \
    --match-prefix demo --map-name oa_dm1

step "Live: one row for each player, and the camera that follows them"
cat >&2 <<LEGEND
   state        tracking; searching: following the roadmap to a player out of sight; held: the player is dead; cut
   visible %    frames in which the camera sees the player     p50, p99 ms  delay from a pose to its camera
                (less than 100 while a dead one is held)       gaps         camera frames that did not arrive
   clearance    camera to nearest wall, in units of 2.54 cm
   in obstacle, through, jumps: cameras inside a wall, moved through one, or moved too far without a declared cut
Logs: $work/director.log, $work/replay.log. Ctrl-C ends the demo.

LEGEND
start_program "$bin/observer-probe" --domain "$domain" --match-prefix demo --observers 8 --by-player --map "$map" \
    --seconds "${seconds:-0}" ${json:+--json "$json"}
probe=$!
trap 'send INT "$probe"' INT  # the observers print their summary
while running "$probe"; do wait "$probe" || true; done  # a signal ends a wait
status=0
wait "$probe" || status=$?
watch_again "$work"
if [ "$status" -eq 0 ]; then
    echo "All checks held: every camera frame arrived, no camera was in a wall or moved through one, every jump was declared."
elif [ "$status" -ne 130 ]; then  # 130: Ctrl-C twice
    echo "demo.sh: a check failed, see above. The last lines of the two logs:" >&2
    tail -n 5 "$work/director.log" "$work/replay.log" >&2
fi
exit "$status"
