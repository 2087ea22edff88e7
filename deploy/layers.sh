#!/usr/bin/env bash
# Whether each folder of server/ includes others of earlier steps alone, in the order that README.md gives.
set -euo pipefail
cd "$(dirname "$0")/.."

case "${1:-}" in -h|--help) sed -n '2,/^set /s/^# \{0,1\}//p' "$0"; exit 0 ;; esac
find server -mindepth 2 \( -name '*.hpp' -o -name '*.cpp' \) -exec grep -oHnE '^#include "[a-z0-9_]+/[^"]*' {} + |
    ORDER=$(sed -n '/^    base <- /,/^$/p' README.md | tr -d '\n') awk -F '[:/"]' '
        BEGIN {
            count = split(ENVIRON["ORDER"], steps, "<-")
            for (step = 1; step <= count; ++step) {
                members = split(steps[step], folders, /[ ,]+/)
                for (i = 1; i <= members; ++i) if (folders[i] != "") step_of[folders[i]] = step
            }
        }
        { own = $2; included = $0; sub(/.*"/, "", included); sub(/\/.*/, "", included) }
        included == own || included == "idl" { next }
        !(own in step_of) || !(included in step_of) || step_of[included] >= step_of[own] {
            print $0 "\": README.md has not " included " before " own; failed = 1
        }
        END { exit failed }'
