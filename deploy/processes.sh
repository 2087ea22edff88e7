# Sourced by scripts that run in steps and start programs in the background, which end with the script, each by its
# process id: trap 'end "${started[@]}"' EXIT.

step() { printf '\n== %s\n' "$1" >&2; }

started=()

# run LOG COMMAND...: starts a program; its id is in $!, its messages in LOG. Lock 9 stays with the script.
run() {
    "${@:2}" <&0 >"$1" 2>&1 9>&- &
    started+=("$!")
}

# end PID...: SIGTERM, and SIGKILL to what is still there after 5 s. Those that this shell has started.
end() {
    local pid i
    for pid in "$@"; do kill -TERM "$pid" 2>/dev/null || true; done
    for ((i = 0; i < 50; ++i)); do
        kill -0 "$@" 2>/dev/null || break
        sleep 0.1
    done
    for pid in "$@"; do
        kill -KILL "$pid" 2>/dev/null || true
        wait "$pid" 2>/dev/null || true
    done
}
