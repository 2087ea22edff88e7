#!/usr/bin/env bash
# Installs what is missing of the Debian 12 packages in the named groups: build (default), map, game, film, test,
# lint, package, or all.
# Needs root or sudo when something is missing. On any other system it prints what is missing and fails.
#     install-packages.sh [GROUP ...]
set -euo pipefail
cd "$(dirname "$0")"
source ./packages.sh

wanted=()
for group in "${@:-build}"; do
    case "$group" in
        -h|--help) sed -n '2,/^set /s/^# \{0,1\}//p' install-packages.sh; exit 0 ;;
        build) wanted+=("${build_packages[@]}") ;;
        map) wanted+=("${map_packages[@]}") ;;
        game) wanted+=("${game_packages[@]}") ;;
        film) wanted+=("${film_packages[@]}") ;;
        test) wanted+=("${test_packages[@]}") ;;
        lint) wanted+=("${lint_packages[@]}") ;;
        package) wanted+=("${package_packages[@]}") ;;
        all)
            wanted+=("${build_packages[@]}" "${map_packages[@]}" "${game_packages[@]}" "${film_packages[@]}"
                "${test_packages[@]}" "${lint_packages[@]}" "${package_packages[@]}") ;;
        *) echo "install-packages.sh: unknown group '$group'; known: build map game film test lint package all" >&2; exit 2 ;;
    esac
done

missing=()
for package in "${wanted[@]}"; do
    status=$(dpkg-query --show --showformat '${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$status" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

give_up() {
    echo "install-packages.sh: $1. Install these Debian 12 packages, then run this again:" >&2
    echo "    ${missing[*]}" >&2
    exit 1
}
system=$(. /etc/os-release 2>/dev/null && echo "${ID:-} ${VERSION_ID:-}") || true
[ "$system" = "debian 12" ] || give_up "this system is not Debian 12"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || give_up "this needs root, and there is no sudo"
    as_root=(sudo)
fi

echo "Installing ${#missing[@]} packages: ${missing[*]}"
# Debian would start these, which listen on all interfaces, as soon as they are installed.
for package in prometheus nginx-light; do
    if [[ " ${missing[*]} " = *" $package "* ]] && command -v systemctl >/dev/null; then
        "${as_root[@]}" systemctl mask "${package%-light}.service"
    fi
done
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"
