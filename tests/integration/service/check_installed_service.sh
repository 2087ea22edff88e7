#!/usr/bin/env bash
# Installs the server to a new prefix: its unit file must name the program that lies there.
set -euo pipefail
cmake=$1 build_tree=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$cmake" --install "$build_tree" --component server --prefix "$work/prefix" >/dev/null
unit=$work/prefix/lib/systemd/system/camera-director.service
program=$(sed -n 's/^ExecStart=\([^ ]*\) .*/\1/p' "$unit")
[ "$program" = "$work/prefix/bin/camera-director" ] || { echo "$unit starts $program" >&2; exit 1; }
"$program" --version
# Not installed in every container; finds unknown keys and programs that are missing.
if command -v systemd-analyze >/dev/null; then systemd-analyze verify --man=no "$unit"; fi
