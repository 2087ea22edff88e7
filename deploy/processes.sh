# Sourced by scripts that run in steps and start programs in the background. However the script ends, these end with
# it, each with all that it has started; then `at_exit STATUS` is called, which a script may define anew.

step() { printf '\n== %s (%s s)\n' "$1" "$SECONDS" >&2; }

fail() {
    echo "$(basename "$0"): $1" >&2
    exit 1
}

at_exit() { :; }
trap 'status=$?; trap "" HUP INT TERM; end $(jobs -pr); at_exit "$status"' EXIT
trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM

# start_program COMMAND...: in the background; its id is in $!. In a session of its own: Ctrl-C reaches the script
# alone, and end() also reaches what the program has started. The locks 8 and 9 stay with the script.
start_program() { setsid "$@" <&0 8>&- 9>&- & }

# run LOG COMMAND...: as start_program, with its messages in LOG.
run() { start_program "${@:2}" >"$1" 2>&1; }

# foreground COMMAND...: waits for it, but a signal to the script ends it at once.
foreground() {
    start_program "$@"
    wait $!
}

# running PID: whether it is a child of this shell that has not ended. The number alone may be another process by now.
running() {
    local children
    children=$(jobs -pr)
    [[ $'\n'$children$'\n' = *$'\n'$1$'\n'* ]]
}

# send SIGNAL PID...: to those that are still running, and to what they have started.
send() {
    local pid
    for pid in "${@:2}"; do
        ! running "$pid" || kill "-$1" -- "-$pid" 2>/dev/null || kill "-$1" "$pid" 2>/dev/null || true
    done
}

# end PID...: SIGTERM, and SIGKILL to what is still there after 5 s.
end() {
    local pid tenths=0
    send TERM "$@"
    for pid in "$@"; do
        while running "$pid" && [ $((tenths += 1)) -le 50 ]; do sleep 0.1; done
    done
    send KILL "$@"
    for pid in "$@"; do wait "$pid" 2>/dev/null || true; done
}

# lock_checkout: as long as this script runs, no other one that calls this uses the folder build.
lock_checkout() {
    mkdir -p build
    exec 8>>build/lock
    flock -n 8 || fail "another demo or film runs in this checkout: wait for its end, or use a copy of the checkout"
}

# lock_domain: a DDS domain in $domain that no other demo, test or soak run on this machine uses as long as this script
# runs. Fails when there is none.
lock_domain() {
    local locks=/tmp/camera-director-test-domains  # for all users, whatever their TMPDIR
    mkdir -m 1777 "$locks" 2>/dev/null || true
    [ ! -O "$locks" ] || chmod 1777 "$locks"
    for domain in $(shuf -i 1-80); do
        local lock=$locks/$domain
        # Any user may have put something else there: nothing is created or locked through a link.
        [ -e "$lock" ] || (umask 022 && set -o noclobber && : >"$lock") 2>/dev/null || continue
        if [ ! -f "$lock" ] || [ -L "$lock" ] || [ ! -r "$lock" ]; then continue; fi
        exec 9<"$lock"
        ! flock -n 9 || return 0
    done
    echo "$(basename "$0"): all DDS domains from 1 to 80 are in use (see the locks in $locks):" \
        "end another demo or test run first" >&2
    return 1
}
