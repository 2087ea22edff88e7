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
export LC_ALL=C  # numbers have a decimal point
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
            [[ $players =~ ^[0-9]{1,6}(,[0-9]{1,6}){0,3}$ ]] || usage "--players '$players': expected one to four numbers" ;;
        --seconds)
            seconds=$2; shift 2
            [[ $seconds =~ ^[0-9]{1,6}(\.[0-9]+)?,[0-9]{1,6}(\.[0-9]+)?$ ]] ||
                usage "--seconds '$seconds': expected FROM,TO, each at most 999999" ;;
        *) inputs+=("$1"); shift ;;
    esac
done
[ ${#inputs[@]} -eq 3 ] || usage "expected MAP, CAMERAS.csv and TRACE"
[ -n "$file" ] || usage "no -o FILE.mp4"
map=${inputs[0]} cameras=$(absolute "${inputs[1]}") trace=$(absolute "${inputs[2]}")
[[ $map =~ ^[A-Za-z0-9_-]+$ ]] || usage "MAP '$map': expected the name of a map, such as oa_dm1"
for input in "$cameras" "$trace"; do
    [ -f "$input" ] && [ -r "$input" ] || usage "$input cannot be read"
    # It goes through the game's console.
    [[ $input != *[\"$'\n']* ]] || usage "$input: a name with quotation marks or line breaks"
done
milliseconds() { awk -v s="$1" 'BEGIN { printf "%d", 1000 * s + 0.5 }'; }
from=$(milliseconds "${seconds%,*}") to=$(milliseconds "${seconds#*,}")
[ "$from" -lt "$to" ] || usage "--seconds '$seconds': expected FROM below TO"

source deploy/processes.sh
source deploy/openarena/game.sh
check_output "$file"

deploy/install-packages.sh build game film
check_tools
lock_checkout
step "Build"
foreground cmake --preset release >/dev/null
foreground cmake --build --preset release --target camera_director_openarena_film

# The server's rate: that of the trace, so that its frames are those of the match.
rate=$({ zcat -f "$trace" 2>/dev/null || true; } | awk -F, '
    { sub(/\r$/, "") }
    NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "t_ms") c = i; if (!c) exit }
    NR == 2 { t = $c }
    NR > 2 && $c > t { if (!step || $c - t < step) step = $c - t; t = $c; if (++n == 100) exit }
    END { r = step > 0 ? int(1000 / step) : 20; print (r < 10 ? 10 : (r > 125 ? 125 : r)) }')
movers=${trace%.csv.gz}-movers.csv.gz
[[ $trace = *.csv.gz && -r $movers ]] || movers=''
[ -n "$players" ] || players=$({ zcat -f "$cameras" 2>/dev/null || true; } | awk -F, '
    { sub(/\r$/, "") }
    NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "player") c = i; if (!c) exit }
    NR == 2 { print $c; exit }')
wanted=()
IFS=, read -ra numbers <<<"$players"
for player in "${numbers[@]}"; do
    [[ $player =~ ^[0-9]{1,6}$ ]] || fail "$cameras: expected a number in column 'player', found '$player'"
    player=$((10#$player))
    [[ " ${wanted[*]} " != *" $player "* ]] || fail "--players '$players': player $player twice"
    wanted+=("$player")
done
[ ${#wanted[@]} -gt 0 ] || fail "$cameras: expected a header with 'player' and a row of numbers"

work=$(mktemp -d build/film.XXXXXX)
at_exit() {
    case "$1" in
        0|129|130|143) rm -rf "$work" ;;
        *) echo "film.sh: its files are kept in $PWD/$work" >&2 ;;
    esac
}

step "Playing the match, $(awk -v ms=$((to - from)) 'BEGIN { print ms / 1000 }') s"
start_server server build/release/lib/openarena/film/qagamex86_64.so "$rate" film_trace "$trace" \
    film_cameras "$cameras" film_movers "$movers" film_players "$(IFS=,; echo "${wanted[*]}")" \
    film_from "$from" film_to "$to"
console server "map $map"
await 120 server "film: \|Can't find map"
grep -q 'film: ready' "$work/server/log" ||
    fail "$(grep -o "film: .*\|Can't find map.*" "$work/server/log" | head -n 1)"
spectators=()
for player in "${wanted[@]}"; do
    start_spectator "player$player"
    # One after the other: the first to connect gets the first camera.
    await 120 server "player${player}[^0-9].*connected"
    # Only then: what is entered while a client loads swallows its command to spectate.
    await 120 server "n\\\\player$player\\\\t\\\\3"
    spectators+=("player$player=player $player")
done
start_recording "${spectators[@]%%=*}"
console server 'film start'
await $(((to - from) / 1000 + 60)) server 'film: end'
for spectator in "${spectators[@]}"; do leave "${spectator%%=*}" 'film: end'; done

step "Drawing"
for spectator in "${spectators[@]}"; do start_drawing "${spectator%%=*}"; done
for spectator in "${spectators[@]}"; do finish_drawing "${spectator%%=*}"; done
join_videos "$work/film.mp4" 'film: begin' 'film: end' "${spectators[@]}"
mv "$work/film.mp4" "$file"
echo "$file: $(du -h --apparent-size "$file" | cut -f 1)"
