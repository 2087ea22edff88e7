#include "game_match.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <vector>

#include "borrow.hpp"
#include "checks.hpp"
#include "fixed_string.hpp"
#include "mover_columns.hpp"

namespace camdir::sdk {

namespace {

std::int64_t realtime_ns() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

// By the system clock, so that it is greater than those of earlier processes; also greater than `previous`
// and all earlier ones of this process, should the clock be set back. In microseconds, so that a double can
// hold it.
std::uint64_t choose_epoch(std::uint64_t previous) {
    static std::mutex mutex;
    static std::uint64_t last = 0;
    const std::lock_guard lock(mutex);
    last = std::max(static_cast<std::uint64_t>(realtime_ns() / 1000), last + 1);
    return std::max(last, previous + 1);
}

// The four parallel arrays of MatchInfo.
struct PlayerColumns {
    explicit PlayerColumns(std::span<const cdir_player> players)
        : names(players.size()), classes(players.size()) {
        for (std::size_t i = 0; i < players.size(); ++i) {
            ids.push_back(players[i].id);
            teams.push_back(players[i].team);
            copy_string(names[i].text, players[i].name);
            copy_string(classes[i].text, players[i].player_class);
        }
    }

    struct Name {
        char text[sizeof cdir_player::name];
    };
    struct Class {
        char text[sizeof cdir_player::player_class];
    };
    std::vector<std::uint32_t> ids;
    std::vector<std::uint8_t> teams;
    std::vector<Name> names;
    std::vector<Class> classes;
};

}  // namespace

GameMatch::GameMatch(std::shared_ptr<const Context> context, const cdir_match_info& info,
                     std::span<const cdir_player> players)
    : context_(std::move(context)), match_id_(checked_match_id(info.match_id)), info_(info) {
    check(info, players);
    if (info_.epoch == 0) info_.epoch = choose_epoch(0);
    publisher_ = make_publisher(context_->participant(), match_id_);
    info_writer_ = context_->topics().make_writer(publisher_.get(), Topic::match_info);
    pose_writer_ = context_->topics().make_writer(publisher_.get(), Topic::pose_frame);
    event_writer_ = context_->topics().make_writer(publisher_.get(), Topic::match_event);
    announce(info_, players);
}

GameMatch::~GameMatch() {
    camera_director_MatchInfo key{};
    copy_string(key.match_id, match_id_.c_str());
    (void)dds_dispose(info_writer_.get(), &key);
}

void GameMatch::update(const cdir_match_info& info, std::span<const cdir_player> players) {
    check(info, players);
    const std::lock_guard lock(mutex_);
    const bool same = match_id_ == checked_match_id(info.match_id) &&
                      std::strcmp(info_.map_name, info.map_name) == 0 && info_.map_hash == info.map_hash &&
                      info_.metres_per_unit == info.metres_per_unit;
    if (!same) throw Failure{CDIR_CONFLICT, "match_id, map or metres_per_unit changed: restart the match"};
    cdir_match_info updated = info;
    updated.epoch = info_.epoch;
    announce(updated, players);
    info_ = updated;
}

void GameMatch::restart(const cdir_match_info& info, std::span<const cdir_player> players) {
    check(info, players);
    const std::lock_guard lock(mutex_);
    if (match_id_ != checked_match_id(info.match_id)) {
        throw Failure{CDIR_CONFLICT, "match_id changed: close the match and open another"};
    }
    if (info.epoch != 0 && info.epoch <= info_.epoch) {
        throw Failure{CDIR_CONFLICT, "the epoch must be greater than " + std::to_string(info_.epoch)};
    }
    cdir_match_info restarted = info;
    if (restarted.epoch == 0) restarted.epoch = choose_epoch(info_.epoch);
    announce(restarted, players);
    info_ = restarted;
    next_frame_number_ = 0;
    last_frame_time_.reset();
    discontinuities_.clear();
    movers_ = {};
    last_mover_time_.reset();
}

void GameMatch::announce(cdir_match_info& info, std::span<const cdir_player> players) {
    const PlayerColumns columns(players);
    camera_director_MatchInfo sample{};
    copy_string(sample.match_id, match_id_.c_str());
    sample.epoch = info.epoch;
    sample.map_name = info.map_name;
    sample.map_hash = info.map_hash;
    sample.metres_per_unit = info.metres_per_unit;
    sample.rate_hz = info.rate_hz;
    sample.spectator_delay_s = info.spectator_delay_s;
    borrow(sample.player_id, columns.ids.data(), columns.ids.size());
    borrow(sample.player_team, columns.teams.data(), columns.teams.size());
    // An array of structs of one char array is an array of those char arrays.
    borrow(sample.player_name, reinterpret_cast<const char(*)[64]>(columns.names.data()), players.size());
    borrow(sample.player_class, reinterpret_cast<const char(*)[32]>(columns.classes.data()), players.size());
    check_written("MatchInfo", dds_write(info_writer_.get(), &sample));
}

std::uint64_t GameMatch::epoch() const {
    const std::lock_guard lock(mutex_);
    return info_.epoch;
}

std::uint32_t GameMatch::count_discontinuities(std::uint32_t player, std::uint32_t flags) {
    std::uint32_t& count = discontinuities_[player];
    if ((flags & CDIR_POSE_DISCONTINUITY) != 0) ++count;
    return count;
}

void GameMatch::publish(const cdir_pose_frame& frame) {
    check_frame_time(frame.frame_time);
    const std::lock_guard lock(mutex_);
    poses_.gather(frame);
    require(!last_frame_time_ || frame.frame_time >= *last_frame_time_,
            "frame_time went back within the epoch: restart the match");
    const std::size_t n = poses_.count();
    std::array<std::uint32_t, CDIR_MAX_PLAYERS> discontinuities;
    for (std::size_t i = 0; i < n; ++i)
        discontinuities[i] = count_discontinuities(poses_.player_id()[i], poses_.flags()[i]);
    camera_director_PoseFrame sample{};
    copy_string(sample.match_id, match_id_.c_str());
    sample.epoch = info_.epoch;
    sample.frame_number = next_frame_number_;
    sample.frame_time = frame.frame_time;
    sample.source_time = frame.source_time != 0 ? frame.source_time : realtime_ns();
    borrow(sample.player_id, poses_.player_id(), n);
    borrow(sample.eye, poses_.eye(), 3 * n);
    borrow(sample.orientation, poses_.orientation(), 4 * n);
    borrow(sample.velocity, poses_.velocity(), poses_.has_velocity() ? 3 * n : 0);
    borrow(sample.flags, poses_.flags(), n);
    borrow(sample.discontinuities, discontinuities.data(), n);
    check_written("PoseFrame", dds_write(pose_writer_.get(), &sample));
    ++next_frame_number_;
    last_frame_time_ = frame.frame_time;
}

void GameMatch::publish(const cdir_match_event& event) {
    check(event);
    const std::lock_guard lock(mutex_);
    camera_director_MatchEvent sample{};
    copy_string(sample.match_id, match_id_.c_str());
    sample.epoch = info_.epoch;
    sample.frame_time = event.frame_time;
    sample.kind = event.kind;
    sample.actor = event.actor;
    sample.subject = event.subject;
    sample.value = event.value;
    copy_string(sample.detail, event.detail);
    check_written("MatchEvent", dds_write(event_writer_.get(), &sample));
}

void GameMatch::set_movers(std::span<const cdir_mover> movers) {
    const MoverColumns columns(movers);
    camera_director_MoverInfo sample = columns.sample();
    copy_string(sample.match_id, match_id_.c_str());
    const std::lock_guard lock(mutex_);
    sample.epoch = info_.epoch;
    write(mover_info_writer_, Topic::mover_info, &sample);
    movers_.set_known(columns.ids());
}

void GameMatch::publish(const cdir_mover_frame& frame) {
    check_frame_time(frame.frame_time);
    const std::lock_guard lock(mutex_);
    require(!last_mover_time_ || frame.frame_time >= *last_mover_time_,
            "frame_time went back within the epoch: restart the match");
    movers_.move(frame);
    last_mover_time_ = frame.frame_time;
    if (!movers_.have_moved()) return;
    camera_director_MoverFrame sample = movers_.sample();
    copy_string(sample.match_id, match_id_.c_str());
    sample.epoch = info_.epoch;
    sample.frame_time = frame.frame_time;
    sample.source_time = frame.source_time != 0 ? frame.source_time : realtime_ns();
    write(mover_frame_writer_, Topic::mover_frame, &sample);
    movers_.forget_moves();
}

void GameMatch::write(Entity& writer, Topic topic, const void* sample) {
    if (writer.get() == 0) writer = context_->topics().make_writer(publisher_.get(), topic);
    check_written(wire::topic_name(topic), dds_write(writer.get(), sample));
}

std::uint32_t GameMatch::director_count() const {
    dds_publication_matched_status_t matched{};
    check_dds("PoseFrame: cannot count its readers",
              dds_get_publication_matched_status(pose_writer_.get(), &matched));
    return matched.current_count;
}

}  // namespace camdir::sdk
