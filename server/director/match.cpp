#include "director/match.hpp"

#include <spdlog/fmt/chrono.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <ctime>
#include <utility>
#include <variant>

#include "director/clock.hpp"

namespace camdir::director {
namespace {

constexpr double default_rate_hz = 30.0;  // of game servers that state none

std::time_t utc_second_after(std::int64_t ns) {
    const auto then = std::chrono::system_clock::now() + std::chrono::nanoseconds(ns);
    return std::chrono::system_clock::to_time_t(std::chrono::ceil<std::chrono::seconds>(then));
}

// As stated, as far as that is one and may be.
double pose_rate_hz(const MatchInfo& info, const config::Config& config) {
    const double stated = std::isfinite(info.rate_hz) && info.rate_hz > 0.0F ? info.rate_hz : default_rate_hz;
    return std::min(stated, static_cast<double>(config.limits.pose_rate_hz));
}

}  // namespace

std::int64_t silence_limit_ns(const MatchInfo& info, const config::Config& config) {
    const double rate = pose_rate_hz(info, config);
    const auto frames = static_cast<double>(config.matches.silence_frames);
    return static_cast<std::int64_t>(std::min(frames / rate, 86400.0) * 1e9);
}

Match::Match(std::string match_id, std::shared_ptr<const config::Config> config, const MapLibrary& maps,
             const Pace& pace, Publisher& publisher, const Audiences& audiences)
    : match_id_(std::move(match_id)),
      pace_(pace),
      publisher_(publisher),
      audiences_(audiences),
      arrivals_(config->limits.pose_rate_hz),
      inbox_(pace, counters_),
      delay_(static_cast<std::size_t>(config->limits.delay_mib) << 20U),
      config_(std::move(config)),
      map_(match_id_, maps, counters_),
      requests_(match_id_, publisher, counters_) {
    delay_.set_minimum(config_->matches.minimum_delay_s, now_ns());
}

// Only running out of memory throws in here, and that ends the process.
void Match::turn(Turn& turn) noexcept {  // NOLINT(bugprone-exception-escape)
    if (long_turns_.is_suspect()) turn.measure_processor();
    const bool is_long = long_turns_.is_long();
    const bool may_move = !is_long || turn.begin_long();
    inbox_.take(content_, may_move);
    const bool is_long_of_frame = is_long && content_.has_frame;
    if (is_long_of_frame) inbox_.rest_until(Requests::never);
    const std::span messages(content_.messages);
    if (content_.has_frame) {
        handle_all(messages.first(content_.messages_before_frame));
        process(content_.frame, content_.received_ns, turn);
        handle_all(messages.subspan(content_.messages_before_frame));
    } else {
        handle_all(messages);
    }
    if (content_.leaves_more) turn.again();
    follow_leader();
    const bool prepared = !is_long && prepare(turn);
    if (content_.has_frame)
        long_turns_.moved(turn.cost());
    else if (prepared)
        long_turns_.prepared(turn.cost());
    if (is_long_of_frame) rest();
    // A lookout that is asked for the first time takes milliseconds.
    if (std::ranges::any_of(requests_.shots(), &Shot::is_of_group)) expect_long_turns();
}

void Match::follow_leader() {
    if (content_.has_shown) follower_.hear(content_.shown);
    if (map_.freespace() != nullptr)
        follower_.follow({requests_.shots(), space(), config_->direction.grammar.fixed_shots});
}

void Match::handle_all(std::span<Message> messages) {
    for (Message& message : messages)
        std::visit([this](auto& content) { handle(content); }, message);
    if (reconcile_needed_ || answers_due(now_ns())) reconcile();
}

void Match::handle(MatchInfo& info) {
    counters_.add(Counter::match_infos);
    if (info_ && info.epoch < info_->epoch) return counters_.add(Counter::drop_old_epoch);
    const bool new_epoch = !info_ || info.epoch != info_->epoch || info.map_name != info_->map_name;
    info_ = std::move(info);
    if (new_epoch) begin_epoch();
    if (liveness_ == Liveness::lost) liveness_ = Liveness::silent;
    roster_.set_listed(info_->players);
    edit_.set_players(info_->players);
    bind_map();
    publish_info();
}

float Match::camera_rate_hz() const {
    return static_cast<float>(pose_rate_hz(*info_, *config_) / static_cast<double>(frames_per_camera_));
}

// Of the frames that are let in, some are left out at a slower pace.
void Match::limit_silence() {
    silence_limit_ns_ = silence_limit_ns(*info_, *config_) * frames_per_camera_;
}

// After a turn whose cameras took long.
void Match::rest() {
    const std::int64_t worked = long_turns_.worked();
    inbox_.rest_until(now_ns() + worked);
    if (worked > 0 && long_turns_logged_.due())
        spdlog::warn(
            "match {}: its turns take {} ms a pose frame: its {} cameras move half of the time, for other "
            "matches to have theirs",
            match_id_, worked / 1'000'000, requests_.shots().size());
}

// Of so many pose frames one moves the cameras. What long turns take varies: by powers of two.
std::uint32_t Match::wanted_frames_per_camera() const {
    const double interval_s = 2e-9 * static_cast<double>(long_turns_.worked());
    const double frames = std::min(interval_s * pose_rate_hz(*info_, *config_), 1e6);
    const auto own = std::bit_ceil(static_cast<std::uint32_t>(std::ceil(std::max(frames, 1.0))));
    return std::max(pace_.frames_per_camera(), own);
}

// The map's where the game server does not know it.
float Match::metres_per_unit() const {
    const float sent = info_->metres_per_unit;
    return sent == 0.0F && map_.freespace() != nullptr ? map_.freespace()->metadata().metres_per_unit : sent;
}

// With the rate of its cameras.
void Match::publish_info() {
    frames_per_camera_ = wanted_frames_per_camera();
    limit_silence();
    MatchInfo shown = *info_;
    shown.rate_hz = camera_rate_hz();
    shown.metres_per_unit = metres_per_unit();
    publisher_.publish(shown);
    for (Audience* audience : audiences_)
        audience->show(shown);
}

void Match::begin_epoch() {
    spdlog::info("match {}: epoch {} on map {}, {} Hz", match_id_, info_->epoch, info_->map_name,
                 info_->rate_hz);
    roster_.clear();
    continuity_.clear();
    edit_.clear();
    last_event_.reset();
    timeline_.clear();
    obstacles_.clear();
    foreseen_ = 0;
    requests_.restart_shots();
    has_last_frame_ = false;
    after_silence_ = false;
    next_camera_frame_ = 0;
    last_pose_ns_ = now_ns();
    liveness_ = Liveness::running;
}

void Match::handle(const ServerLost& /*lost*/) {
    fall_silent(Liveness::lost);
}

void Match::handle(const PosesMissing& /*missing*/) {
    if (poses_missing(now_ns())) fall_silent(Liveness::silent);
}

void Match::fall_silent(Liveness liveness) {
    if (!info_ || liveness_ == liveness) return;
    if (liveness_ == Liveness::running) {
        counters_.add(Counter::silences);
        spdlog::warn("match {}: its game server is silent", match_id_);
    }
    liveness_ = liveness;
    has_last_frame_ = false;
    after_silence_ = true;
    reconcile_needed_ = true;
}

void Match::handle(const MatchEnded& /*ended*/) {
    if (info_) {
        spdlog::info("match {}: ended", match_id_);
        publisher_.end(match_id_);
        for (Audience* audience : audiences_)
            audience->end(match_id_);
    }
    info_.reset();
    last_event_.reset();
    refusal_.clear();
    liveness_ = Liveness::none;
    roster_.clear();
    map_.release();
    change_map();
    reconcile_needed_ = true;
}

void Match::handle(const MatchRefused& refused) {
    refusal_ = refused.reason;
    reconcile_needed_ = true;
}

void Match::handle(const MatchEvent& event) {
    if (!info_) return counters_.add(Counter::drop_unknown_match);
    if (event.epoch != info_->epoch)
        return counters_.add(event.epoch < info_->epoch ? Counter::drop_old_epoch
                                                        : Counter::drop_early_epoch);
    counters_.add(Counter::events);
    edit_.record(event);
    last_event_ = event;
    for (Audience* audience : audiences_)
        audience->show(match_id_, event);
}

void Match::handle(const ObserverRequest& request) {
    reconcile_needed_ = true;
    if (!requests_.put(request, *config_, epoch())) return;
    counters_.add(Counter::requests);
    for (Audience* audience : audiences_)
        audience->request(request);
}

void Match::handle(const RequestEnded& ended) {
    requests_.remove(ended.observer_id, *config_);
    for (Audience* audience : audiences_)
        audience->request_ended(match_id_, ended.observer_id);
    reconcile_needed_ = true;
}

void Match::handle(const MapsChanged& /*changed*/) {
    if (!info_) return;
    const float before = metres_per_unit();
    bind_map();
    if (metres_per_unit() != before) publish_info();
}

void Match::handle(const DelayChanged& /*changed*/) {
    const DelayBuffer::State delay = delay_.state();
    if (delay.refusal.empty()) {
        spdlog::info("match {}: shown with a delay of {:.4g} s", match_id_, delay.delay_s);
    } else {
        counters_.add(Counter::refused_matches_delay);
        spdlog::warn("match {}: refused: {}", match_id_, delay.refusal);
    }
    last_pose_ns_ = std::max(last_pose_ns_.load(), delay.resumes_at);  // until then there are none
    reconcile_needed_ = true;
}

void Match::handle(const Reconfigured& changed) {
    config_ = changed.config;
    edit_.forget_moments();
    if (info_) limit_silence();
    requests_.resolve_again(*config_);
    reconcile_needed_ = true;
}

void Match::bind_map() {
    reconcile_needed_ = true;
    const bool changed = map_.bind(*info_);
    const std::string refused_before = std::exchange(refusal_, map_.refusal());
    if (!refusal_.empty() && refusal_ != refused_before) counters_.add(Counter::refused_matches_map);
    if (changed) change_map();
}

void Match::change_map() {
    edit_.clear();
    obstacles_.set_map(map_.freespace());
    map_.report_unknown_movers(obstacles_.unknown());
    scratch_.clear();
    requests_.restart_shots();
}

void Match::reconcile() {
    reconcile_needed_ = false;
    const bool holds = liveness_ == Liveness::silent || liveness_ == Liveness::lost;
    const DelayBuffer::State delay = delay_.state();
    const std::string waiting = waiting_for_delay(delay);
    waits_for_delay_ = !waiting.empty();
    requests_.reconcile({*config_, roster_, epoch(), refusal_.empty() ? delay.refusal : refusal_,
                         waits_for_delay_ ? waiting : map_.missing(),
                         holds ? "the game server is silent: the camera holds" : "", now_ns()});
    next_answers_ns_ = requests_.next_answers();
    observer_count_ = requests_.observers();
    shot_count_ = requests_.shots().size();
    abandoned_.store(!info_ && requests_.observers() == 0, std::memory_order_release);
}

// Of what is published. Observers take no answer of a later epoch than that of the match that they are shown.
std::uint64_t Match::epoch() const {
    return info_ ? info_->epoch : delay_.state().epoch;
}

// When the cameras begin, or go on after the delay has grown; empty when the delay is over.
std::string Match::waiting_for_delay(const DelayBuffer::State& delay) const {
    const std::int64_t now = now_ns();
    std::int64_t until = delay.resumes_at;
    if (!info_ && delay.next_due != DelayBuffer::never) until = std::max(until, delay.next_due);
    if (!delay.refusal.empty() || until <= now) return {};
    return fmt::format("shown with a delay of {:.4g} s: the cameras begin at {:%Y-%m-%d %H:%M:%S} UTC",
                       delay.delay_s, fmt::gmtime(utc_second_after(until - now)));
}

bool Match::poses_missing(std::int64_t now_ns) const {
    return liveness_ == Liveness::running && now_ns - last_pose_ns_ > silence_limit_ns_;
}

bool Match::server_lost_for(std::int64_t ns, std::int64_t now_ns) const {
    return liveness_ == Liveness::lost && now_ns - last_pose_ns_ > ns && !delay_.waits();
}

void Match::add_gauges(Statistics& sum) const {
    const Liveness liveness = liveness_;
    sum.matches += liveness == Liveness::none ? 0 : 1;
    sum.silent_matches += liveness == Liveness::silent || liveness == Liveness::lost ? 1 : 0;
    sum.observers += observer_count_;
    sum.shots += shot_count_;
    sum.delayed_bytes += delay_.state().bytes;
}

std::string Match::state() const {
    switch (liveness_.load()) {
        case Liveness::none:
            return waits_for_delay_ ? "filling the delay" : "no game server";
        case Liveness::lost:
            return "game server lost";
        case Liveness::silent:
            return "silent";
        case Liveness::running:
            break;
    }
    return map_.missing().empty() ? "running" : "waiting for map";
}

void Match::handle(const ViewRequest& wanted) {
    if (reconcile_needed_) reconcile();
    MatchView view;
    view.match_id = match_id_;
    view.answered = true;
    view.state = state();
    view.delay_s = delay_.state().delay_s;
    if (info_) {
        view.epoch = info_->epoch;
        view.map_name = info_->map_name;
        view.rate_hz = info_->rate_hz;
        view.camera_rate_hz = camera_rate_hz();
        view.players = info_->players;
        view.last_event = last_event_;
    }
    view.last_pose_number = last_number_;
    view.movers = obstacles_.count();
    view.unknown_movers = obstacles_.unknown();
    view.shots = requests_.shot_views();
    view.observers = requests_.observer_views();
    wanted.answer->set_value(std::move(view));
}

}  // namespace camdir::director
