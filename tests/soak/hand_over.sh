#!/usr/bin/env bash
# Shows in a table what an observer of a replayed match sees when a director or the game server dies, stops, hangs, is
# cut off or comes back, or its clock is stepped, with a leader and a standby.
#
#     hand_over.sh [--bin FOLDER] [--work FOLDER] [OPTION OF hand-over]...
#
# The map is oa_dm1 of Debian's openarena-081-maps, the match deploy/demo/match.csv.gz. The baked map stays in the work
# folder for the next run. In some rows leader, standby and the others have a host each, made of network namespaces: a
# host that is cut off neither receives nor reaches anybody, a deaf one receives nothing, a dumb one reaches nobody, and
# directors that are apart do not reach each other. What this machine lacks for a row is named in its place. Columns: the
# longest time without the observer's camera; pose frames without one; frames older than the one before; changes of the
# director; cuts where the player did not respawn or teleport; the largest step of the camera without a cut, less the
# player's own, in map units; frames without the observer's shot; what no viewer should have seen. Exit codes: 0 nothing
# of that, 1 something, or failed, 2 bad usage, 77 no map, or what all of the rows need.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
bin=$here/../../build/release/bin
work=${TMPDIR:-/tmp}/camera-director-soak
archive=/usr/share/games/openarena/baseoa/pak1-maps.pk3
case "${1-}" in -h|--help) sed -n '2,/^set /s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;; esac
while [ "${1-}" = --bin ] || [ "${1-}" = --work ]; do
    [ $# -ge 2 ] || { echo "hand_over.sh: $1 needs a value" >&2; exit 2; }
    if [ "$1" = --bin ]; then bin=$2; else work=$2; fi
    shift 2
done
[ -e "$archive" ] || { printf "hand_over.sh: no file %s\nneeds the package openarena-081-maps\n" "$archive" >&2; exit 77; }

source_map=$archive:maps/oa_dm1.bsp
mkdir -p "$work"
cat >"$work/hand_over.json" <<CONFIG
{"maps": [{"name": "oa_dm1", "file": "oa_dm1.vfs", "source": "$source_map"}]}
CONFIG
"$bin/camera-director" bake --config "$work/hand_over.json" --quiet
exec "$bin/hand-over" --bin "$bin" "$work/oa_dm1.vfs" "$source_map" "$here/../../deploy/demo/match.csv.gz" "$@"
