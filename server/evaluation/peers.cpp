#include "evaluation/peers.hpp"

namespace camdir::evaluation {

std::optional<Peer> find_peer(std::string_view name) {
    if (name == "eye") return Peer::eye;
    if (name == "rigid") return Peer::rigid;
    return std::nullopt;
}

CameraSample place(Peer peer, const TracePose& pose, double metres_per_unit) {
    const double distance = peer == Peer::rigid ? 120.0 * metres_of_nominal_unit / metres_per_unit : 0.0;
    const Vec3d forward = pose.orientation * Vec3d::UnitX();
    return {pose.eye - distance * forward, pose.orientation, pose.discontinuity};
}

CameraPath follow(Peer peer, const Trace& trace, double metres_per_unit) {
    CameraPath path;
    path.reserve(trace.poses.size());
    for (const TracePose& pose : trace.poses)
        path.push_back(place(peer, pose, metres_per_unit));
    return path;
}

}  // namespace camdir::evaluation
