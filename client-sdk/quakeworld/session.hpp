// Publishes what a QTV server streams, over lost connections.
#pragma once

#include <camera_director/camera_director.hpp>
#include <string>

#include "base/error.hpp"
#include "connection.hpp"
#include "handshake.hpp"

namespace camdir::qtv {

struct Subscription {
    Address server;
    StreamRequest request;
    std::string match_id;
};

// Runs until a stop is requested, which is success, or the server refuses the stream for good. Connects again
// after anything else: after 1 s, and as long as nothing is published twice as long each time, up to 30 s.
// Writes to standard error what happens.
[[nodiscard]] Result<void> publish_stream(const Subscription& subscription,
                                          const camera_director::Context& context, const StopEvent& stop);

}  // namespace camdir::qtv
