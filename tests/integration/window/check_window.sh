#!/usr/bin/env bash
# The window in a real browser: check_window.sh BIN_DIR. Exit code 77: skipped.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=deploy/processes.sh
source "$here/../../../deploy/processes.sh"
for program in chromium node; do
    command -v "$program" >/dev/null || { echo "needs the program $program"; exit 77; }
done
work=$(mktemp -d)
at_exit() { rm -rf "$work"; }
lock_domain
# shellcheck disable=SC2154  # lock_domain sets it
foreground node "$here/window_test.mjs" "$1" "$work" "$domain"
foreground node "$here/playback_test.mjs" "$1" "$work" "$domain"
