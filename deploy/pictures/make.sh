#!/usr/bin/env bash
# Draws the pictures of this folder again. Needs a release build and the package openarena-081-maps.
#     make.sh [--trace FILE.csv.gz] [--clouds FOLDER] [--video FILE.mp4 --second N]
# --trace: the match on oa_dm1 that paths.png shows, by default the demo's. --clouds: where room_scan1.pcd and
# scan_430.ply are; without it their pictures stay as they are.
# --video: of `demo.sh --openarena`, for game.jpg: its picture at second N.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
director=$here/../../build/release/bin/camera-director
map=/usr/share/games/openarena/baseoa/pak1-maps.pk3:maps/oa_dm1.bsp
trace=$here/../demo/match.csv.gz
clouds='' video='' second=0
while [ $# -gt 0 ]; do
    case "$1 ${2:+value}" in
        "--trace value") trace=$2 ;;
        "--clouds value") clouds=$2 ;;
        "--video value") video=$2 ;;
        "--second value") second=$2 ;;
        *)
            echo "usage: make.sh [--trace FILE.csv.gz] [--clouds FOLDER] [--video FILE.mp4 --second N]" >&2
            exit 2 ;;
    esac
    shift 2
done
[ -x "$director" ] || {
    echo "make.sh: $director is missing; build it: cmake --preset release && cmake --build --preset release" >&2
    exit 1
}
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT

# bake NAME MAP [OPTION ...]
bake() { "$director" bake "$2" -o "$work/$1.vfs" --quiet "${@:3}"; }
# draw BAKED MAP PICTURE [OPTION ...]
draw() { "$director" render "$work/$1.vfs" --map "$2" -o "$here/$3.png" --size "${size:-640x480}" "${@:4}"; }

bake unreduced "$map" --loss 0
bake reduced "$map"
draw unreduced "$map" map --no-mesh
draw unreduced "$map" samples --no-mesh --samples
draw unreduced "$map" unreduced
draw reduced "$map" reduced
"$director" evaluate "$work/reduced.vfs" --map "$map" --trace "$trace" --cameras "$work/cameras.csv"
size=1000x750 draw reduced "$map" paths --view plan --no-mesh --trace "$trace" --cameras "$work/cameras.csv" \
    --between 5,20 --players 0,3,5

if [ -n "$clouds" ]; then
    bake room_scan1 "$clouds/room_scan1.pcd" --seed 1,1,0
    draw room_scan1 "$clouds/room_scan1.pcd" room_scan1 --view plan --cut 0
    bake scan_430 "$clouds/scan_430.ply" --seed 4.6,-2.2,3
    draw scan_430 "$clouds/scan_430.ply" scan_430 --view plan --cut 3
fi

if [ -n "$video" ]; then
    ffmpeg -nostdin -v error -y -ss "$second" -i "$video" -frames:v 1 -q:v 4 "$here/game.jpg"
fi
