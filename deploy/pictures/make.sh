#!/usr/bin/env bash
# Remakes the README's pictures of oa_dm1 from Debian's openarena-081-maps, into this folder.
#     make.sh [--trace FILE.csv.gz]    the players of the last picture; without: deploy/demo's match
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
director=$here/../../build/release/bin/camera-director
map=/usr/share/games/openarena/baseoa/pak1-maps.pk3:maps/oa_dm1.bsp
trace=$here/../demo/match.csv.gz
case "${1:-}" in
    "") ;;
    --trace) trace=$2 ;;
    *) echo "usage: make.sh [--trace FILE]" >&2; exit 2 ;;
esac
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT

"$director" bake "$map" -o "$work/whole.vfs" --loss 0 --quiet
"$director" bake "$map" -o "$work/reduced.vfs" --quiet
"$director" evaluate "$work/reduced.vfs" --map "$map" --trace "$trace" --cameras "$work/cameras.csv" >/dev/null

draw() { "$director" render "$work/$1.vfs" --map "$map" -o "$here/$2.png" "${@:3}"; }
for picture in "whole map --no-mesh" "whole samples --no-mesh --samples" "whole whole" "reduced reduced"; do
    draw $picture --size 640x480 --view auto
done
draw reduced paths --size 1000x750 --view plan --no-mesh --trace "$trace" --cameras "$work/cameras.csv" --between 5,20 --players 0,3,5
