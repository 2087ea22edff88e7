#!/usr/bin/env bash
# check_kubernetes.sh DEPLOY CAMERA_DIRECTOR: the example in DEPLOY/kubernetes builds with identities of
# DEPLOY/security, the server accepts the configuration of each of its shards, and shards and peers are those that the
# example makes. Ends with 77 without kubectl or the example's map.
set -euo pipefail
deploy=$1 server=$2
maps=/usr/share/games/openarena/baseoa
command -v kubectl >/dev/null || { echo "needs the package kubernetes-client"; exit 77; }
[ -e "$maps/pak1-maps.pk3" ] || { echo "needs the package openarena-081-maps"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$1" >&2; exit 1; }

cp -r "$deploy/kubernetes" "$work/kubernetes"
example=$work/kubernetes/example
shards=$(basename -a "$example"/shards/*/)
(umask 077 && openssl rand -hex 32 >"$example/token")
"$deploy/security/authority.sh" create "$work/authority" 2>/dev/null
for shard in $shards; do
    "$deploy/security/authority.sh" issue "$work/authority" "shard-$shard" director '*' 2>/dev/null
    cp -rT "$work/authority/identities/shard-$shard" "$example/shards/$shard/identity"
done

kubectl kustomize "$example" >"$work/built.yaml"
# The names of everything of a kind: fields of a document come in the order of the alphabet.
names() { sed -n "/^kind: $1$/,/^---$/s/^  name: //p" "$work/built.yaml"; }
# The lists of strings in the configuration, one string per line.
list() { tr -d '\n' <"$work/configuration.json" | sed -n "s/.*\"$1\": *\[\([^]]*\)\].*/\1/p" | tr -d '" ' | tr ',' '\n'; }

sed -n '/^  camera-director.json: |$/,/^[^ ]/s/^    //p' "$work/built.yaml" >"$work/configuration.json"
[ -s "$work/configuration.json" ] || fail "no ConfigMap has camera-director.json"
for shard in $shards; do
    sed "s|/srv/maps|$maps|; s|/run/camera-director/identity|$example/shards/$shard/identity|
         s|/run/camera-director/http|$example|" "$work/configuration.json" >"$work/$shard.json"
    "$server" serve --config "$work/$shard.json" --shard "$shard" --check
    grep -qx "  *camera-director/shard: $shard" "$work/built.yaml" || fail "no object has the label of shard $shard"
done

made=$(names StatefulSet | sort)
expected=$(list shards | sed 's/$/-camera-director/' | sort)
[ "$made" = "$expected" ] || fail "StatefulSets: $made; expected $expected, from dds.shards"
made=$(names Service | grep -E -- '-[0-9]+$' | sed 's/$/:7410/' | sort)
expected=$(list peers | sort)
[ "$made" = "$expected" ] || fail "directors' addresses: $made; expected $expected, from dds.peers"
