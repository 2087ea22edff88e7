#!/usr/bin/env bash
# Draws the pictures of oa_dm1 (package openarena-081-maps) again, into this folder. Needs a release build.
#     make.sh [--trace FILE.csv.gz]    the match that paths.png shows; default: deploy/demo/match.csv.gz
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
director=$here/../../build/release/bin/camera-director
map=/usr/share/games/openarena/baseoa/pak1-maps.pk3:maps/oa_dm1.bsp
trace=$here/../demo/match.csv.gz
case "${1:-}" in
    "") ;;
    --trace) trace=${2:?make.sh: --trace needs a file} ;;
    *) echo "usage: make.sh [--trace FILE]" >&2; exit 2 ;;
esac
[ -x "$director" ] || {
    echo "make.sh: $director is missing; build it: cmake --preset release && cmake --build --preset release" >&2
    exit 1
}
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
