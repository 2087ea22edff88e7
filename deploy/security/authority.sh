#!/usr/bin/env bash
# Makes and keeps the identities of DDS Security: who is a game server, a director or an observer, and of which matches.
#
#     authority.sh create FOLDER                                     an authority, in a new folder
#     authority.sh issue  FOLDER NAME ROLE MATCHES... [--days 365]   an identity; ROLE: game-server, director or observer
#     authority.sh renew  FOLDER NAME [--days 365]                   its key and certificate anew, with the same grants
#     authority.sh revoke FOLDER NAME                                ends it before its certificate expires
#     authority.sh list   FOLDER                                     all identities, with the day on which they expire
#
# MATCHES are match ids, or patterns of them with * and ?, in quotes: 'cup-*'. FOLDER/identities/NAME is what the program
# with that identity needs, and nothing else may leave FOLDER: whoever has FOLDER/private can be anyone.
# README.md beside it is the manual. Exit codes: 0 done, 1 failed, 2 bad usage.
set -euo pipefail
export LC_ALL=C
umask 077

script=$(basename "$0")
fail() {
    echo "$script: $1" >&2
    exit 1
}
usage() {
    echo "$script: $1; --help shows the commands" >&2
    exit 2
}

max_days=3650
days=365
read_arguments() {
    arguments=()
    while [ $# -gt 0 ]; do
        case "$1" in
            --days)
                if ! [[ ${2:-} =~ ^[1-9][0-9]{0,3}$ ]] || [ "$2" -gt $max_days ]; then
                    usage "--days ${2:-}: expected a number from 1 to $max_days"
                fi
                days=$2
                shift ;;
            -*) usage "unknown option '$1'" ;;
            *) arguments+=("$1") ;;
        esac
        shift
    done
}

check_name() {
    [[ $1 =~ ^[A-Za-z0-9][A-Za-z0-9._-]{0,62}$ ]] ||
        fail "NAME '$1': expected 1 to 63 letters, digits and . _ -, beginning with a letter or digit"
}
check_role() {
    case "$1" in
        game-server|director|observer) ;;
        *) fail "ROLE '$1': expected game-server, director or observer" ;;
    esac
}
check_matches() {
    local pattern
    for pattern in "$@"; do
        [[ $pattern =~ ^[A-Za-z0-9._:@+*?-]{1,63}$ ]] ||
            fail "MATCHES '$pattern': expected 1 to 63 letters, digits and . _ - : @ + * ?, where ? stands for any other character, such as a space or #"
    done
}

# What must not be there twice, nor half: made aside, and moved to its place when it is complete.
begin() { made=$(mktemp -d "$1.XXXXXX") && trap 'rm -rf "$made"' EXIT; }
complete() { mv -T "$made" "$1" && trap - EXIT; }

enter() {
    [ -f "$1/authority.conf" ] || fail "$1: is no authority: expected a folder made by '$script create'"
    cd "$1"
    exec 9>>lock
    flock -w 60 9 || fail "$1: another $script works in it"
}
check_identity() {
    check_name "$1"
    [ -f "grants/$1" ] || fail "no identity '$1' here: '$script list' shows all"
}

# certificate_authority NAME: private/NAME.key and NAME.pem.
certificate_authority() {
    new_key "private/$1.key"
    openssl req -new -config authority.conf -key "private/$1.key" -subj "/CN=$1" -out request.pem
    openssl ca -config authority.conf -batch -notext -selfsign -keyfile "private/$1.key" -in request.pem -out "$1.pem" \
        -extensions authority -startdate "$(at "$from" %Y%m%d%H%M%SZ)" \
        -enddate "$(at $((from + 86400 * 2 * max_days)) %Y%m%d%H%M%SZ)" 2>log || fail "openssl: $(cat log)"
    rm request.pem log
}
new_key() { openssl genpkey -quiet -algorithm EC -pkeyopt ec_paramgen_curve:P-256 -out "$1"; }

# sign FILE.xml FILE.p7s
sign() {
    openssl smime -sign -text -in "$1" -out "$2" -signer permissions_ca.pem -inkey private/permissions_ca.key
}

