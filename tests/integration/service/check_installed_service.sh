#!/usr/bin/env bash
# Installs the server to a new prefix: its unit files must name the programs that lie there, be free of mistakes and stay
# shut off from the rest of the system.
set -euo pipefail
cmake=$1 build_tree=$2
lacks_analyze=false
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$cmake" --install "$build_tree" --component server --prefix "$work/prefix" >/dev/null
for service in camera-director qtv-publisher@; do
    unit=$work/prefix/lib/systemd/system/$service.service
    program=$(sed -n 's/^ExecStart=\([^ ]*\) .*/\1/p' "$unit")
    [ "$program" = "$work/prefix/bin/${service%@}" ] || { echo "$unit starts $program" >&2; exit 1; }
    "$program" --version
    command -v systemd-analyze >/dev/null || { lacks_analyze=true; continue; }
    systemd-analyze verify --man=no "${unit/@/@example}"  # finds unknown keys and programs that are missing
    # Tenths of an exposure, of which 10 is the worst.
    systemd-analyze security --offline=true --threshold=15 --no-pager "$unit" || { echo "$unit is too exposed" >&2; exit 1; }
done
! $lacks_analyze || { echo "needs the package systemd"; exit 77; }
