#!/usr/bin/env bash
# Builds the Debian packages of the server and of its client SDK: build/package/*.deb. Installs what that needs.
#     package.sh
set -euo pipefail
cd "$(dirname "$0")/.."
case "${1:-}" in
    "") ;;
    -h|--help) sed -n '2,/^set /s/^# \{0,1\}//p' deploy/package.sh; exit 0 ;;
    *) echo "usage: deploy/package.sh" >&2; exit 2 ;;
esac

deploy/install-packages.sh build package
cmake --preset package
cmake --build --preset package
rm -f build/package/*.deb  # of other versions
cpack --preset package
