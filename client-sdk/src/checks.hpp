// Which values go out to the wire, and which are taken from it.
#pragma once

#include <camera_director.h>
#include <camera_director/camera_director.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "failure.hpp"

namespace camdir::sdk {

// What a caller passes in. Each throws Failure CDIR_INVALID_ARGUMENT that says what was expected.
void require(bool condition, const char* text);
// Reads no further than most + 1 bytes.
[[nodiscard]] std::string checked_string(const char* field, const char* text, std::size_t least,
                                         std::size_t most);
[[nodiscard]] std::string checked_match_id(const char* text);
[[nodiscard]] std::string checked_observer_id(const char* text);
void check_frame_time(std::int64_t frame_time);
void check(const cdir_match_info& info, std::span<const cdir_player> players);
void check(const cdir_pose_frame& frame);
void check(const cdir_match_event& event);

// struct_size is the first field of every parameter struct.
template <class Struct>
void check_struct(const char* name, const Struct* parameter) {
    if (parameter == nullptr) throw Failure{CDIR_INVALID_ARGUMENT, std::string(name) + " is null"};
    require(parameter->struct_size == sizeof(Struct),
            (std::string(name) + ".struct_size is wrong: begin with its _default() function").c_str());
}

// What arrives: true when the sample keeps the contract. `match_id` is the partition's.
[[nodiscard]] bool is_valid(const camera_director_MatchInfo& info, const std::string& match_id);
[[nodiscard]] bool is_valid(const camera_director_CameraFrame& frame, const std::string& match_id);
[[nodiscard]] bool is_valid(const camera_director_ObserverStatus& status);

}  // namespace camdir::sdk