# Whole messages are encrypted: protection by topic costs two to seven times as much.
governance() {
    cat <<'XML'
<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
     xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-Security/20170801/omg_shared_ca_governance.xsd">
  <domain_access_rules>
    <domain_rule>
      <domains><id_range><min>0</min><max>230</max></id_range></domains>
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>NONE</discovery_protection_kind>
      <liveliness_protection_kind>NONE</liveliness_protection_kind>
      <rtps_protection_kind>ENCRYPT</rtps_protection_kind>
      <topic_access_rules>
        <topic_rule>
          <topic_expression>*</topic_expression>
          <enable_discovery_protection>false</enable_discovery_protection>
          <enable_liveliness_protection>false</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>NONE</metadata_protection_kind>
          <data_protection_kind>NONE</data_protection_kind>
        </topic_rule>
      </topic_access_rules>
    </domain_rule>
  </domain_access_rules>
</dds>
XML
}

# What a role writes and reads: idl/camera_director.idl says who of a match does.
published_by() {
    case "$1" in
        game-server) echo MatchInfo PoseFrame MatchEvent MoverInfo MoverFrame ;;
        director) echo ShownMatch CameraFrame ObserverStatus DirectorSign ;;
        observer) echo ObserverRequest ;;
    esac
}
subscribed_by() {
    case "$1" in
        game-server) ;;
        director) echo MatchInfo PoseFrame MatchEvent MoverInfo MoverFrame ObserverRequest CameraFrame DirectorSign ;;
        observer) echo ShownMatch CameraFrame ObserverStatus ;;
    esac
}

