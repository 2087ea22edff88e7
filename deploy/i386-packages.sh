#!/usr/bin/env bash
# Unpacks Debian's i386 packages that the client library is built against into FOLDER, for client-sdk/cmake/i386.cmake.
# Downloads about 25 MB with apt, into FOLDER only: needs no root and changes nothing on the system.
#     i386-packages.sh FOLDER
set -euo pipefail
case "${1:-}" in
    -h|--help) sed -n '2,/^set /s/^# \{0,1\}//p' "$0"; exit 0 ;;
    "") echo "usage: i386-packages.sh FOLDER" >&2; exit 2 ;;
esac
source "$(dirname "$0")/packages.sh"
folder=$(realpath --canonicalize-missing "$1")  # apt takes relative paths for its own
[ ! -e "$folder/complete" ] || exit 0
command -v apt-get >/dev/null || { echo "i386-packages.sh: this needs Debian's apt-get" >&2; exit 1; }

# The folder appears under its name when everything is in it.
mkdir -p "$(dirname "$folder")"
work=$(mktemp -d "$folder.XXXXXX")
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/apt/lists/partial "$work"/apt/archives/partial "$work"/debs "$work"/root
apt=(apt-get -q -o APT::Architecture=i386 -o APT::Architectures=i386 -o APT::Sandbox::User=root
     -o Dir::State="$work/apt" -o Dir::State::status=/dev/null -o Dir::State::lists="$work/apt/lists"
     -o Dir::Cache="$work/apt" -o Acquire::Languages=none)
"${apt[@]}" update || echo "i386-packages.sh: a package list is missing; trying with the others" >&2
# shellcheck disable=SC2154  # packages.sh sets it
(cd "$work/debs" && "${apt[@]}" download "${i386_packages[@]}")
for package in "$work"/debs/*.deb; do
    dpkg-deb --extract "$package" "$work/root"
done
# Absolute links would lead out of the folder.
find "$work/root" -type l -lname '/*' -printf '%p\n' | while read -r link; do
    ln -sfr "$work/root$(readlink "$link")" "$link"
done
chmod 755 "$work/root"
touch "$work/root/complete"
rm -rf "$folder"
mv "$work/root" "$folder"
