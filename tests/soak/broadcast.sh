#!/usr/bin/env bash
# Lets viewers of broadcasts ask deploy/broadcast/nginx.conf's cache for as much as it answers, while a director records
# live matches, and judges what the director was asked for meanwhile.
#
#     broadcast.sh [--seconds 30] [--viewers 256] [--matches 4] [--bin FOLDER] [--work FOLDER] [--json FILE]
#
# A viewer asks for the newest fragment of a match, again and again, and in one of 32 requests for `sync`. All run on this
# machine: director, game servers, nginx with a worker a core, wrk. The map is oa_dm1 of Debian's openarena-081-maps.
# Exit codes: 0 every request was answered, and the director asked once for each fragment; 1 not so, or failed; 2 bad
# usage; 77 no map, nginx, wrk or curl.
set -euo pipefail
export LC_ALL=C

here=$(cd "$(dirname "$0")" && pwd)
bin=$here/../../build/release/bin
work=${TMPDIR:-/tmp}/camera-director-soak
seconds=30 viewers=256 matches=4 json=''
map=/usr/share/games/openarena/baseoa/pak1-maps.pk3:maps/oa_dm1.bsp

case "${1-}" in -h|--help) sed -n '2,/^set /s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;; esac
while [ $# -gt 0 ]; do
    [ $# -ge 2 ] || { echo "broadcast.sh: $1 needs a value" >&2; exit 2; }
    case "$1" in
        --seconds) seconds=$2 ;;
        --viewers) viewers=$2 ;;
        --matches) matches=$2 ;;
        --bin) bin=$2 ;;
        --work) work=$2 ;;
        --json) json=$2 ;;
        *) echo "broadcast.sh: unknown option '$1'; --help lists the options" >&2; exit 2 ;;
    esac
    shift 2
done
needs() { echo "broadcast.sh: needs $1" >&2; exit 77; }
[ -e "${map%%:*}" ] || needs "the package openarena-081-maps"
nginx=$(PATH="$PATH:/usr/sbin" command -v nginx) || needs "the package nginx-light"
for tool in wrk curl; do command -v "$tool" >/dev/null || needs "the package $tool"; done

source "$here/../../deploy/processes.sh"
lock_domain
# shellcheck disable=SC2154  # lock_domain sets it
director_port=$((19000 + domain)) cache_port=$((19100 + domain))

rm -rf "$work/broadcast"
mkdir -p "$work/broadcast/cache" "$work/broadcast/recordings"
cd "$work/broadcast"

cat >director.json <<CONFIG
{
  "dds": {"domain": $domain},
  "http": {"port": $director_port},
  "recording": {"folder": "$PWD/recordings"},
  "maps": [{"name": "oa_dm1", "file": "$work/oa_dm1.vfs", "source": "$map"}],
  "log": {"level": "warning"}
}
CONFIG

# What the director is asked for goes to asked.log.
write_nginx_config() {
    local site=$here/../../deploy/broadcast/nginx.conf cache folder
    cache=$(sed -n 's/^proxy_cache_path \([^ ]*\).*/\1/p' "$site")
    [ -d "${cache%/*}" ] || fail "deploy/broadcast/nginx.conf: nginx makes the last folder of $cache, not ${cache%/*}, which is missing here"
    sed -e "s|$cache|$PWD/cache|; s|listen 80 default_server;|listen 127.0.0.1:$cache_port;|; s|127.0.0.1:9464|127.0.0.1:$director_port|" \
        "$site" >site.conf
    grep -q "listen 127.0.0.1:$cache_port;" site.conf && grep -q "server 127.0.0.1:$director_port;" site.conf ||
        fail "deploy/broadcast/nginx.conf has other addresses than this script replaces"
    cat >nginx.conf <<CONFIG
daemon off;
pid $PWD/nginx.pid;
error_log $PWD/nginx.log;
worker_processes auto;
events { worker_connections 4096; }
http {
    map \$upstream_addr \$was_asked { "" 0; default 1; }
    log_format asked "\$camera_director_path";
    access_log $PWD/asked.log asked if=\$was_asked;
    keepalive_requests 1000000;
$(for folder in client_body proxy fastcgi uwsgi scgi; do echo "    ${folder}_temp_path $PWD/$folder;"; done)
    include $PWD/site.conf;
}
CONFIG
}

"$bin/camera-director" bake --config director.json --quiet
write_nginx_config
run director.log "$bin/camera-director" serve --config director.json
director=$!
run players.log "$bin/pose-replay" "$here/../../deploy/demo/match.csv.gz" --domain "$domain" --map-name oa_dm1 \
    --match-prefix cup --copies "$matches" --rate 60
run nginx.out "$nginx" -p "$PWD" -c "$PWD/nginx.conf"
cache=$!

url=http://127.0.0.1:$cache_port
# The paths of the matches' `sync`, each followed by its recording's id.
list() {
    local sync
    curl --silent --fail "$url/broadcast" | grep -o '"sync":"[^"]*"' | cut -d '"' -f 4 | while read -r sync; do
        echo "$sync" "$(curl --silent --fail "$url$sync" | grep -o '"recording":"[^"]*"' | cut -d '"' -f 4)"
    done
}
recorded() { [ "$(find recordings -name delta | wc -l)" -ge $((2 * matches)) ]; }
for ((tenths = 0; ; ++tenths)); do
    running "$director" || fail "the director has ended: see $PWD/director.log"
    running "$cache" || fail "nginx has ended: see $PWD/nginx.log"
    ! recorded || break
    [ "$tenths" -lt 1200 ] || fail "no broadcast of $matches matches within two minutes: see $PWD/director.log"
    sleep 0.1
done

mapfile -t broadcasts < <(list)
[ "${#broadcasts[@]}" = "$matches" ] || fail "not all of the $matches matches are broadcast: see $PWD/director.log"
step "$viewers viewers for $seconds s"
# shellcheck disable=SC2048,SC2086  # each is two words
wrk --threads 2 --connections "$viewers" --duration "${seconds}s" --timeout 10s --script "$here/broadcast.lua" \
    "$url" -- ${broadcasts[*]} >wrk.txt || fail "wrk failed: $(cat wrk.txt)"

# Times that the director was asked, each with its path; the fragments alone.
grep -E '/(full|delta|start)$' asked.log | sort | uniq -c | sort -rn >fragments.txt ||
    fail "the director was asked for no fragment: see $PWD/asked.log"
result=$(awk -v fragments="$(wc -l <fragments.txt)" -v most="$(awk 'NR == 1 { print $1 }' fragments.txt)" \
    -v seconds="$seconds" -v syncs="$(grep -c '/sync$' asked.log)" '
    $1 == "result" { for (i = 2; i <= NF; ++i) { split($i, pair, "="); value[pair[1]] = pair[2] } }
    END {
        printf "{\n  \"requests_per_s\": %.0f, \"megabytes_per_s\": %.1f, \"p99_ms\": %.2f,\n", \
            value["requests"] / value["seconds"], value["bytes"] / value["seconds"] / 1e6, value["p99_us"] / 1000
        printf "  \"failed\": %d, \"fragments\": %d, \"most_asked_of_a_fragment\": %d, \"syncs_asked_per_s\": %.2f\n}\n", \
            value["failed"], fragments, most, syncs / seconds
    }' wrk.txt)
[ -z "$json" ] || printf '%s\n' "$result" >"$json"
printf '%s\n' "$result"
grep -q '"failed": 0, "fragments": [1-9][0-9]*, "most_asked_of_a_fragment": 1,' <<<"$result" ||
    fail "requests failed, or the director was asked more than once for a fragment: see $PWD"
