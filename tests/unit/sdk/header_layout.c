/* The binary interface, version 1: sizes and places that must never change. */
#include <camera_director/camera_director.h>
#include <stddef.h>

#define POINTERS(n) ((n) * sizeof(void*))

_Static_assert(sizeof(cdir_context) == 8 && sizeof(cdir_match) == 8 && sizeof(cdir_observer) == 8, "");
_Static_assert(sizeof(cdir_context_options) == 8 + POINTERS(3), "");
_Static_assert(sizeof(cdir_player) == 104, "");
_Static_assert(offsetof(cdir_player, name) == 8 && offsetof(cdir_player, player_class) == 72, "");
_Static_assert(sizeof(cdir_match_info) == 352, "");
_Static_assert(offsetof(cdir_match_info, epoch) == 16, "");
_Static_assert(offsetof(cdir_match_info, match_id) == 32 && offsetof(cdir_match_info, map_name) == 96, "");
_Static_assert(sizeof(cdir_pose_frame) == 24 + POINTERS(5), "");
_Static_assert(offsetof(cdir_pose_frame, frame_time) == 8 && offsetof(cdir_pose_frame, player_id) == 24, "");
_Static_assert(sizeof(cdir_match_event) == 64 && offsetof(cdir_match_event, frame_time) == 8, "");
_Static_assert(offsetof(cdir_match_event, detail) == 32, "");
_Static_assert(sizeof(cdir_observer_options) == 16, "");
_Static_assert(sizeof(cdir_shot_request) == 16 + POINTERS(3), "");
_Static_assert(sizeof(cdir_camera) == 48 && offsetof(cdir_camera, flags) == 44, "");
_Static_assert(sizeof(cdir_camera_frame) == 56 && offsetof(cdir_camera_frame, frame_number) == 48, "");
_Static_assert(sizeof(cdir_shot_status) == 280 && offsetof(cdir_shot_status, reason) == 24, "");
_Static_assert(sizeof(cdir_view) == 72 && offsetof(cdir_view, camera) == 24, "");
_Static_assert(sizeof(cdir_observer_counters) == 48 && offsetof(cdir_observer_counters, frames) == 8, "");
