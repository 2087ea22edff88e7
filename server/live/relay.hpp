// Live viewing: what matches show goes to every viewer who has joined them.
#pragma once

#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <shared_mutex>
#include <string>

#include "director/ports.hpp"
#include "live/viewer.hpp"

namespace camdir::live {

struct RelayStatistics {
    std::size_t viewers = 0;
    std::uint64_t frames = 0;  // put before viewers
    std::uint64_t dropped_frames = 0;
    std::uint64_t lost_viewers = 0;  // that did not take their notes
};

// Encodes each frame once for all viewers of its match, and not at all without one. Thread-safe.
class Relay final : public director::Audience {
  public:
    explicit Relay(std::size_t max_viewers) : max_viewers_(max_viewers) {}
    ~Relay() override;

    void show(const director::MatchInfo& shown) override;
    void show(const std::string& match_id, const director::PoseFrame& poses,
              const director::CameraFrame& cameras) override;
    void show(const std::string& match_id, const director::MatchEvent& event) override;
    void request(const director::ObserverRequest& /*request*/) override {}
    void request_ended(const std::string& /*match_id*/, const std::string& /*observer_id*/) override {}
    void end(const std::string& match_id) override;

    enum class Admission { joined, no_match, full };
    // The viewer receives first what a late joiner needs: the match, its history, the last frame. It stays
    // until Viewer::leave or the match's end.
    [[nodiscard]] Admission join(const std::string& match_id, const std::shared_ptr<Viewer>& viewer);

    // The server stops: no viewer joins any more. Those who watch are told, and have so long to take what
    // waits for them and leave; returns how many have not.
    std::size_t close(std::chrono::milliseconds limit);

    [[nodiscard]] RelayStatistics statistics() const;

  private:
    class Channel;
    [[nodiscard]] std::shared_ptr<Channel> find(const std::string& match_id) const;

    const std::size_t max_viewers_;
    mutable std::shared_mutex mutex_;
    std::map<std::string, std::shared_ptr<Channel>> channels_;  // by match
    bool closed_ = false;
    std::atomic<std::uint64_t> frames_{0}, dropped_frames_{0}, lost_viewers_{0};
};

}  // namespace camdir::live
