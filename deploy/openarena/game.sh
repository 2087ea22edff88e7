# Sourced, after processes.sh: OpenArena's server and clients without a screen, and pictures of what clients record.
# A server or client is a folder below $work: its console (a pipe, `in`), its messages (`log`), its files (`home`).

server=/usr/games/openarena-server
client=/usr/games/openarena
bots=(sarge gargoyle penguin sergei kyonshi tony angelyss rai)
frames_per_second=30
size=640x360  # of a picture

# check_output FILE: refuses a file that cannot be written, before any work.
check_output() {
    local folder
    folder=$(dirname "$1")
    [ -d "$folder" ] || fail "no folder $folder for $1"
    [ ! -d "$1" ] || fail "$1 is a folder"
    if [ -e "$1" ]; then [ -w "$1" ]; else [ -w "$folder" ]; fi || fail "$1 cannot be written"
}

check_tools() {
    local tool
    for tool in "$server" "$client" Xvfb ffmpeg; do
        [ -x "$(command -v "$tool")" ] || fail "no program $tool: deploy/install-packages.sh game film installs it"
    done
}

# console NAME LINE: enters a line on the console of a server or client.
console() { printf '%s\n' "$2" 1<>"$work/$1/in"; }

# lost NAME REASON: fails with the last messages of NAME.
lost() {
    tail -n 5 "$work/$1/log" >&2
    fail "$1: $2; all messages: $work/$1/log"
}

# await SECONDS NAME PATTERN [OFFSET]: until the log of NAME has a line with PATTERN, beyond byte OFFSET.
await() {
    local i pid
    pid=$(<"$work/$2/pid")
    for ((i = 0; i < 10 * $1; ++i)); do
        ! has_line "$2" "$3" "${4:-0}" || return 0
        running "$pid" || break
        sleep 0.1
    done
    has_line "$2" "$3" "${4:-0}" && return 0
    running "$pid" || lost "$2" "it ended before '$3'"
    lost "$2" "no '$3' within $1 s"
}
has_line() { grep -q -a -e "$2" < <(tail -c "+$(($3 + 1))" "$work/$1/log"); }

# await_answer SECONDS NAME LINE PATTERN: enters LINE on the console once a second, until the answer has PATTERN.
await_answer() {
    local i offset
    for ((i = 0; i < $1; ++i)); do
        offset=$(stat -c %s "$work/$2/log")
        console "$2" "$3"
        sleep 1
        ! has_line "$2" "$4" "$offset" || return 0
        running "$(<"$work/$2/pid")" || lost "$2" "it ended before it answered '$3'"
    done
    lost "$2" "no '$4' in its answer to '$3' within $1 s"
}

# stay SECONDS NAME...: sleeps, and fails when one of these programs ends.
stay() {
    local name until
    until=$(awk -v now="$EPOCHREALTIME" -v s="$1" 'BEGIN { printf "%.0f", 1e6 * (now + s) }')
    while [ "${EPOCHREALTIME/./}" -lt "$until" ]; do
        for name in "${@:2}"; do running "$(<"$work/$name/pid")" || lost "$name" "it ended too early"; done
        sleep 0.2
    done
}

# start NAME COMMAND...: with a console.
start() {
    local folder=$work/$1
    mkdir -p "$folder"
    rm -f "$folder/in"
    : >"$folder/log"
    mkfifo "$folder/in"
    # Open for reading and writing: a console that nobody writes to stays open.
    run "$folder/log" "${@:2}" 0<>"$folder/in"
    echo $! >"$folder/pid"
}

