# Sourced by demo.sh --openarena, after processes.sh and game.sh: a live match of bots on OpenArena's server, and what a
# spectator with the director's camera sees beside the game's own chase camera.

# The player that both cameras follow. The bots join an empty server one by one: their player numbers count from 0.
followed=2

# start_match: a server with bots whose module talks to the director in $domain.
start_match() {
    local i
    start_server server build/release/lib/openarena/qagamex86_64.so 20 director_domain "$domain" rconPassword ''
    console server 'map oa_dm1'
    await 120 server 'AAS initialized'
    for i in "${!bots[@]}"; do
        console server "addbot ${bots[i]} $((2 + i % 4))"
        await 60 server "ClientBegin: $i"
    done
}

how_to_connect() {
    cat >&2 <<TEXT
Watch it with your own client on this machine (another terminal, with a screen), for the next $seconds s, or longer with --seconds:

    /usr/games/openarena +connect 127.0.0.1:$port

and choose "spectate". Attack and "use item" change the player, \`/director off\` and \`/director auto\` the camera.
TEXT
}

# sheet_of VIDEO: where its contact sheet goes.
sheet_of() {
    local name
    name=$(basename "$1")
    echo "$(dirname "$1")/${name%.*}.png"
}

# film_match SECONDS VIDEO: the match for so long, and its pictures in two files.
film_match() {
    local video=$2 sheet spectator
    sheet=$(sheet_of "$2")
    # A choice counts only once the server has executed the previous one, some frames later.
    start_spectator director "wait 20; follow $followed"
    start_spectator chase "wait 20; director off; wait 20; follow $followed"
    await_answer 180 server 'director status' ' director: follow, .*camera of'
    await_answer 60 server 'director status' ' chase: off, .*view of'
    start_recording director chase
    console server 'say demo begins'
    stay "$1" server director chase
    console server 'director status'
    console server 'say demo ends'
    for spectator in director chase; do leave "$spectator" 'demo ends'; done
    sed -n '/demo begins/,/demo ends/p' "$work/server/log" | sed -n '/^match .*DDS domain/,/game.s thread/p' >&2
    end "$(<"$work/server/pid")"

    step "Drawing what the two spectators saw"
    start_drawing director
    start_drawing chase cg_thirdPerson 1
    for spectator in director chase; do finish_drawing "$spectator"; done
    join_videos "$work/video.mp4" 'demo begins' 'demo ends' "director=camera director" "chase=chase camera of the game"
    contact_sheet "$work/video.mp4" "$work/sheet.png" "$1"
    mv "$work/video.mp4" "$video"
    mv "$work/sheet.png" "$sheet"
    echo "Video: $video ($(du -h --apparent-size "$video" | cut -f 1)). Contact sheet, 15 pictures of it: $sheet"
}
