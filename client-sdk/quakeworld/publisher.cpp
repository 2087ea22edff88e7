#include "publisher.hpp"

#include <vector>

#include "events.hpp"

namespace camdir::qtv {
namespace {

Result<void> result_of(const camera_director::Outcome& outcome) {
    if (!outcome) return fail(outcome.error().what());
    return {};
}

camera_director::MatchInfo info_of(const Match& match, const std::string& match_id) {
    camera_director::MatchInfo info;
    info.match_id = match_id;
    info.map_name = match.map;
    info.rate_hz = match.rate_hz;
    for (const Player& player : match.players)
        info.players.push_back({.id = player.slot, .name = player.name, .team = player.team});
    return info;
}

}  // namespace

Result<void> Publisher::announce(const Match& match) {
    const camera_director::MatchInfo info = info_of(match, match_id_);
    if (match_ && match.level == level_) return result_of(match_->update(info));
    if (match_) {
        if (auto restarted = result_of(match_->restart(info)); !restarted) return restarted;
    } else {
        auto opened = camera_director::Match::open(context_, info);
        if (!opened) return fail(opened.error().what());
        match_ = std::move(*opened);
    }
    level_ = match.level;
    round_ = 0;
    alive_.reset();
    return {};
}

Result<void> Publisher::publish(const quakeworld::TrackedFrame& frame) {
    if (auto published = publish_poses(frame); !published) return published;
    publish_spawns(frame);
    for (const quakeworld::Occurrence& occurrence : frame.occurrences) {
        if (occurrence.kind == quakeworld::Occurrence::Kind::match_begin) ++round_;
        publish_event(event_of(occurrence, round_));
    }
    return {};
}

Result<void> Publisher::publish_poses(const quakeworld::TrackedFrame& frame) {
    std::vector<std::uint32_t> ids;
    std::vector<std::uint32_t> flags;
    std::vector<float> eyes;
    std::vector<float> orientations;
    std::vector<float> velocities;
    const auto add = [](std::vector<float>& to, const auto& vector) {
        for (const double value : vector)
            to.push_back(static_cast<float>(value));
    };
    for (const quakeworld::TrackedPose& pose : frame.poses) {
        ids.push_back(pose.slot);
        std::uint32_t flag = 0;
        if (pose.alive) flag |= CDIR_POSE_ALIVE;
        if (pose.discontinuity) flag |= CDIR_POSE_DISCONTINUITY;
        flags.push_back(flag);
        add(eyes, pose.eye);
        add(orientations, pose.orientation.coeffs());
        add(velocities, pose.velocity);
    }
    return result_of(match_->publish({.frame_time = frame.time * ns_of_a_ms,
                                      .player_id = ids,
                                      .eye = eyes,
                                      .orientation = orientations,
                                      .velocity = velocities,
                                      .flags = flags}));
}

void Publisher::publish_spawns(const quakeworld::TrackedFrame& frame) {
    std::bitset<quakeworld::max_slots> alive;
    for (const quakeworld::TrackedPose& pose : frame.poses) {
        alive[pose.slot] = pose.alive;
        if (pose.alive && !alive_[pose.slot])
            publish_event(
                {.kind = CDIR_EVENT_SPAWN, .frame_time = frame.time * ns_of_a_ms, .actor = pose.slot});
    }
    alive_ = alive;
}

// An event that cannot be sent is lost: the next ones matter more.
void Publisher::publish_event(const camera_director::MatchEvent& event) {
    if (!match_->publish(event)) ++lost_events_;
}

std::uint32_t Publisher::directors() const {
    if (!match_) return 0;
    const auto count = match_->director_count();
    return count ? *count : 0;
}

}  // namespace camdir::qtv
