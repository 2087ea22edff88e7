// The defaults of the C structs.
#include "structs.hpp"

namespace camdir::sdk {

template <>
cdir_context_options default_of<cdir_context_options>() {
    cdir_context_options options{};
    options.struct_size = sizeof options;
    options.network_interface = "lo";
    options.directors = "127.0.0.1";
    return options;
}

template <>
cdir_match_info default_of<cdir_match_info>() {
    cdir_match_info info{};
    info.struct_size = sizeof info;
    info.metres_per_unit = 0.0254F;
    info.rate_hz = 60.0F;
    return info;
}

template <>
cdir_match_event default_of<cdir_match_event>() {
    cdir_match_event event{};
    event.struct_size = sizeof event;
    event.kind = CDIR_EVENT_KILL;
    event.actor = CDIR_NO_PLAYER;
    event.subject = CDIR_NO_PLAYER;
    return event;
}

template <>
cdir_observer_options default_of<cdir_observer_options>() {
    cdir_observer_options options{};
    options.struct_size = sizeof options;
    options.interpolation_delay = 50'000'000;
    return options;
}

template <>
cdir_shot_request default_of<cdir_shot_request>() {
    cdir_shot_request request{};
    request.struct_size = sizeof request;
    request.target = CDIR_CHOOSE_TARGET;
    return request;
}

template <>
cdir_camera default_of<cdir_camera>() {
    cdir_camera camera{};
    camera.struct_size = sizeof camera;
    camera.target = CDIR_CHOOSE_TARGET;
    camera.orientation[3] = 1.0F;
    camera.vertical_fov = 1.0471976F;
    camera.reason_actor = CDIR_NO_PLAYER;
    camera.reason_subject = CDIR_NO_PLAYER;
    return camera;
}

template <>
cdir_shot_status default_of<cdir_shot_status>() {
    cdir_shot_status status{};
    status.struct_size = sizeof status;
    status.state = CDIR_SHOT_NOT_REQUESTED;
    return status;
}

}  // namespace camdir::sdk

using camdir::sdk::initialise;

void cdir_library_options_init(cdir_library_options* to, uint32_t struct_size) noexcept {
    initialise(to, struct_size);
}
void cdir_context_options_init(cdir_context_options* to, uint32_t struct_size) noexcept {
    initialise(to, struct_size);
}
void cdir_player_init(cdir_player* to, uint32_t struct_size) noexcept {
    initialise(to, struct_size);
}
void cdir_match_info_init(cdir_match_info* to, uint32_t struct_size) noexcept {
    initialise(to, struct_size);
}
void cdir_pose_frame_init(cdir_pose_frame* to, uint32_t struct_size) noexcept {
    initialise(to, struct_size);
}
void cdir_match_event_init(cdir_match_event* to, uint32_t struct_size) noexcept {
    initialise(to, struct_size);
}
void cdir_mover_init(cdir_mover* to, uint32_t struct_size) noexcept {
    initialise(to, struct_size);
}
void cdir_mover_frame_init(cdir_mover_frame* to, uint32_t struct_size) noexcept {
    initialise(to, struct_size);
}
void cdir_observer_options_init(cdir_observer_options* to, uint32_t struct_size) noexcept {
    initialise(to, struct_size);
}
void cdir_shot_request_init(cdir_shot_request* to, uint32_t struct_size) noexcept {
    initialise(to, struct_size);
}
void cdir_camera_init(cdir_camera* to, uint32_t struct_size) noexcept {
    initialise(to, struct_size);
}
void cdir_camera_frame_init(cdir_camera_frame* to, uint32_t struct_size) noexcept {
    initialise(to, struct_size);
}
void cdir_shot_status_init(cdir_shot_status* to, uint32_t struct_size) noexcept {
    initialise(to, struct_size);
}
void cdir_view_init(cdir_view* to, uint32_t struct_size) noexcept {
    initialise(to, struct_size);
}
void cdir_observer_counters_init(cdir_observer_counters* to, uint32_t struct_size) noexcept {
    initialise(to, struct_size);
}
