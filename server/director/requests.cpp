#include "director/requests.hpp"

#include <spdlog/spdlog.h>
#include <xxhash.h>

#include <algorithm>
#include <utility>

#include "base/utf8.hpp"
#include "config/json_text.hpp"
#include "freespace/fixed_shots.hpp"

namespace camdir::director {
namespace {

constexpr std::size_t max_reason_bytes = 255;  // ObserverStatus.reason
// Each is sent with all answers of its bucket, to every observer.
constexpr std::int64_t repeat_interval_ns = 1'000'000'000;
constexpr std::int64_t group_shot_interval_ns = 200'000'000;
constexpr std::int64_t group_shots_at_once = 8;

std::string shortened(std::string text) {
    text.resize(utf8_prefix(text, max_reason_bytes));
    return text;
}

std::string quoted(const std::string& text) {
    return "'" + text + "'";
}

std::string too_many_observers(const config::Config& config) {
    return std::to_string(config.limits.observers) + " observers watch this match already";
}

std::string known_profiles(const config::Config& config) {
    std::string list;
    for (const auto& [name, profile] : config.profiles)
        list += (list.empty() ? "" : ", ") + name;
    return list;
}

// Equal strings for equal JSON objects; empty for an object without keys.
std::string canonical(const std::string& overrides) {
    const auto object = config::parse_json(overrides);
    return !object || object->empty() ? std::string() : object->dump();
}

std::vector<std::uint32_t> sorted(std::vector<std::uint32_t> group) {
    std::sort(group.begin(), group.end());
    group.erase(std::unique(group.begin(), group.end()), group.end());
    return group;
}

// In their order: those who matter more come first.
std::vector<std::uint32_t> without_repetitions(std::span<const std::uint32_t> group) {
    std::vector<std::uint32_t> distinct;
    for (const std::uint32_t player : group)
        if (std::ranges::find(distinct, player) == distinct.end()) distinct.push_back(player);
    return distinct;
}

// What is wrong with the group of a group shot; empty when nothing is.
std::string group_error(const ShotKey& key) {
    for (const std::uint32_t player : key.group)
        if (player == no_player || player == whole_group)
            return "no player has the id " + std::to_string(player);
    if (key.target != whole_group || (key.group.size() >= 2 && key.group.size() <= camera::max_members))
        return {};
    return "a group shot shows 2 to " + std::to_string(camera::max_members) + " players, not " +
           std::to_string(key.group.size());
}

// Why no player of the key can be shown now; empty when one can.
std::string missing_player(const ShotKey& key, const Roster& roster) {
    if (key.target != no_player && key.target != whole_group) {
        const Presence presence = roster.presence(key.target);
        if (presence == Presence::playing) return {};
        return "player " + std::to_string(key.target) +
               (presence == Presence::spectator ? " is a spectator" : " is not in the match");
    }
    if (key.group.empty()) {
        if (roster.anyone_playing(key.team)) return {};
        return key.team == 0 ? "nobody plays" : "nobody of team " + std::to_string(key.team) + " plays";
    }
    const bool plays = std::any_of(key.group.begin(), key.group.end(), [&](std::uint32_t player) {
        return roster.presence(player) == Presence::playing && roster.is_of(player, key.team);
    });
    if (plays) return {};
    return key.team == 0 ? "nobody of the group plays"
                         : "nobody of the group plays in team " + std::to_string(key.team);
}

// The same in every director that is asked for this shot, so that a standby's cameras have the ids that
// observers know. Never 0.
std::uint32_t camera_id_of(const ShotKey& key) {
    std::string bytes;
    const auto append = [&](std::uint32_t number) {
        for (int shift = 0; shift < 32; shift += 8)
            bytes += static_cast<char>(number >> shift & 0xffU);
    };
    append(key.target);
    append(static_cast<std::uint32_t>(key.group.size()));
    for (const std::uint32_t player : key.group)
        append(player);
    bytes += key.profile + '\0' + key.overrides;
    if (key.team != 0) append(key.team);
    const auto id = static_cast<std::uint32_t>(XXH3_64bits(bytes.data(), bytes.size()));
    return id == 0 ? 1 : id;
}

}  // namespace

ShotCamera still_camera(std::uint32_t camera_id, const freespace::FixedShot& shot) {
    ShotCamera camera;
    camera.camera_id = camera_id;
    camera.position = shot.position;
    camera.orientation = camera::orientation_of({shot.yaw, shot.pitch});
    camera.vertical_fov = freespace::fixed_shot_fov;
    return camera;
}

bool Requests::put(const ObserverRequest& request, const config::Config& config, std::uint64_t epoch) {
    const bool has_place = observers_.contains(request.observer_id) ||
                           observers_.size() < static_cast<std::size_t>(config.limits.observers);
    return has_place ? keep(request, config) : wait(request, config, epoch);
}

bool Requests::keep(const ObserverRequest& request, const config::Config& config) {
    Observer& observer = observers_[request.observer_id];
    observer.answer.published = false;  // or it has been lost
    turned_away_.erase(request.observer_id);
    if (observer.request == request) return false;
    observer.request = request;
    resolve(observer, config);
    return true;
}

bool Requests::wait(const ObserverRequest& request, const config::Config& config, std::uint64_t epoch) {
    const auto most = static_cast<std::size_t>(config.limits.observers);
    const auto known = std::ranges::find_if(
        waiting_, [&](const Waiting& waiting) { return waiting.request.observer_id == request.observer_id; });
    if (known != waiting_.end()) {
        known->answer.published = false;
        if (known->request == request) return false;
        known->request = request;
    } else if (waiting_.size() < most) {
        waiting_.push_back({request, {}});
        turned_away_.erase(request.observer_id);
    } else {
        return turn_away(request, config, epoch);
    }
    return true;
}

bool Requests::turn_away(const ObserverRequest& request, const config::Config& config, std::uint64_t epoch) {
    const ObserverStatus refusal{match_id_, request.observer_id,
                                 epoch,     RequestState::refused,
                                 0,         too_many_observers(config) + ", and as many wait"};
    publisher_.publish(refusal);  // an observer whom it does not reach asks again
    const bool is_new = turned_away_.insert(request.observer_id).second;
    if (is_new) count_refusal(refusal, Counter::refused_observers);
    return is_new;
}

void Requests::remove(const std::string& observer_id, const config::Config& config) {
    std::erase_if(waiting_,
                  [&](const Waiting& waiting) { return waiting.request.observer_id == observer_id; });
    turned_away_.erase(observer_id);
    const bool leaves_place = observers_.erase(observer_id) > 0;
    publisher_.withdraw(match_id_, observer_id);
    if (!leaves_place || waiting_.empty()) return;
    keep(waiting_.front().request, config);
    waiting_.pop_front();
}

void Requests::resolve_again(const config::Config& config) {
    for (auto& [id, observer] : observers_)
        resolve(observer, config);
    for (Shot& shot : shots_)
        shot.is_prepared = false;  // its profile may change
}

void Requests::resolve(Observer& observer, const config::Config& config) {
    const ObserverRequest& request = observer.request;
    const std::string& name = request.profile.empty() ? config.matches.default_profile : request.profile;
    observer.key = {
        request.target,
        request.target == whole_group ? without_repetitions(request.group) : sorted(request.group), name,
        canonical(request.overrides), request.target == no_player ? request.team : std::uint8_t{0}};
    observer.error = group_error(observer.key);
    if (!observer.error.empty()) return;
    const auto base = config.profiles.find(name);
    if (base == config.profiles.end()) {
        observer.error = "there is no profile " + quoted(name) + "; known: " + known_profiles(config);
        return;
    }
    auto profile = config::override_profile(base->second, request.overrides, config.overrides);
    if (!profile)
        observer.error = "overrides: " + profile.error().message;
    else
        observer.profile = *profile;
}

Requests::Decision Requests::decide(const Observer& observer, const RequestContext& context) {
    if (!observer.error.empty()) return {RequestState::refused, 0, observer.error};
    if (!context.refusal.empty()) return {RequestState::refused, 0, context.refusal, Counter::refused_match};
    if (!context.missing_map.empty()) return {RequestState::waiting_for_map, 0, context.missing_map};
    const std::string missing = missing_player(observer.key, context.roster);
    if (!missing.empty()) return {RequestState::waiting_for_player, 0, missing};
    return {RequestState::accepted, 0, context.remark};
}

void Requests::reconcile(const RequestContext& context) {
    next_answers_ = never;
    // Shots without observers end first, so that new ones can take their places.
    std::vector<Decision> decisions;
    for (Shot& shot : shots_)
        shot.observers = 0;
    for (const auto& [id, observer] : observers_)
        decisions.push_back(decide(observer, context));
    pace_group_shots(decisions, context.now);
    auto decision = decisions.begin();
    for (const auto& [id, observer] : observers_)
        if (Shot* shot = find_shot(observer, *decision++)) ++shot->observers;
    std::erase_if(shots_, [](const Shot& shot) { return shot.observers == 0; });

    for (Shot& shot : shots_)
        shot.observers = 0;
    decision = decisions.begin();
    for (auto& [id, observer] : observers_) {
        Decision& one = *decision++;
        if (must_wait(observer, one, context.config.limits.shots))
            wait_for_group_shot(observer, one, context.now);
        else if (one.state == RequestState::accepted)
            assign(observer, context, one);
        if (one.state != RequestState::accepted) observer.shown.reset();
        publish(observer.answer,
                {match_id_, id, context.epoch, one.state, one.camera_id, shortened(std::move(one.reason))},
                one.refusal, context.now);
    }
    refuse_waiting(context);
}

// As many as the match may begin now; who wants the same shot waits or begins together.
void Requests::pace_group_shots(std::span<Decision> decisions, std::int64_t now) {
    std::vector<std::pair<Observer*, Decision*>> beginning;
    auto decision = decisions.begin();
    for (auto& [id, observer] : observers_) {
        Decision& one = *decision++;
        if (one.state != RequestState::accepted || observer.key.target != whole_group ||
            find_shot(observer.key) != nullptr) {
            observer.waits_since.reset();
            continue;
        }
        if (!observer.waits_since) observer.waits_since = now;
        beginning.emplace_back(&observer, &one);
    }
    std::ranges::stable_sort(beginning, {}, [](const auto& one) { return *one.first->waits_since; });
    const std::int64_t may_begin =
        (now + group_shot_interval_ns - next_group_shot(now)) / group_shot_interval_ns;
    std::vector<const ShotKey*> begin;
    for (const auto& [observer, one] : beginning) {
        if (std::ranges::any_of(begin, [&](const ShotKey* key) { return *key == observer->key; })) continue;
        one->waits = static_cast<std::int64_t>(begin.size()) >= may_begin;
        if (!one->waits) begin.push_back(&observer->key);
    }
}

// Each pays for an interval; `group_shots_at_once` of them may be saved up.
std::int64_t Requests::next_group_shot(std::int64_t now) const {
    return std::max(group_shots_paid_ns_, now - group_shots_at_once * group_shot_interval_ns) +
           group_shot_interval_ns;
}

// Where there is no room it is refused at once, unless its shot from before makes room.
bool Requests::must_wait(const Observer& observer, const Decision& decision, std::int64_t max_shots) {
    return decision.waits &&
           (find_shot(observer, decision) != nullptr || shots_.size() < static_cast<std::size_t>(max_shots));
}

void Requests::wait_for_group_shot(const Observer& observer, Decision& decision, std::int64_t now) {
    next_answers_ = std::min(next_answers_, std::max(next_group_shot(now), now));
    if (Shot* shot = find_shot(observer, decision)) {
        ++shot->observers;
        decision.camera_id = shot->camera_id;
    } else {
        decision.camera_id = camera_id_of(observer.key);
        decision.reason = "its group shot begins soon: others of this match begin before it";
    }
}

// Observers take no refusal of an epoch before.
void Requests::refuse_waiting(const RequestContext& context) {
    for (Waiting& waiting : waiting_)
        publish(waiting.answer,
                {match_id_, waiting.request.observer_id, context.epoch, RequestState::refused, 0,
                 too_many_observers(context.config)},
                Counter::refused_observers, context.now);
}

void Requests::assign(Observer& observer, const RequestContext& context, Decision& decision) {
    observer.waits_since.reset();
    Shot* shot = find_shot(observer.key);
    if (shot == nullptr) {
        const std::int64_t max_shots = context.config.limits.shots;
        if (shots_.size() >= static_cast<std::size_t>(max_shots)) {
            decision = {RequestState::refused, 0,
                        "this match has " + std::to_string(max_shots) + " cameras already",
                        Counter::refused_shots};
            return;
        }
        shot = &add_shot(observer.key);
        if (shot->is_of_group()) group_shots_paid_ns_ = next_group_shot(context.now);
    }
    shot->profile = observer.profile;
    ++shot->observers;
    observer.shown = observer.key;
    decision.camera_id = shot->camera_id;
}

Shot* Requests::find_shot(const Observer& observer, const Decision& decision) {
    if (decision.state != RequestState::accepted) return nullptr;
    if (!decision.waits) return find_shot(observer.key);
    return observer.shown ? find_shot(*observer.shown) : nullptr;
}

Shot* Requests::find_shot(const ShotKey& key) {
    const auto found =
        std::find_if(shots_.begin(), shots_.end(), [&](const Shot& shot) { return shot.key == key; });
    return found == shots_.end() ? nullptr : &*found;
}

Shot& Requests::add_shot(const ShotKey& key) {
    std::uint32_t id = camera_id_of(key);
    const auto find_place = [&] {
        return std::lower_bound(shots_.begin(), shots_.end(), id, [](const Shot& shot, std::uint32_t new_id) {
            return shot.camera_id < new_id;
        });
    };
    auto place = find_place();
    while (id == 0 || (place != shots_.end() && place->camera_id == id)) {
        ++id;
        place = find_place();
    }
    Shot shot;
    shot.key = key;
    shot.camera_id = id;
    shot.restart();
    return *shots_.insert(place, std::move(shot));
}

void Requests::publish(Answer& answer, ObserverStatus status, Counter refusal, std::int64_t now) {
    const bool changed = status != answer.status;
    if (changed || (!answer.published && now >= answer.repeats_at)) {
        if (changed && status.state == RequestState::refused) count_refusal(status, refusal);
        answer.status = std::move(status);
        answer.published = publisher_.publish(answer.status);
        answer.repeats_at = now + repeat_interval_ns;
    }
    if (!answer.published) next_answers_ = std::min(next_answers_, answer.repeats_at);
}

void Requests::count_refusal(const ObserverStatus& status, Counter refusal) {
    counters_.add(refusal);
    if (const auto times = refusals_.due())
        spdlog::info("match {}: observer {} is refused: {} ({} since the last such line)", match_id_,
                     status.observer_id, status.reason, *times);
}

void Requests::restart_shots() {
    for (Shot& shot : shots_) {
        shot.restart();
        shot.automatic = {};
        shot.target = no_player;
        shot.fixed = freespace::none;
        shot.flags = 0;
    }
}

std::vector<ShotView> Requests::shot_views() const {
    std::vector<ShotView> views;
    for (const Shot& shot : shots_)
        views.push_back({shot.camera_id, shot.target, shot.is_automatic(), shot.key.profile, shot.observers,
                         shot.flags, shot.automatic.reason, shot.automatic.since,
                         shot.is_of_group() ? shot.key.group : std::vector<std::uint32_t>(), shot.fixed,
                         shot.key.team});
    return views;
}

std::vector<ObserverView> Requests::observer_views() const {
    std::vector<ObserverView> views;
    for (const auto& [id, observer] : observers_)
        views.push_back({id, observer.answer.status.state, observer.answer.status.camera_id,
                         observer.answer.status.reason});
    return views;
}

}  // namespace camdir::director
