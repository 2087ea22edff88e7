// What a recording holds: a match's messages in the order of their receipt, and the state that follows from
// them. idl/recording.md defines the bytes.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "director/messages.hpp"

namespace camdir::recording {

// The request of an observer that has left.
struct Withdrawal {
    std::string observer_id;
};

using Message =
    std::variant<director::MatchInfo, director::PoseFrame, director::MatchEvent, director::ObserverRequest,
                 Withdrawal, director::CameraFrame, director::MoverInfo, director::MoverFrame>;

// The poses of a record are among the movers of the records before it, of the same epoch, and have none
// themselves.
struct Record {
    std::int64_t time = 0;  // ns, of the recorder's clock; never descends
    Message message;
};

// The match after some records.
struct State {
    std::optional<director::MatchInfo> info;
    // The last poses of the players of the last frame and of `info`, ascending by player.
    std::optional<director::PoseFrame> poses;
    std::map<std::string, director::ObserverRequest> requests;  // by observer
    std::optional<director::CameraFrame> cameras;               // the last frame's
    std::optional<director::MoverInfo> movers;
    // The last one, also with the last poses of those of `movers` that it leaves out.
    std::optional<director::MoverFrame> mover_frame;

    // A new epoch or map in a MatchInfo forgets poses, cameras and movers.
    void apply(const Message& message);

    // The messages that make this state from an empty one.
    [[nodiscard]] std::vector<Message> messages() const;
};

}  // namespace camdir::recording
