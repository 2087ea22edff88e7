#!/usr/bin/env bash
# How fast the window draws in a headless Chromium, which has no graphics card, by Chromium's own measures: a live match
# of walking players, each with a camera, in a large and a small window.
#
#     bench-window.sh [--map MAP] [--players 32] [--cameras 32] [--seconds 6] [--hold 0] [--pictures FOLDER]
#                     [--bin FOLDER] [--work FOLDER]
#
# MAP is a file or archive.pk3:member; without it cbctf1 of Debian's openarena-081-maps is used, whose mesh is as large
# as that of the median map. The baked map stays in the work folder for the next run. --pictures: writes what is seen as PNG.
# --hold: then the page stays open for so many seconds, and what memory it has is printed ten times.
# Exit codes: 0 measured, 1 failed, 2 bad usage, 77 no map, Chromium or Node.js.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
bin=$here/../../build/release/bin
work=${TMPDIR:-/tmp}/camera-director-bench-window
map=/usr/share/games/openarena/baseoa/pak1-maps.pk3:maps/cbctf1.bsp
players=32 cameras=32 seconds=6 hold=0 pictures=''

while [ $# -gt 0 ]; do
    case "$1" in -h|--help) sed -n '2,/^set /s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;; esac
    [ $# -ge 2 ] || { echo "bench-window.sh: $1 needs a value" >&2; exit 2; }
    case "$1" in
        --map) map=$2 ;;
        --players) players=$2 ;;
        --cameras) cameras=$2 ;;
        --seconds) seconds=$2 ;;
        --hold) hold=$2 ;;
        --pictures) pictures=$2 ;;
        --bin) bin=$2 ;;
        --work) work=$2 ;;
        *) echo "bench-window.sh: unknown option '$1'; --help lists the options" >&2; exit 2 ;;
    esac
    shift 2
done
[ -e "${map%%:*}" ] || { printf "bench-window.sh: no file %s\nneeds the package openarena-081-maps\n" "${map%%:*}" >&2; exit 77; }
for program in chromium node; do
    command -v "$program" >/dev/null || { echo "bench-window.sh: needs the program $program" >&2; exit 77; }
done
mkdir -p "$work" ${pictures:+"$pictures"}

# shellcheck source=deploy/processes.sh
source "$here/../../deploy/processes.sh"
lock_domain
# shellcheck disable=SC2154  # lock_domain sets it
cat >"$work/config.json" <<CONFIG
{
  "dds": {"domain": $domain},
  "http": {"port": $((20000 + domain * 100))},
  "maps": [{"name": "map", "file": "map.vfs", "source": "$map"}],
  "log": {"level": "warning"}
}
CONFIG
"$bin/camera-director" bake --config "$work/config.json" >&2
foreground node "$here/window.mjs" "$bin" "$work" "$domain" "$players" "$cameras" "$seconds" "$hold" "$pictures"
