#!/usr/bin/env bash
# Films camera paths of a recorded match with OpenArena's own renderer: the way to watch the work of a camera.
#
#     film.sh MAP CAMERAS.csv TRACE [--players 0,3] [--seconds FROM,TO] -o FILE.mp4
#
# MAP: name of a map that OpenArena has, such as oa_dm1. TRACE: the match, as `camera-director evaluate --trace` reads
# it. CAMERAS.csv: camera paths of its players, as `evaluate --cameras` writes them, of this or any other program: the
# columns t_ms,player,x,y,z,qw,qx,qy,qz,cut, where 1 in `cut` marks a camera that does not continue the previous one.
# --players: whose cameras, side by side, at most 4 (default: the first player's). --seconds: a part of the match,
# counted from its first pose (default: its first 30 s).
#
# The players are bodies at their recorded places, with their weapon where TRACE has a column `weapon` (the number of
# the game), as recordings of the game module have. Doors, lifts and other moving parts of the map move as recorded
# where the recording's `-movers.csv.gz` lies beside TRACE; otherwise they stay shut. Not shown: shots and explosions,
# pickups, and sound.
# Needs no display. The match is played once at its own speed; then every frame is drawn, however long that takes, so
# that the film is smooth on any machine.
set -euo pipefail
caller=$PWD
cd "$(dirname "$0")/.."

usage() {
    echo "film.sh: $1; usage: film.sh MAP CAMERAS.csv TRACE [--players 0,3] [--seconds FROM,TO] -o FILE.mp4" >&2
    exit 2
}
absolute() { if [[ $1 = /* ]]; then echo "$1"; else echo "$caller/$1"; fi; }

players='' seconds=0,30 file='' inputs=()
while [ $# -gt 0 ]; do
    case "$1" in
        -h|--help) sed -n '2,/^set /s/^# \{0,1\}//p' deploy/film.sh; exit 0 ;;
        -o|--players|--seconds) [ $# -ge 2 ] || usage "$1 needs a value" ;;
        -*) usage "unknown option '$1'" ;;
    esac
    case "$1" in
        -o) file=$(absolute "$2"); shift 2 ;;
        --players)
            players=$2; shift 2
            [[ $players =~ ^[0-9]+(,[0-9]+){0,3}$ ]] || usage "--players '$players': expected one to four numbers" ;;
        --seconds)
            seconds=$2; shift 2
            [[ $seconds =~ ^[0-9]+(\.[0-9]+)?,[0-9]+(\.[0-9]+)?$ ]] || usage "--seconds '$seconds': expected FROM,TO" ;;
        *) inputs+=("$1"); shift ;;
    esac
done
[ ${#inputs[@]} -eq 3 ] || usage "expected MAP, CAMERAS.csv and TRACE"
[ -n "$file" ] || usage "no -o FILE.mp4"
map=${inputs[0]} cameras=$(absolute "${inputs[1]}") trace=$(absolute "${inputs[2]}")
[[ $map =~ ^[A-Za-z0-9_-]+$ ]] || usage "MAP '$map': expected the name of a map, such as oa_dm1"
for input in "$cameras" "$trace"; do [ -r "$input" ] || usage "$input cannot be read"; done

source deploy/processes.sh
source deploy/openarena/game.sh
check_output "$file"
trap 'end "${started[@]}"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

deploy/install-packages.sh build game
check_tools
step "Build"
cmake --preset release >/dev/null
cmake --build --preset release --target camera_director_openarena_film

# Match times in ms, and the server's rate: that of the trace, so that its frames are those of the match.
from=$(awk -v s="${seconds%,*}" 'BEGIN { printf "%d", 1000 * s }')
to=$(awk -v s="${seconds#*,}" 'BEGIN { printf "%d", 1000 * s }')
rate=$({ zcat -f "$trace" 2>/dev/null || true; } | awk -F, '
    NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "t_ms") c = i; if (!c) exit }
    NR == 2 { t = $c }
    NR > 2 && $c > t { if (!step || $c - t < step) step = $c - t; t = $c; if (++n == 100) exit }
    END { r = step > 0 ? int(1000 / step) : 20; print (r < 10 ? 10 : (r > 125 ? 125 : r)) }')
movers=${trace%.csv.gz}-movers.csv.gz
[[ $trace = *.csv.gz && -r $movers ]] || movers=''
[ -n "$players" ] || players=$(awk -F, '
    NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "player") c = i; if (!c) exit }
    NR == 2 { print $c; exit }' < <(zcat -f "$cameras"))
IFS=, read -ra wanted <<<"$players"

work=$(mktemp -d "${TMPDIR:-/tmp}/camera-director-film.XXXXXX")
status=0
trap 'status=$?; end "${started[@]}"; [ $status -ne 0 ] || rm -rf "$work"' EXIT

step "Playing the match, $((to / 1000 - from / 1000)) s"
start_server server build/release/lib/openarena/film/qagamex86_64.so "$rate" film_trace "$trace" \
    film_cameras "$cameras" film_movers "$movers" film_players "$players" film_from "$from" film_to "$to"
console server "map $map"
await 120 server "film: \|Can't find map"
grep -q 'film: ready' "$work/server/log" ||
    fail "$(grep -o "film: .*\|Can't find map.*" "$work/server/log" | head -n 1)"
spectators=()
for player in "${wanted[@]}"; do
    start_spectator "player$player"
    # One after the other: the first to connect gets the first camera.
    await 120 server "player$player.*connected"
    spectators+=("player$player=player $player")
done
for spectator in "${spectators[@]}"; do await_recording "${spectator%%=*}"; done
console server 'film start'
await $(((to - from) / 1000 + 60)) server 'film: end'
for spectator in "${spectators[@]}"; do leave "${spectator%%=*}" 'film: end'; done

step "Drawing"
for spectator in "${spectators[@]}"; do start_drawing "${spectator%%=*}"; done
for spectator in "${spectators[@]}"; do finish_drawing "${spectator%%=*}"; done
join_videos "$work/film.mp4" 'film: begin' 'film: end' "${spectators[@]}"
mv "$work/film.mp4" "$file"
echo "$file: $(du -h --apparent-size "$file" | cut -f 1)"
