#!/usr/bin/env bash
# Installs the Debian 12 packages of the groups that are named: build (default), map, test, lint, or all.
# As root or with sudo; on any other system it prints what would be needed and fails.
set -euo pipefail
cd "$(dirname "$0")"
source ./packages.sh

wanted=()
for group in "${@:-build}"; do
    case "$group" in
        build) wanted+=("${build_packages[@]}") ;;
        map) wanted+=("${map_packages[@]}") ;;
        test) wanted+=("${test_packages[@]}") ;;
        lint) wanted+=("${lint_packages[@]}") ;;
        all) wanted+=("${build_packages[@]}" "${map_packages[@]}" "${test_packages[@]}" "${lint_packages[@]}") ;;
        *) echo "install-packages.sh: unknown group '$group'; known: build map test lint all" >&2; exit 2 ;;
    esac
done

missing=()
for package in "${wanted[@]}"; do
    status=$(dpkg-query --show --showformat '${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$status" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

give_up() {
    echo "install-packages.sh: $1; these Debian 12 packages are needed:" >&2
    echo "    ${missing[*]}" >&2
    exit 1
}
command -v apt-get >/dev/null || give_up "this is not Debian"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || give_up "neither root nor sudo"
    as_root=(sudo)
fi

echo "Installing ${#missing[@]} packages: ${missing[*]}"
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"
