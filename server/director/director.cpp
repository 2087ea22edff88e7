#include "director/director.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <condition_variable>
#include <future>
#include <map>
#include <shared_mutex>
#include <unordered_map>
#include <utility>

#include "base/log_limit.hpp"
#include "base/turn_timer.hpp"
#include "director/clock.hpp"
#include "director/match.hpp"

namespace camdir::director {
namespace {

// Also the longest time for which the first message of a delay waits unseen.
constexpr std::int64_t housekeeping_ns = 20'000'000;
constexpr std::int64_t pace_interval_ns = 1'000'000'000;

std::size_t worker_count(const config::Limits& limits) {
    if (limits.workers > 0) return static_cast<std::size_t>(limits.workers);
    return std::max(1U, std::thread::hardware_concurrency());
}

// limits.matches with a game server, and as many where observers wait for one.
std::size_t max_matches(const config::Limits& limits) {
    return 2 * static_cast<std::size_t>(limits.matches);
}

std::string too_many_matches(const config::Limits& limits) {
    return std::to_string(limits.matches) + " matches run already";
}

}  // namespace

struct Director::Impl {
    struct Entry {
        std::unique_ptr<Match> match;
        bool has_server = false;
        MatchInfo info;           // the newest, while there is a game server
        std::uint64_t place = 0;  // among the matches that have begun
    };

    Impl(const config::Config& configuration, const MapLibrary& library, Publisher& results,
         Audiences spectators);

    // With the mutex held, shared or exclusively.
    Match* find(const std::string& match_id) const;
    void post(Match& match, Message message);
    // Of the game server: through the match's delay.
    void deliver(Match& match, Message message);
    void deliver(const std::string& match_id, Match& match, PoseFrame& frame, BriefTurns& turns);
    void leave_out(const std::string& match_id, Match& match);
    // Whether it passes the delay at once; `counts` where it is refused.
    bool passes(Match& match, DelayBuffer::Admission admission, bool counts);
    std::size_t count(bool has_server) const;
    bool has_room() const {
        return count(true) < static_cast<std::size_t>(config->limits.matches) &&
               matches.size() < max_matches(config->limits);
    }

    // With the mutex held exclusively.
    Entry* find_or_add(const std::string& match_id);
    // Null when the match is refused, which is counted, logged and answered.
    Entry* admit(const std::string& match_id);
    void end(Entry& entry);

    // Returns false when there is no such match.
    bool post_to(const std::string& match_id, Message message);
    void run_housekeeping(const std::stop_token& stop);
    void set_pace(std::int64_t now);
    Statistics sum_up() const;
    std::int64_t release_due();
    std::vector<std::string> notify();
    void retire(const std::vector<std::string>& match_ids);
    bool remove_abandoned(const std::string& match_id, Match& match);

    const MapLibrary& maps;
    Publisher& publisher;
    const Audiences audiences;
    Pace pace;
    // At the beginning of the interval: used by the housekeeper only.
    std::int64_t observed_ns = now_ns();
    std::uint64_t taken = 0;
    std::uint64_t superseded = 0;
    std::chrono::nanoseconds busy{0};
    MatchCounters unmatched;  // of messages without a match
    LogLimit refusals, floods;

    // Held exclusively to add and remove matches and to change the configuration, otherwise shared. Guards
    // the members below.
    mutable std::shared_mutex mutex;
    std::shared_ptr<const config::Config> config;
    Statistics removed;  // sum over removed matches
    bool accepting = true;
    std::uint64_t matches_begun = 0;
    WorkerPool pool;
    std::unordered_map<std::string, Entry> matches;

