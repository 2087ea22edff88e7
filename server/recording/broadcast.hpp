// Recordings for many viewers: their resources by paths, for HTTP and its caches (idl/recording.md).
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "recording/sync.hpp"

namespace camdir::recording {

// A match of which there is a recording, as far as viewers may know it.
struct Channel {
    using Clock = std::chrono::steady_clock;

    std::string recording_id;
    std::filesystem::path folder;
    std::string map_name;
    double fragment_duration_s = 0.0;
    double delay_s = 0.0;  // the match's own
    Sync sync;
    Clock::time_point complete_at;  // when the last fragment was
    bool is_live = true;            // more follows
};

// Thread-safe.
class Broadcast {
  public:
    using Time = Channel::Clock::time_point;

    // Replaces the match's channel, which may be of another recording.
    void set(const std::string& match_id, Channel channel);
    // Nothing more follows. The channel stays until nobody has asked for a part of it for ten minutes, its
    // folder is removed, or the match is set again.
    void end(const std::string& match_id, Time now = Channel::Clock::now());
    // Those that have ended and whose time is over.
    void drop_unwanted(Time now = Channel::Clock::now());
    // That of a match that has ended, if its recording is in this folder.
    void remove(const std::filesystem::path& folder);

    struct Answer {
        bool is_json = false;
        std::string tag;  // of what never changes: like that of no other resource; else empty
        std::string content;
    };
    // The resource of a path below /broadcast: "" is the list of matches, "/MATCH/sync",
    // "/MATCH/RECORDING/start" and so on. Reads a file. The path, from outside, is only looked up in the
    // table; nullopt: there is no such resource, or no more, or its file has the header of another one.
    [[nodiscard]] std::optional<Answer> get(std::string_view path, Time now = Channel::Clock::now()) const;

  private:
    [[nodiscard]] std::string list() const;
    [[nodiscard]] std::optional<Channel> find(const std::string& match_id) const;
    void keep_for_longer(const std::string& match_id, Time now) const;

    mutable std::mutex mutex_;
    std::map<std::string, Channel> channels_;        // by match
    mutable std::map<std::string, Time> wanted_at_;  // of those that have ended: at their end, or later
};

}  // namespace camdir::recording
