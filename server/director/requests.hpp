// The requests of a match's observers, what becomes of them, and the shots that they share.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "camera/tracker.hpp"
#include "config/config.hpp"
#include "director/attention.hpp"
#include "director/counters.hpp"
#include "director/ports.hpp"
#include "director/roster.hpp"

namespace camdir::director {

// Requests with equal keys share one camera.
struct ShotKey {
    std::uint32_t target = no_player;  // no_player: automatic
    std::vector<std::uint32_t> group;  // ascending, distinct
    std::string profile;
    std::string overrides;  // JSON as nlohmann writes it: keys sorted, no white space

    bool operator==(const ShotKey&) const = default;
};

struct Shot {
    ShotKey key;
    std::uint32_t camera_id = 0;
    camera::Profile profile;
    camera::ShotState state;
    AutomaticTarget automatic;
    std::uint32_t target = no_player;  // who is followed now
    std::uint64_t observers = 0;
    std::uint32_t flags = 0;  // of the last camera
};

// What requests are judged by.
struct Situation {
    const config::Config& config;
    const Roster& roster;
    std::uint64_t epoch = 0;
    std::string refusal;  // why every request is refused; empty: they are not
    std::string no_map;   // why there is no map; empty: there is one
    std::string remark;   // told to those who are accepted
};

// One thread at a time.
class Requests {
  public:
    Requests(std::string match_id, Wire& wire, Counters& counters)
        : match_id_(std::move(match_id)), wire_(wire), counters_(counters) {}

    // Keeps the request, to be judged. When limits.observers are kept already it is refused at once.
    void put(const ObserverRequest& request, const config::Config& config, std::uint64_t epoch);
    void remove(const std::string& observer_id);

    // Profiles changed.
    void resolve_again(const config::Config& config);

    // Decides about every request, ends and begins shots accordingly, and publishes what changed. A shot that
    // runs goes on while anybody wants it; when limits.shots are wanted by more, new ones are refused.
    void judge(const Situation& situation);

    // All shots begin anew, with a cut.
    void restart_shots();

    [[nodiscard]] std::vector<Shot>& shots() { return shots_; }  // by camera_id
    [[nodiscard]] std::size_t observers() const { return observers_.size(); }
    [[nodiscard]] std::vector<ShotView> shot_views() const;
    [[nodiscard]] std::vector<ObserverView> observer_views() const;

  private:
    struct Observer {
        ObserverRequest request;
        ShotKey key;
        camera::Profile profile;
        std::string fault;  // why the request can never be served
        ObserverStatus status;
        bool told = false;  // status is published
    };
    struct Verdict {
        RequestState state = RequestState::accepted;
        std::uint32_t camera_id = 0;
        std::string reason;
    };

    static void resolve(Observer& observer, const config::Config& config);
    [[nodiscard]] static Verdict verdict(const Observer& observer, const Situation& situation);
    void seat(const Observer& observer, std::int64_t most_shots, Verdict& verdict);
    Shot* find_shot(const ShotKey& key);
    Shot& add_shot(const ShotKey& key);
    void tell(Observer& observer, Verdict verdict, std::uint64_t epoch);

    const std::string match_id_;
    Wire& wire_;
    Counters& counters_;
    std::map<std::string, Observer> observers_;
    std::vector<Shot> shots_;
};

}  // namespace camdir::director
