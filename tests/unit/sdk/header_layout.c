/* The binary interface, version 2: sizes and places that must never change. */
#include <camera_director/camera_director.h>
#include <stddef.h>

_Static_assert(sizeof(cdir_context) == 8 && sizeof(cdir_match) == 8 && sizeof(cdir_observer) == 8, "");
_Static_assert(sizeof(cdir_library_options) == 48 && offsetof(cdir_library_options, allocate) == 8, "");
_Static_assert(offsetof(cdir_library_options, log_data) == 40, "");
_Static_assert(sizeof(cdir_context_options) == 40, "");
_Static_assert(offsetof(cdir_context_options, network_interface) == 8, "");
_Static_assert(offsetof(cdir_context_options, directors) == 16, "");
_Static_assert(offsetof(cdir_context_options, cyclone_xml) == 24, "");
_Static_assert(offsetof(cdir_context_options, security) == 32, "");
_Static_assert(sizeof(cdir_player) == 112, "");
_Static_assert(offsetof(cdir_player, name) == 16 && offsetof(cdir_player, player_class) == 80, "");
_Static_assert(sizeof(cdir_match_info) == 352, "");
_Static_assert(offsetof(cdir_match_info, epoch) == 16, "");
_Static_assert(offsetof(cdir_match_info, match_id) == 32 && offsetof(cdir_match_info, map_name) == 96, "");
_Static_assert(sizeof(cdir_pose_frame) == 88, "");
_Static_assert(offsetof(cdir_pose_frame, frame_time) == 8 && offsetof(cdir_pose_frame, player_id) == 24, "");
_Static_assert(offsetof(cdir_pose_frame, eye) == 32 && offsetof(cdir_pose_frame, flags) == 56, "");
_Static_assert(offsetof(cdir_pose_frame, player_id_stride) == 64, "");
_Static_assert(offsetof(cdir_pose_frame, flags_stride) == 80, "");
_Static_assert(sizeof(cdir_match_event) == 64 && offsetof(cdir_match_event, frame_time) == 8, "");
_Static_assert(offsetof(cdir_match_event, detail) == 32, "");
_Static_assert(sizeof(cdir_mover) == 136 && offsetof(cdir_mover, model) == 8, "");
_Static_assert(offsetof(cdir_mover, kind) == 72 && offsetof(cdir_mover, half_spaces) == 104, "");
_Static_assert(offsetof(cdir_mover, balls) == 120 && offsetof(cdir_mover, hull_count) == 128, "");
_Static_assert(sizeof(cdir_mover_frame) == 64 && offsetof(cdir_mover_frame, mover_id) == 24, "");
_Static_assert(offsetof(cdir_mover_frame, orientation) == 40, "");
_Static_assert(offsetof(cdir_mover_frame, mover_id_stride) == 48, "");
_Static_assert(sizeof(cdir_observer_options) == 16, "");
_Static_assert(sizeof(cdir_shot_request) == 40 && offsetof(cdir_shot_request, group) == 8, "");
_Static_assert(offsetof(cdir_shot_request, overrides) == 24, "");
_Static_assert(offsetof(cdir_shot_request, group_count) == 32, "");
_Static_assert(offsetof(cdir_shot_request, team) == 36 && offsetof(cdir_shot_request, reserved) == 37, "");
_Static_assert(sizeof(cdir_camera) == 96 && offsetof(cdir_camera, position) == 16, "");
_Static_assert(offsetof(cdir_camera, reason_actor) == 56 && offsetof(cdir_camera, reason) == 64, "");
_Static_assert(sizeof(cdir_camera_frame) == 56 && offsetof(cdir_camera_frame, frame_number) == 48, "");
_Static_assert(sizeof(cdir_shot_status) == 280 && offsetof(cdir_shot_status, reason) == 24, "");
_Static_assert(sizeof(cdir_view) == 24 && offsetof(cdir_view, late) == 16, "");
_Static_assert(sizeof(cdir_observer_counters) == 56 && offsetof(cdir_observer_counters, frames) == 8, "");
