#!/usr/bin/env bash
# Installs, starts, upgrades and removes the packages of build/package/ (deploy/package.sh) in an empty Debian 12: a
# temporary folder for which this needs root, debootstrap and a Debian mirror. There is no systemd in it: the server is
# started with the commands and the user that its unit names.
#     test-package.sh
set -euo pipefail
cd "$(dirname "$0")/.."
case "${1:-}" in
    "") ;;
    -h|--help) sed -n '2,/^set /s/^# \{0,1\}//p' deploy/test-package.sh; exit 0 ;;
    *) echo "usage: deploy/test-package.sh" >&2; exit 2 ;;
esac
source deploy/processes.sh

[ "$(id -u)" -eq 0 ] || fail "this needs root, to enter the empty Debian"
server=$(echo build/package/camera-director_*.deb)
sdk=$(echo build/package/camera-director-client-sdk_*.deb)
[ -f "$server" ] && [ -f "$sdk" ] || fail "no packages in build/package: deploy/package.sh builds them"
deploy/install-packages.sh package

work=$(mktemp -d)
root=$work/root
at_exit() {
    umount -l "$root/proc" 2>/dev/null || true
    rm -rf --one-file-system "$work"
}
config=$root/etc/camera-director/camera-director.json
unit=$root/usr/lib/systemd/system/camera-director.service

inside() { foreground chroot "$root" env DEBIAN_FRONTEND=noninteractive PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"; }
as_service() { chroot --userspec="$(of_unit User)" "$root" "$@"; }
of_unit() { sed -n "s/^$1=-\?//p" "$unit"; }

# install_package FILE [PACKAGE...]
install_package() {
    cp "$1" "$root/tmp/"
    inside apt-get install -y -q --no-install-recommends -o Dpkg::Options::=--force-confold \
        "/tmp/$(basename "$1")" "${@:2}" >"$work/apt.log" 2>&1 || { cat "$work/apt.log" >&2; fail "$1 does not install"; }
}

# A closed room, as a mesh in metres.
write_room() {
    printf 'v %s\n' '0 0 0' '10 0 0' '10 8 0' '0 8 0' '0 0 4' '10 0 4' '10 8 4' '0 8 4'
    printf 'f %s\n' '1 2 3 4' '5 8 7 6' '1 5 6 2' '2 6 7 3' '3 7 8 4' '4 8 5 1'
}

# What an operator would write: any port, as other servers may run on this machine.
write_config() {
    cat <<JSON
{"dds": {"domain": $domain, "participant_index": -1}, "http": {"port": 0},
 "maps": [{"name": "room", "file": "/var/lib/camera-director/room.vfs", "source": "/srv/room.obj", "up": "z"}]}
JSON
}

# serve LOG: starts the server as systemd would, waits until it is ready, and stops it.
serve() {
    local i port
    # shellcheck disable=SC2046  # words of a command
    as_service $(of_unit ExecStartPre) || fail "the unit's ExecStartPre fails"
    # shellcheck disable=SC2046  # words of a command
    run "$1" chroot --userspec="$(of_unit User)" "$root" $(of_unit ExecStart)
    for ((i = 0; i < 600; ++i)); do
        if grep -q 'info: ready' "$1" || ! running $!; then break; fi
        sleep 0.1
    done
    port=$(sed -n 's/.*http: listening on 127.0.0.1 port //p' "$1")
    [ -n "$port" ] && [ "$(curl -s "http://127.0.0.1:$port/-/ready")" = ready ] || { cat "$1" >&2; fail "not ready"; }
    curl -s "http://127.0.0.1:$port/metrics" >"$work/metrics"
    grep -q '^camera_director_map_loaded{map="room"} 1$' "$work/metrics" || { cat "$1" >&2; fail "the map is not loaded"; }
    curl -sf "http://127.0.0.1:$port/" | grep -q '<canvas' || fail "no page to watch matches"
    curl -sf -o "$work/three.js" "http://127.0.0.1:$port/three.js" || fail "the page has no three.js"
    kill -HUP $!
    for ((i = 0; i < 100; ++i)); do ! grep -q ': reloaded' "$1" || break; sleep 0.1; done
    grep -q ': reloaded' "$1" || fail "no reload after SIGHUP"
    end $!
    grep -q 'info: stopped' "$1" || { cat "$1" >&2; fail "it did not stop in order"; }
}

expect() { [ "$@" ] || fail "expected: $*"; }

step "An empty Debian"
lock_domain
foreground debootstrap --variant=minbase bookworm "$root" >"$work/debootstrap.log" 2>&1 ||
    { tail -n 5 "$work/debootstrap.log" >&2; fail "debootstrap failed"; }
# debootstrap leaves an empty folder, in containers a link; the server finds its page's folder by /proc.
rm -d "$root/proc"
mkdir "$root/proc"
mount -t proc proc "$root/proc"

step "Install"
install_package "$server" systemd-standalone-sysusers
inside getent passwd camera-director
inside qtv-publisher --version
expect "$(stat -c %U:%a "$config")" = root:644
# shellcheck disable=SC2046  # words of a command
as_service $(of_unit ExecStartPre) || fail "the configuration of the package is not valid"
folder=/var/lib/$(of_unit StateDirectory)
expect "$(inside stat -c %U:%G:%a "$folder")" = "$(of_unit User):$(of_unit User):$(of_unit StateDirectoryMode | sed 's/^0//')"

step "Configure, bake before the first start, and start"
write_room >"$root/srv/room.obj"
write_config >"$config"
inside runuser -u "$(of_unit User)" -- camera-director bake --quiet \
    --config /etc/camera-director/camera-director.json || fail "no bake before the first start"
rm "$root$folder/room.vfs"  # the service bakes, too
serve "$work/first.log"
grep -q 'map room: baked' "$work/first.log" || fail "the map was not baked"

step "Upgrade"
next=$work/next
dpkg-deb --raw-extract "$server" "$next"
sed -i 's/^Version: .*/&+next/' "$next/DEBIAN/control"
echo >>"$next/etc/camera-director/camera-director.json"
dpkg-deb --root-owner-group --build "$next" "$work/camera-director_next.deb" >/dev/null
install_package "$work/camera-director_next.deb"
[[ $(inside dpkg-query --show --showformat '${Version}' camera-director) = *+next ]] || fail "not upgraded"
write_config | cmp - "$config" || fail "the upgrade changed the operator's configuration"
serve "$work/second.log"
! grep -q 'baking' "$work/second.log" || fail "the map was baked again after the upgrade"

step "Client SDK"
install_package "$sdk"
inside ldconfig -p >"$work/libraries"
grep -q 'libcamera-director-client\.so\.[0-9]* ' "$work/libraries" || fail "the client library is not found"

step "Remove and purge"
inside apt-get remove -y -q camera-director >/dev/null 2>&1
expect ! -e "$root/usr/bin/camera-director"
expect ! -e "$root/usr/bin/qtv-publisher"
expect -s "$config"
expect -s "$root$folder/room.vfs"
inside apt-get purge -y -q camera-director camera-director-client-sdk >/dev/null 2>&1
expect ! -e "$root/etc/camera-director"
expect ! -e "$root$folder"
[ -z "$(find "$root/usr" -name '*camera-director*')" ] || fail "left behind: $(find "$root/usr" -name '*camera-director*')"

step "All passed"