    std::condition_variable_any wake;
    TurnTimer housekeeping;
    std::jthread housekeeper;
};

Director::Impl::Impl(const config::Config& configuration, const MapLibrary& library, Publisher& results,
                     Audiences spectators)
    : maps(library),
      publisher(results),
      audiences(std::move(spectators)),
      config(std::make_shared<const config::Config>(configuration)),
      pool(worker_count(config->limits), max_matches(config->limits)),
      housekeeper([this](const std::stop_token& stop) { run_housekeeping(stop); }) {}

Match* Director::Impl::find(const std::string& match_id) const {
    if (!accepting) return nullptr;
    const auto found = matches.find(match_id);
    return found == matches.end() ? nullptr : found->second.match.get();
}

void Director::Impl::post(Match& match, Message message) {
    match.inbox().put(std::move(message));
    pool.schedule(match);
}

void Director::Impl::deliver(Match& match, Message message) {
    const bool counts = std::holds_alternative<MatchEvent>(message);
    if (passes(match, match.delay().put(message, now_ns()), counts)) post(match, std::move(message));
}

void Director::Impl::deliver(const std::string& match_id, Match& match, PoseFrame& frame, BriefTurns& turns) {
    const auto receipt = match.arrivals().judge(frame, now_ns());
    if (!receipt) return leave_out(match_id, match);
    if (!passes(match, match.delay().put(frame, receipt->punctual), true)) return;
    const auto arrival = receipt->in_burst ? Inbox::Arrival::in_burst : Inbox::Arrival::alone;
    if (match.inbox().put(frame, receipt->received, arrival)) turns.schedule(match);
}

void Director::Impl::leave_out(const std::string& match_id, Match& match) {
    match.counters().add(Counter::drop_rate);
    if (const auto times = floods.due())
        spdlog::warn(
            "match {}: its game server sends more than limits.pose_rate_hz = {} pose frames a second: the "
            "rest is left out ({} since the last such line)",
            match_id, config->limits.pose_rate_hz, *times);
}

bool Director::Impl::passes(Match& match, DelayBuffer::Admission admission, bool counts) {
    if (admission == DelayBuffer::Admission::refused_now) post(match, DelayChanged{});
    if (admission == DelayBuffer::Admission::refused && counts) match.counters().add(Counter::drop_delay);
    return admission == DelayBuffer::Admission::undelayed;
}

bool Director::Impl::post_to(const std::string& match_id, Message message) {
    const std::shared_lock lock(mutex);
    Match* match = find(match_id);
    if (match == nullptr) return false;
    post(*match, std::move(message));
    return true;
}

std::size_t Director::Impl::count(bool has_server) const {
    return static_cast<std::size_t>(std::count_if(matches.begin(), matches.end(), [&](const auto& match) {
        return match.second.has_server == has_server;
    }));
}

Director::Impl::Entry* Director::Impl::find_or_add(const std::string& match_id) {
    if (const auto found = matches.find(match_id); found != matches.end()) return &found->second;
    auto match = std::make_unique<Match>(match_id, config, maps, pace, publisher, audiences);
    if (!pool.attach(*match)) return nullptr;
    Entry& entry = matches[match_id];
    entry.match = std::move(match);
    return &entry;
}

Director::Impl::Entry* Director::Impl::admit(const std::string& match_id) {
    if (!accepting) return nullptr;
    Match* known = find(match_id);
    const bool has_server = known != nullptr && matches[match_id].has_server;
    const bool fits = has_server || count(true) < static_cast<std::size_t>(config->limits.matches);
    if (Entry* entry = fits ? find_or_add(match_id) : nullptr) return entry;
    unmatched.add(Counter::refused_matches);
    const std::string reason = too_many_matches(config->limits);
    if (const auto times = refusals.due())
        spdlog::warn("match {}: refused: {} ({} since the last such line)", match_id, reason, *times);
    if (known != nullptr) post(*known, MatchRefused{reason});
    return nullptr;
}

void Director::Impl::end(Entry& entry) {
    entry.has_server = false;
    deliver(*entry.match, MatchEnded{});
}

void Director::Impl::run_housekeeping(const std::stop_token& stop) {
    std::mutex own;
    std::unique_lock lock(own);
    std::int64_t next_check = now_ns() + housekeeping_ns;
    while (!stop.stop_requested()) {
        housekeeping.begin();
        const std::chrono::nanoseconds until(std::min(release_due(), next_check));
        housekeeping.end();
        wake.wait_until(lock, stop, std::chrono::steady_clock::time_point(until), [] { return false; });
        if (now_ns() < next_check) continue;
        housekeeping.begin();
        next_check = now_ns() + housekeeping_ns;
        const auto leaving = notify();
        if (!leaving.empty()) retire(leaving);
        if (const std::int64_t now = now_ns(); now - observed_ns >= pace_interval_ns) set_pace(now);
    }
    housekeeping.end();
}

void Director::Impl::set_pace(std::int64_t now) {
    const Statistics sum = [this] {
        const std::shared_lock lock(mutex);
        return sum_up();
    }();
    const auto worked = pool.busy();
    const double available = static_cast<double>(now - observed_ns) * static_cast<double>(pool.workers());
    const std::uint32_t before = pace.frames_per_camera();
    pace.observe({sum[Counter::pose_frames] - std::exchange(taken, sum[Counter::pose_frames]),
                  sum[Counter::drop_superseded] - std::exchange(superseded, sum[Counter::drop_superseded]),
                  static_cast<double>((worked - std::exchange(busy, worked)).count()) / available});
    observed_ns = now;
    const std::uint32_t frames = pace.frames_per_camera();
    if (frames > before)
        spdlog::warn("the machine is too slow: cameras move with every {}. pose frame of all matches",
                     frames);
    else if (frames < before)
        spdlog::info("the machine has time to spare: cameras move with every {}pose frame",
                     frames == 1 ? "" : std::to_string(frames) + ". ");
}

// With the mutex held.
Statistics Director::Impl::sum_up() const {
    Statistics sum = removed;
    unmatched.add_to(sum);
    for (const auto& [match_id, entry] : matches) {
        entry.match->counters().add_to(sum);
        entry.match->add_gauges(sum);
    }
    sum.frames_per_camera = pace.frames_per_camera();
    return sum;
}

// Returns when there is more to do, with what waits now.
std::int64_t Director::Impl::release_due() {
    std::int64_t next = DelayBuffer::never;
    const std::shared_lock lock(mutex);
    const std::int64_t now = now_ns();
    for (auto& [match_id, entry] : matches) {
        const DelayBuffer::Released released = entry.match->delay().release(now, entry.match->inbox());
        if (released.any) pool.schedule(*entry.match);
        next = std::min(next, released.next);
    }
    return next;
}

// Notifies matches that are without poses, or have to answer again. Returns those that may have to be
// retired.
std::vector<std::string> Director::Impl::notify() {
    std::vector<std::string> leaving;
    const std::shared_lock lock(mutex);
    const auto forget_ns = static_cast<std::int64_t>(config->matches.forget_s * 1e9);
    const std::int64_t now = now_ns();
    for (auto& [match_id, entry] : matches) {
        if (entry.match->poses_missing(now)) post(*entry.match, PosesMissing{});
        if (entry.match->answers_due(now)) pool.schedule(*entry.match);
        if (entry.match->abandoned() || entry.match->server_lost_for(forget_ns, now))
            leaving.push_back(match_id);
    }
    return leaving;
}

void Director::Impl::retire(const std::vector<std::string>& match_ids) {
    const std::unique_lock lock(mutex);
    const auto forget_ns = static_cast<std::int64_t>(config->matches.forget_s * 1e9);
    for (const std::string& match_id : match_ids) {
        const auto found = matches.find(match_id);
        if (found == matches.end()) continue;
        Entry& entry = found->second;
        if (entry.has_server && entry.match->server_lost_for(forget_ns, now_ns())) {
            end(entry);
            publisher.give_up(match_id);
        }
        if (!entry.has_server && remove_abandoned(match_id, *entry.match)) matches.erase(found);
    }
}

// Returns false when the match is in use again or still has messages to process.
bool Director::Impl::remove_abandoned(const std::string& match_id, Match& match) {
    if (!WorkerPool::idle(match) || !match.abandoned()) return false;
    pool.detach(match);
    match.counters().add_to(removed);
    publisher.forget(match_id);
    return true;
}

Director::Director(const config::Config& config, const MapLibrary& maps, Publisher& publisher,
                   Audiences audiences)
    : impl_(std::make_unique<Impl>(config, maps, publisher, std::move(audiences))) {}

Director::~Director() {
    drain();
}

bool Director::admit(const std::string& match_id) {
    const std::unique_lock lock(impl_->mutex);
    return impl_->admit(match_id) != nullptr;
}

bool Director::has_room() const {
    const std::shared_lock lock(impl_->mutex);
    return impl_->accepting && impl_->has_room();
}

bool Director::receive(const MatchInfo& info) {
    const std::unique_lock lock(impl_->mutex);
    Impl::Entry* entry = impl_->admit(info.match_id);
    if (entry == nullptr) return false;
    if (!entry->has_server || info.epoch >= entry->info.epoch) entry->info = info;
    if (!std::exchange(entry->has_server, true)) entry->place = impl_->matches_begun++;
    Match& match = *entry->match;
    const bool changed = match.delay().announce(info.epoch, info.spectator_delay_s, now_ns());
    impl_->deliver(match, info);
    if (changed) impl_->post(match, DelayChanged{});
    return true;
}

void Director::server_lost(const std::string& match_id) {
    {
        const std::shared_lock lock(impl_->mutex);
        Match* match = impl_->find(match_id);
        if (match == nullptr) return;
        if (match->delay().state().refusal.empty()) return impl_->deliver(*match, ServerLost{});
    }
    match_ended(match_id);  // nothing of it was shown
}

void Director::match_ended(const std::string& match_id) {
    const std::unique_lock lock(impl_->mutex);
    if (impl_->find(match_id) != nullptr) impl_->end(impl_->matches[match_id]);
}

void Director::receive(std::span<PoseArrival> arrivals) {
    BriefTurns turns(impl_->pool);  // run when the lock is released
    const std::shared_lock lock(impl_->mutex);
    for (auto& [match_id, frame] : arrivals) {
        if (Match* match = impl_->find(match_id))
            impl_->deliver(match_id, *match, frame, turns);
        else
            impl_->unmatched.add(Counter::drop_unknown_match);
    }
}

void Director::receive(const std::string& match_id, const MatchEvent& event) {
    const std::shared_lock lock(impl_->mutex);
    Match* match = impl_->find(match_id);
    if (match == nullptr) return impl_->unmatched.add(Counter::drop_unknown_match);
    impl_->deliver(*match, event);
}

void Director::receive(const ObserverRequest& request) {
    if (impl_->post_to(request.match_id, request)) return;
    const std::unique_lock lock(impl_->mutex);
    if (!impl_->accepting) return;
    const config::Limits& limits = impl_->config->limits;
    Impl::Entry* entry = impl_->count(false) < static_cast<std::size_t>(limits.matches)
                             ? impl_->find_or_add(request.match_id)
                             : nullptr;
    if (entry != nullptr) return impl_->post(*entry->match, request);
    impl_->unmatched.add(Counter::refused_no_match);
    impl_->publisher.publish({request.match_id, request.observer_id, 0, RequestState::refused, 0,
                              "no game server runs this match, and observers wait for too many others"});
}

void Director::request_ended(const std::string& match_id, const std::string& observer_id) {
    impl_->post_to(match_id, RequestEnded{observer_id});
}

void Director::follow(const std::string& match_id, const CameraFrame& shown) {
    const std::shared_lock lock(impl_->mutex);
    Match* match = impl_->find(match_id);
    if (match == nullptr) return;
    match->inbox().put(shown);
    impl_->pool.schedule(*match);
}

void Director::maps_changed() {
    const std::shared_lock lock(impl_->mutex);
    if (!impl_->accepting) return;
    for (auto& [match_id, entry] : impl_->matches)
        impl_->post(*entry.match, MapsChanged{});
}

void Director::reconfigure(const config::Config& config) {
    auto next = std::make_shared<config::Config>(config);
    const std::unique_lock lock(impl_->mutex);
    if (!impl_->accepting) return;
    next->limits = impl_->config->limits;  // queues and workers were sized by them at the start
    impl_->config = std::move(next);
    for (auto& [match_id, entry] : impl_->matches) {
        Match& match = *entry.match;
        impl_->post(match, Reconfigured{impl_->config});
        if (!match.delay().set_minimum(config.matches.minimum_delay_s, now_ns())) continue;
        // A refused match has dropped it. It is of an epoch that goes on in all others.
        if (entry.has_server) impl_->deliver(match, entry.info);
        impl_->post(match, DelayChanged{});
    }
}

Statistics Director::statistics() const {
    const std::shared_lock lock(impl_->mutex);
    return impl_->sum_up();
}

std::vector<MatchStatistics> Director::match_statistics(std::size_t max) const {
    const std::shared_lock lock(impl_->mutex);
    std::map<std::uint64_t, const decltype(impl_->matches)::value_type*> first;
    for (const auto& match : impl_->matches) {
        if (!match.second.has_server) continue;
        first.emplace(match.second.place, &match);
        if (first.size() > max) first.erase(std::prev(first.end()));
    }
    std::vector<MatchStatistics> result;
    for (const auto& [place, match] : first) {
        MatchStatistics& one = result.emplace_back();
        one.match_id = match->first;
        match->second.match->counters().add_to(one.statistics);
        match->second.match->add_gauges(one.statistics);
    }
    return result;
}

View Director::view(std::chrono::milliseconds timeout) const {
    std::map<std::string, std::future<MatchView>> answers;
    {
        const std::shared_lock lock(impl_->mutex);
        if (!impl_->accepting) return {};
        for (auto& [match_id, entry] : impl_->matches) {
            const auto answer = std::make_shared<std::promise<MatchView>>();
            answers.emplace(match_id, answer->get_future());
            impl_->post(*entry.match, ViewRequest{answer});
        }
    }
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    View view;
    for (auto& [match_id, answer] : answers) {
        MatchView& match = view.matches.emplace_back();
        match.match_id = match_id;
        if (answer.wait_until(deadline) != std::future_status::ready) continue;
        try {
            match = answer.get();
        } catch (const std::future_error&) {
            continue;  // the match's inbox was full
        }
    }
    return view;
}

std::chrono::nanoseconds Director::silence_limit(const MatchInfo& info) const {
    const std::shared_lock lock(impl_->mutex);
    return std::chrono::nanoseconds(silence_limit_ns(info, *impl_->config));
}

bool Director::responsive(std::chrono::milliseconds limit) const {
    return impl_->pool.responsive(limit) && impl_->housekeeping.within(limit);
}

void Director::flush() {
    const std::shared_lock lock(impl_->mutex);
    for (const auto& [match_id, entry] : impl_->matches)
        WorkerPool::wait_idle(*entry.match);
}

void Director::drain() {
    {
        const std::unique_lock lock(impl_->mutex);
        if (!impl_->accepting) return;
        impl_->accepting = false;
    }
    impl_->housekeeper.request_stop();
    impl_->housekeeper.join();
    flush();
    impl_->pool.stop();
}

}  // namespace camdir::director
