// Simple cameras that the tracker is compared with.
#pragma once

#include <optional>
#include <string_view>

#include "evaluation/camera_path.hpp"

namespace camdir::evaluation {

enum class Peer {
    eye,    // the first-person view
    rigid,  // fixed to the player, 120 units behind the eye, through walls
};

// The peer of this name: eye or rigid.
[[nodiscard]] std::optional<Peer> find_peer(std::string_view name);

// The camera of `peer` at a pose; a cut at a discontinuity. `metres_per_unit` is the map's.
[[nodiscard]] CameraSample place(Peer peer, const TracePose& pose, double metres_per_unit);

// The cameras of `peer` over the trace.
[[nodiscard]] CameraPath follow(Peer peer, const Trace& trace, double metres_per_unit);

}  // namespace camdir::evaluation
