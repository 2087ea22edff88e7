// The requests of a match's observers, the decisions about them, and the shots that they share.
#pragma once

#include <cstdint>
#include <limits>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_set>
#include <vector>

#include "base/log_limit.hpp"
#include "camera/group/group_shot.hpp"
#include "camera/tracker.hpp"
#include "config/config.hpp"
#include "director/counters.hpp"
#include "director/edit.hpp"
#include "director/ports.hpp"
#include "director/roster.hpp"

namespace camdir::director {

// Requests with equal keys share one camera.
struct ShotKey {
    std::uint32_t target = no_player;  // no_player: automatic; whole_group: a group shot
    std::vector<std::uint32_t> group;  // distinct; ascending, of a group shot as requested
    std::string profile;
    std::string overrides;  // canonical JSON: keys sorted, no white space
    std::uint8_t team = 0;  // of an automatic shot: whom it shows; 0: any

    bool operator==(const ShotKey&) const = default;
};

// A step that was made before it was due.
struct PreparedStep {
    double time = 0.0;  // of the timeline
    camera::ShotState state;
    camera::GroupState group;
    camera::Camera camera;
};

struct Shot {
    ShotKey key;
    std::uint32_t camera_id = 0;
    camera::Profile profile;
    camera::ShotState state;
    camera::GroupState group;                  // in its place, of a group shot
    std::unique_ptr<camera::Outlook> outlook;  // likewise
    AutomaticShot automatic;
    std::uint32_t target = no_player;       // the player followed now; of a group shot the first of its group
    std::uint32_t fixed = freespace::none;  // the fixed shot of the map that is shown now instead
    std::uint64_t observers = 0;
    std::uint32_t flags = 0;         // of the last camera
    Vec3f position = Vec3f::Zero();  // likewise
    // Follows from `state`, `group`, `target` and `profile` as they are; its memory is kept.
    bool is_prepared = false;
    std::unique_ptr<PreparedStep> prepared;

    [[nodiscard]] bool is_automatic() const { return key.target == no_player; }
    [[nodiscard]] bool is_of_group() const { return key.target == whole_group; }

    // Begins again, with a cut.
    void restart() {
        state = {};
        state.plan.phase = camera_id;
        group = {};
        group.phase = camera_id;
        if (is_of_group()) outlook = std::make_unique<camera::Outlook>();  // there may be another map
        is_prepared = false;
    }
};

// The camera of a fixed shot of the map, which has no target; its clearance and its flags are left to the
// caller.
[[nodiscard]] ShotCamera still_camera(std::uint32_t camera_id, const freespace::FixedShot& shot);

// What decides about requests.
struct RequestContext {
    const config::Config& config;
    const Roster& roster;
    std::uint64_t epoch = 0;
    std::string refusal;      // why all requests are refused; empty when they are not
    std::string missing_map;  // why the match has no map, or is not shown yet; empty when it is
    std::string remark;       // reason in the status of accepted requests
    std::int64_t now = 0;     // steady clock, ns
};

// One thread at a time.
class Requests {
  public:
    Requests(std::string match_id, Publisher& publisher, MatchCounters& counters)
        : match_id_(std::move(match_id)), publisher_(publisher), counters_(counters) {}

    static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

    // Keeps the request until the next reconcile(). When limits.observers are kept already, it is refused and
    // waits for one of them to leave, with at most as many others. Returns false when it is the observer's
    // last one again: who has lost the answer is answered again; and when the observer, who cannot even wait,
    // has been told so before.
    bool put(const ObserverRequest& request, const config::Config& config, std::uint64_t epoch);
    void remove(const std::string& observer_id, const config::Config& config);

    // Looks profiles up again after a configuration change.
    void resolve_again(const config::Config& config);

    // Decides about every request, ends and begins shots accordingly, and publishes the statuses that
    // changed, and those that observers do not have: these once a second. A running shot continues while any
    // request wants it; new shots beyond limits.shots are refused. The first step of a group shot takes
    // milliseconds: eight begin at once, five a second after that, in the order in which they were asked for.
    // Until then observers keep their shot from before, or are accepted for a camera that begins soon. Only a
    // restart of all shots is not spread.
    void reconcile(const RequestContext& context);
    // When the next reconcile() publishes a status that has not changed, or lets a group shot begin.
    [[nodiscard]] std::int64_t next_answers() const { return next_answers_; }

    // All shots start again, with a cut.
    void restart_shots();

    [[nodiscard]] std::vector<Shot>& shots() { return shots_; }  // by camera_id
    [[nodiscard]] std::size_t observers() const { return observers_.size(); }
    [[nodiscard]] std::vector<ShotView> shot_views() const;
    [[nodiscard]] std::vector<ObserverView> observer_views() const;

  private:
    struct Answer {
        ObserverStatus status = {};
        bool published = false;       // the observer has it
        std::int64_t repeats_at = 0;  // otherwise
    };
    struct Observer {
        ObserverRequest request;
        ShotKey key;
        camera::Profile profile;
        std::string error;                             // why the request is invalid; empty when it is valid
        std::optional<ShotKey> shown = {};             // of its shot; of the one before while that begins
        std::optional<std::int64_t> waits_since = {};  // for a group shot, whichever it asks for
        Answer answer;
    };
    struct Waiting {
        ObserverRequest request;
        Answer answer;
    };
    struct Decision {
        RequestState state = RequestState::accepted;
        std::uint32_t camera_id = 0;
        std::string reason;
        Counter refusal = Counter::refused_invalid;  // of what is refused
        bool waits = false;                          // for its group shot to begin
    };

    // They return what put() returns.
    bool keep(const ObserverRequest& request, const config::Config& config);
    bool wait(const ObserverRequest& request, const config::Config& config, std::uint64_t epoch);
    bool turn_away(const ObserverRequest& request, const config::Config& config, std::uint64_t epoch);
    void refuse_waiting(const RequestContext& context);
    static void resolve(Observer& observer, const config::Config& config);
    [[nodiscard]] static Decision decide(const Observer& observer, const RequestContext& context);
    void pace_group_shots(std::span<Decision> decisions, std::int64_t now);
    [[nodiscard]] std::int64_t next_group_shot(std::int64_t now) const;
    [[nodiscard]] bool must_wait(const Observer& observer, const Decision& decision, std::int64_t max_shots);
    void wait_for_group_shot(const Observer& observer, Decision& decision, std::int64_t now);
    void assign(Observer& observer, const RequestContext& context, Decision& decision);
    // That of an accepted request, or until it may begin the one before; null where there is none.
    Shot* find_shot(const Observer& observer, const Decision& decision);
    Shot* find_shot(const ShotKey& key);
    Shot& add_shot(const ShotKey& key);
    // `refusal`: what a refusal counts as.
    void publish(Answer& answer, ObserverStatus status, Counter refusal, std::int64_t now);
    void count_refusal(const ObserverStatus& status, Counter refusal);

    const std::string match_id_;
    Publisher& publisher_;
    MatchCounters& counters_;
    LogLimit refusals_;
    std::map<std::string, Observer> observers_;
    std::list<Waiting> waiting_;                   // for a place, in the order of arrival
    std::unordered_set<std::string> turned_away_;  // observers who cannot even wait
    std::vector<Shot> shots_;
    std::int64_t group_shots_paid_ns_ = std::numeric_limits<std::int64_t>::min();  // see pace_group_shots()
    std::int64_t next_answers_ = never;
};

}  // namespace camdir::director
