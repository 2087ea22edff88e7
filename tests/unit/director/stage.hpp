// A director with made-up maps and poses, which publishes into memory.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "director/director.hpp"

namespace camdir::director {

inline constexpr std::int64_t ms = 1'000'000;  // in ns

// Keeps everything that is published. Thread-safe.
class MemoryPublisher : public Publisher {
  public:
    void publish(const MatchInfo& shown) override;
    void end(const std::string& match_id) override;
    void publish(const std::string& match_id, const CameraFrame& frame) override;
    bool publish(const ObserverStatus& status) override;
    void withdraw(const std::string& match_id, const std::string& observer_id) override;
    void forget(const std::string& match_id) override;
    void give_up(const std::string& match_id) override;

    // The newest description; none before the first and after the end.
    [[nodiscard]] std::optional<MatchInfo> shown(const std::string& match_id = "m") const;
    [[nodiscard]] std::vector<CameraFrame> frames(const std::string& match_id = "m") const;
    // The newest status; one with the reason "none" when there is none.
    [[nodiscard]] ObserverStatus status(const std::string& observer_id,
                                        const std::string& match_id = "m") const;
    [[nodiscard]] std::size_t statuses_published() const;
    [[nodiscard]] bool has_status(const std::string& observer_id, const std::string& match_id = "m") const;
    [[nodiscard]] bool forgotten(const std::string& match_id) const;
    [[nodiscard]] bool given_up(const std::string& match_id) const;

  private:
    mutable std::mutex mutex_;
    std::map<std::string, MatchInfo> shown_;
    std::map<std::string, std::vector<CameraFrame>> frames_;
    std::map<std::pair<std::string, std::string>, ObserverStatus> statuses_;
    std::size_t statuses_published_ = 0;
    std::set<std::string> forgotten_;
    std::set<std::string> given_up_;
};

// The director receives this frame alone.
void receive(Director& director, const std::string& match_id, const PoseFrame& frame);

// A director with the map "square", in state ready; players walk around its middle.
struct Stage {
    explicit Stage(const config::Config& config = default_config(), Audiences audiences = {});

    [[nodiscard]] static config::Config default_config();
    [[nodiscard]] static freespace::Freespace square();

    [[nodiscard]] static MatchInfo info(const std::string& match_id = "m", std::uint64_t epoch = 1,
                                        const std::vector<std::uint32_t>& players = {1, 2, 3});
    [[nodiscard]] static ObserverRequest request(const std::string& observer_id, std::uint32_t target = 1,
                                                 const std::string& match_id = "m");
    // The frame at `number` times 50 ms: all players are alive and walk.
    [[nodiscard]] static PoseFrame poses(std::uint32_t number, std::uint64_t epoch = 1,
                                         const std::vector<std::uint32_t>& players = {1, 2, 3});

    // Pass a message to the director and wait until it is processed.
    bool start(const MatchInfo& match = info());
    void ask(const ObserverRequest& wanted);
    void send(const PoseFrame& frame, const std::string& match_id = "m");

    MemoryPublisher publisher;
    MapLibrary maps;
    Director director;
};

// The first camera cuts.
[[nodiscard]] bool cuts(const CameraFrame& frame);

}  // namespace camdir::director