# criteria publish|subscribe "TOPIC..." PATTERN...
criteria() {
    local topics
    read -ra topics <<<"$2"
    [ ${#topics[@]} -gt 0 ] || return 0
    echo "        <$1>"
    echo "          <topics>$(printf '<topic>%s</topic>' "${topics[@]}")</topics>"
    echo "          <partitions>$(printf '<partition>match/%s</partition>' "${@:3}")</partitions>"
    echo "        </$1>"
}

# permissions NAME FROM UNTIL ROLE PATTERN...
permissions() {
    cat <<XML
<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
     xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-Security/20170801/omg_shared_ca_permissions.xsd">
  <permissions>
    <grant name="$1">
      <subject_name>CN=$1</subject_name>
      <validity><not_before>$2</not_before><not_after>$3</not_after></validity>
      <allow_rule>
        <domains><id_range><min>0</min><max>230</max></id_range></domains>
$(criteria publish "$(published_by "$4")" "${@:5}")
$(criteria subscribe "$(subscribed_by "$4")" "${@:5}")
      </allow_rule>
      <default>DENY</default>
    </grant>
  </permissions>
</dds>
XML
}

# A day of grace for clocks that are behind the authority's.
from=$(date -u -d '1 day ago' +%s)
at() { date -u -d "@$1" "+$2"; }

# identity NAME ROLE PATTERN...: the files of one, in $made.
identity() {
    local until=$((from + 86400 * (days + 1)))
    new_key "$made/key.pem"
    openssl req -new -config authority.conf -key "$made/key.pem" -subj "/CN=$1" -out "$made/request.pem"
    openssl ca -config authority.conf -batch -notext -in "$made/request.pem" -out "$made/certificate.pem" \
        -startdate "$(at "$from" %Y%m%d%H%M%SZ)" -enddate "$(at "$until" %Y%m%d%H%M%SZ)" 2>"$made/log" ||
        fail "openssl: $(cat "$made/log")"
    permissions "$1" "$(at "$from" %Y-%m-%dT%H:%M:%SZ)" "$(at "$until" %Y-%m-%dT%H:%M:%SZ)" "${@:2}" \
        >"$made/permissions.xml"
    sign "$made/permissions.xml" "$made/permissions.p7s"
    rm "$made/request.pem" "$made/permissions.xml" "$made/log"
    cp identity_ca.pem permissions_ca.pem governance.p7s revoked.pem "$made/"
}

create() {
    [ $# -eq 1 ] || usage "create: expected FOLDER"
    [ ! -e "$1" ] || fail "$1: is there already, and nothing is overwritten: expected a new folder"
    local folder
    folder=$(realpath -m "$1")
    begin "$folder"
    cd "$made"
    mkdir private issued grants identities
    : >index.txt
    cat >authority.conf <<'CONF'
[ca]
default_ca = identities
[identities]
database = index.txt
new_certs_dir = issued
certificate = identity_ca.pem
private_key = private/identity_ca.key
rand_serial = yes
unique_subject = no
default_md = sha256
default_days = 365
default_crl_days = 7300
policy = named
x509_extensions = identity
[named]
commonName = supplied
[req]
distinguished_name = none
[none]
[authority]
basicConstraints = critical, CA:TRUE, pathlen:0
keyUsage = critical, keyCertSign, cRLSign, digitalSignature
subjectKeyIdentifier = hash
[identity]
basicConstraints = critical, CA:FALSE
keyUsage = critical, digitalSignature, keyAgreement
subjectKeyIdentifier = hash
authorityKeyIdentifier = keyid
CONF
    certificate_authority identity_ca
    certificate_authority permissions_ca
    rm issued/*
    : >index.txt  # of identities alone
    governance >governance.xml
    sign governance.xml governance.p7s
    write_revoked
    complete "$folder"
    echo "$script: $1 is an authority now: keep it secret, and a copy of it" >&2
}

issue() {
    [ $# -ge 4 ] || usage "issue: expected FOLDER NAME ROLE MATCHES..."
    check_name "$2"
    check_role "$3"
    check_matches "${@:4}"
    enter "$1"
    [ ! -e "identities/$2" ] || fail "there is an identity '$2' already, and nothing is overwritten: take another name, or '$script renew'"
    begin "identities/.$2"
    identity "${@:2}"
    printf '%s\n' "${@:3}" >"grants/$2"
    complete "identities/$2"
    tell_made "$1" "$2"
}

renew() {
    [ $# -eq 2 ] || usage "renew: expected FOLDER NAME"
    enter "$1"
    check_identity "$2"
    local grants
    mapfile -t grants <"grants/$2"
    begin "identities/.$2"
    identity "$2" "${grants[@]}"
    mv "identities/$2" "identities/.$2.old"
    complete "identities/$2"
    rm -rf "identities/.$2.old"
    tell_made "$1" "$2"
    echo "$script: its previous certificate stays valid until it expires or is revoked" >&2
}

tell_made() {
    echo "$script: give $1/identities/$2 to the program that is $2, and to nobody else; it expires in $days days" >&2
}

revoke() {
    [ $# -eq 2 ] || usage "revoke: expected FOLDER NAME"
    enter "$1"
    check_identity "$2"
    local certificates serial folder
    certificates=$(awk -F '\t' -v name="/CN=$2" '$1 == "V" && $6 == name { print $4 }' index.txt)
    # The lists are written in any case: an earlier call may have been interrupted before that.
    for serial in $certificates; do
        openssl ca -config authority.conf -revoke "issued/$serial.pem" 2>/dev/null ||
            fail "openssl cannot revoke issued/$serial.pem"
    done
    write_revoked
    for folder in identities/*/; do replace revoked.pem "$folder/revoked.pem"; done
    echo "$script: $2 is revoked. It is out where $1/identities/*/revoked.pem is installed and the program started again:" \
        "first the directors, one after another" >&2
}
# The new one is there, or the old one: never a part.
replace() { cp "$1" "$2.new" && mv "$2.new" "$2"; }
write_revoked() {
    openssl ca -config authority.conf -gencrl -crl_lastupdate "$(at "$from" %Y%m%d%H%M%SZ)" -out revoked.new 2>/dev/null || fail "openssl cannot sign the list of the revoked"
    mv revoked.new revoked.pem
}

list() {
    [ $# -eq 1 ] || usage "list: expected FOLDER"
    enter "$1"
    local file name serial state
    printf '%-24s %-12s %-11s %-8s %s\n' name role expires state matches
    for file in grants/*; do
        [ -f "$file" ] || continue
        name=$(basename "$file")
        [ -f "identities/$name/certificate.pem" ] || { printf '%-24s missing: issue it again\n' "$name"; continue; }
        serial=$(openssl x509 -in "identities/$name/certificate.pem" -noout -serial)
        state=$(awk -F '\t' -v serial="${serial#serial=}" '$4 == serial { print $1 == "R" ? "revoked" : "valid" }' index.txt)
        openssl x509 -in "identities/$name/certificate.pem" -noout -checkend 0 >/dev/null || state=expired
        printf '%-24s %-12s %-11s %-8s %s\n' "$name" "$(head -n 1 "$file")" \
            "$(date -u -d "$(openssl x509 -in "identities/$name/certificate.pem" -noout -enddate | cut -d= -f2)" +%F)" \
            "$state" "$(tail -n +2 "$file" | paste -sd ' ')"
    done
}

case "${1:-}" in
    -h|--help) sed -n '2,/^set /{/^set /!s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"; exit 0 ;;
    create|issue|renew|revoke|list) ;;
    *) usage "expected create, issue, renew, revoke or list, not '${1:-}'" ;;
esac
command -v openssl >/dev/null || fail "openssl is missing: apt install openssl"
read_arguments "${@:2}"
"$1" "${arguments[@]}"
