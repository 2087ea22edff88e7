// Validation of what callers pass in and of what arrives.
#pragma once

#include <camera_director.h>
#include <camera_director/camera_director.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "failure.hpp"

namespace camdir::sdk {

// For parameters. Each throws a Failure with CDIR_INVALID_ARGUMENT that says what was expected.
void require(bool condition, const char* text);
// A string of `min_bytes` to `max_bytes` bytes. Reads at most max_bytes + 1 bytes.
[[nodiscard]] std::string checked_string(const char* field, const char* text, std::size_t min_bytes,
                                         std::size_t max_bytes);
[[nodiscard]] std::string checked_match_id(const char* text);
[[nodiscard]] std::string checked_observer_id(const char* text);
void check_frame_time(std::int64_t frame_time);
// The folder of an identity for DDS Security, with all its files.
void check_identity(const std::string& folder);
void check(const cdir_match_info& info, std::span<const cdir_player> players);
// Each is a player's, of another.
void check_player_ids(std::span<const std::uint32_t> ids);
void check(const cdir_match_event& event);

// `count` numbers, and `count` quaternions of length 1 within 1e-3.
[[nodiscard]] bool all_finite(const float* values, std::size_t count);
[[nodiscard]] bool all_unit(const float* quaternions, std::size_t count);

// For samples: true when the sample is valid. `match_id` is that of its partition.
[[nodiscard]] bool is_valid(const camera_director_ShownMatch& info, const std::string& match_id);
[[nodiscard]] bool is_valid(const camera_director_CameraFrame& frame, const std::string& match_id);
[[nodiscard]] bool is_valid(const camera_director_ObserverStatus& status);

}  // namespace camdir::sdk