# start_server NAME MODULE RATE [SETTING VALUE]...: on loopback, at the first free port from 27960 on, which is then in
# $port. It has no map yet: `console NAME "map MAP"`.
start_server() {
    local folder=$work/$1/home/baseoa
    install -D "$2" "$folder/qagamex86_64.so"
    printf 'set %s "%s"\n' sv_master1 '' sv_master2 '' sv_master3 '' sv_master4 '' sv_master5 '' \
        sv_maxclients 64 sv_maxRate 0 sv_lanForceRate 1 bot_enable 1 bot_nochat 1 bot_minplayers 0 \
        sv_floodProtect 0 g_gametype 0 fraglimit 0 timelimit 0 g_doWarmup 0 g_inactivity 0 g_log '' "${@:4}" \
        >"$folder/server.cfg"
    start "$1" "$server" +set fs_homepath "$work/$1/home" +set dedicated 1 +set net_enabled 1 +set net_ip 127.0.0.1 \
        +set net_port 27960 +set vm_game 0 +set ttycon 0 +set com_hunkMegs 256 +set sv_fps "$3" +exec server.cfg
    await 60 "$1" "Opening IP socket: 127.0.0.1:"
    port=$(sed -n 's/^Opening IP socket: 127.0.0.1:\([0-9]*\).*/\1/p' "$work/$1/log" | tail -n 1)
}

# start_display NAME SIZE: a display in memory, in $DISPLAY.
start_display() {
    local i folder=$work/$1
    mkdir -p "$folder"
    : >"$folder/display"
    run "$folder/display.log" Xvfb -displayfd 3 -screen 0 "${2}x24" -nolisten tcp 3>"$folder/display"
    echo $! >"$folder/display_pid"
    for ((i = 0; i < 100; ++i)); do
        [ ! -s "$folder/display" ] || break
        running "$(<"$folder/display_pid")" || break
        sleep 0.1
    done
    [ -s "$folder/display" ] || fail "no display: $(tail -n 1 "$folder/display.log")"
    DISPLAY=:$(<"$folder/display")
    export DISPLAY
}

# start_client NAME SIZE COMMAND ARGUMENT [SETTING VALUE]...: with a display of its own and nothing of earlier runs.
start_client() {
    local folder=$work/$1/home/baseoa
    mkdir -p "$folder"
    start_display "$1" "$2"
    # In a file, as at most 32 settings fit on a command line.
    printf 'set %s "%s"\n' net_enabled 1 r_mode -1 r_fullscreen 0 r_customwidth "${2%x*}" r_customheight "${2#*x}" \
        r_ignorehwgamma 1 cl_renderer opengl1 s_initsound 0 in_mouse 0 com_introplayed 1 "${@:5}" \
        >"$folder/autoexec.cfg"
    start "$1" env LIBGL_ALWAYS_SOFTWARE=1 LP_NUM_THREADS=1 MESA_SHADER_CACHE_DISABLE=true SDL_AUDIODRIVER=dummy \
        "$client" +set fs_homepath "$work/$1/home" +set ttycon 0 "+$3" "$4"
}

# start_spectator NAME [COMMANDS]: joins the server at $port, spectates and executes COMMANDS. It draws next to nothing:
# its picture is drawn later from what it records.
start_spectator() {
    rm -rf "${work:?}/$1"
    start_client "$1" 64x36 connect "127.0.0.1:$port" name "$1" snaps 125 rate 90000 r_picmip 8 r_vertexLight 1 \
        com_maxfps 20 activeAction "team s${2:+; $2}"
}

# start_recording NAME...: spectators record all that they receive from now on.
start_recording() {
    local name
    for name in "$@"; do await_answer 120 "$name" "record $name" 'recording'; done
    sleep 1  # the server sends a complete frame first
}

# leave NAME TEXT: the spectator ends once it has received the server's message TEXT, and completes its recording.
leave() {
    await 120 "$1" "$2"
    end "$(<"$work/$1/pid")"
    end "$(<"$work/$1/display_pid")"
}

video_folder() { echo "$work/$1-video/home/baseoa/videos"; }

