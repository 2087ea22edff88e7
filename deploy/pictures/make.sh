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
"$director" bake "$map" -o "$work/reduced.vfs" --loss 65 --quiet
"$director" evaluate "$work/reduced.vfs" --map "$map" --trace "$trace" --cameras "$work/cameras.csv" >/dev/null

draw() { "$director" render "$work/$1.vfs" --map "$map" -o "$here/$2.png" --size 1000x750 "${@:3}"; }
draw reduced overview --view auto --no-mesh
draw reduced samples --view auto --no-mesh --samples
draw reduced reduced --view auto
inside=-200,-250,150,45,-15
draw whole inside-whole --view "$inside"
draw reduced inside-reduced --view "$inside"
draw reduced paths --view plan --no-mesh --trace "$trace" --cameras "$work/cameras.csv" --between 5,20 --players 0,3,5
