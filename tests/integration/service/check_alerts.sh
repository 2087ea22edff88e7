#!/usr/bin/env bash
# check_alerts.sh FOLDER: Prometheus accepts the alerts there, and they fire as their tests say. Ends with 77 without
# promtool.
set -euo pipefail
command -v promtool >/dev/null || { echo "needs the package prometheus"; exit 77; }
promtool check rules "$1/alerts.yml"
promtool test rules "$1/alerts.test.yml"