# start_drawing NAME [SETTING VALUE]...: plays what the spectator NAME has recorded and writes every frame of it into a
# video, however long that takes.
start_drawing() {
    local folder=$work/$1-video
    rm -rf "${folder:?}"
    mkdir -p "$folder/home/baseoa/demos"
    cp "$work/$1/home/baseoa/demos/$1".dm_* "$folder/home/baseoa/demos/"
    start_client "$1-video" "$size" demo "$1" activeAction "video $1" nextdemo quit \
        cl_aviFrameRate "$frames_per_second" cl_aviMotionJpeg 1 r_aviMotionJpegQuality 95 r_gamma 1.4 cg_draw2D 0 \
        cg_fov 90 con_notifytime -1 com_blood 0 cg_stats 1 "${@:2}"
}

# finish_drawing NAME: until its video is complete. Fails on an error, and when no picture is added for a minute.
finish_drawing() {
    local name=$1-video pid size='' drawn='' idle=0
    pid=$(<"$work/$name/pid")
    while running "$pid"; do
        ! has_line "$name" '^ERROR' 0 || lost "$name" "the game reports an error"
        size=$(du -sb "$(video_folder "$1")" 2>/dev/null || true)
        if [ "$size" = "$drawn" ]; then idle=$((idle + 1)); else idle=0; fi
        drawn=$size
        [ "$idle" -lt 300 ] || lost "$name" "no picture was added to the video for a minute"
        sleep 0.2
    done
    end "$(<"$work/$name/display_pid")"
    [ -s "$(video_folder "$1")/$1.avi" ] || lost "$name" "it ended without a video"
}

# frame_of NAME TEXT: number of the first video frame after the server's message TEXT.
frame_of() {
    grep -a -A 20 -e "$2" "$work/$1-video/log" | sed -n 's/^cg.clientFrame:\([0-9]*\).*/\1/p' | head -n 1 || true
}

# parts_of NAME: lists its video for ffmpeg. The game begins another file, with a `_` more, whenever one has 2 GB.
parts_of() {
    local file
    for file in "$(video_folder "$1")/$1".avi*; do echo "file '$(basename "$file")'"; done
}

# join_videos FILE BEGIN END NAME=LABEL...: the drawn recordings side by side, from the server's message BEGIN to its
# message END, the same moments in all of them.
join_videos() {
    local file=$1 begin=$2 end=$3 inputs=() filter='' stack='' count=0 spectator first last list
    shift 3
    for spectator in "$@"; do
        local name=${spectator%%=*} label=${spectator#*=}
        first=$(frame_of "$name" "$begin")
        last=$(frame_of "$name" "$end")
        [ -n "$first" ] && [ -n "$last" ] || fail "$name: its recording lacks '$begin' or '$end'"
        list=$(video_folder "$name")/parts
        parts_of "$name" >"$list"
        inputs+=(-f concat -i "$list")
        filter+="[$count:v]trim=start_frame=$first:end_frame=$last,setpts=PTS-STARTPTS,"
        filter+="drawtext=text='$label':x=10:y=10:fontsize=20:fontcolor=white:borderw=2[v$count];"
        stack+="[v$count]"
        count=$((count + 1))
    done
    if [ "$count" -gt 1 ]; then filter+="${stack}hstack=inputs=$count:shortest=1[all]"; else filter+="[v0]null[all]"; fi
    foreground ffmpeg -nostdin -v error -y "${inputs[@]}" -filter_complex "$filter" -map '[all]' -c:v libx264 -crf 23 \
        -preset fast -pix_fmt yuv420p -movflags +faststart -f mp4 "$file" || fail "ffmpeg failed, see above"
}

# contact_sheet VIDEO FILE.png SECONDS: 15 pictures of a video that lasts SECONDS.
contact_sheet() {
    foreground ffmpeg -nostdin -v error -y -i "$1" -vf "fps=15/$3,scale=640:-2,tile=3x5:padding=4" -frames:v 1 \
        -f image2 -c:v png "$2" || fail "ffmpeg failed, see above"
}
