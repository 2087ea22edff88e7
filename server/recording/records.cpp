#include "recording/records.hpp"

#include <algorithm>
#include <set>

namespace camdir::recording {
namespace {

template <class... Functions>
struct Overloaded : Functions... {
    using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

void apply_info(State& state, const director::MatchInfo& info) {
    if (state.info && (state.info->epoch != info.epoch || state.info->map_name != info.map_name)) {
        state.poses.reset();
        state.cameras.reset();
        state.movers.reset();
        state.mover_frame.reset();
    }
    state.info = info;
}

void apply_poses(State& state, const director::PoseFrame& frame) {
    std::map<std::uint32_t, director::PlayerPose> last;
    if (state.poses && state.info) {
        std::set<std::uint32_t> listed;
        for (const director::Player& player : state.info->players)
            listed.insert(player.id);
        for (const director::PlayerPose& pose : state.poses->poses)
            if (listed.contains(pose.player_id)) last[pose.player_id] = pose;
    }
    for (const director::PlayerPose& pose : frame.poses)
        last[pose.player_id] = pose;
    state.poses = frame;
    state.poses->poses.clear();
    state.poses->movers.reset();
    for (const auto& [id, pose] : last)
        state.poses->poses.push_back(pose);
}

bool lists(const std::optional<director::MoverInfo>& movers, std::uint32_t id) {
    return movers && std::ranges::find(movers->movers, id, &director::Mover::id) != movers->movers.end();
}

// Movers that a frame leaves out stay where they are.
void apply_mover_frame(State& state, const director::MoverFrame& frame) {
    std::map<std::uint32_t, director::MoverPose> last;
    if (state.mover_frame && state.mover_frame->epoch == frame.epoch)
        for (const director::MoverPose& pose : state.mover_frame->poses)
            if (lists(state.movers, pose.mover_id)) last[pose.mover_id] = pose;
    for (const director::MoverPose& pose : frame.poses)
        last[pose.mover_id] = pose;
    // A list that follows may have those that this one has not.
    if (last.size() > freespace::max_movers)
        std::erase_if(last, [&](const auto& entry) { return !lists(state.movers, entry.first); });
    state.mover_frame = frame;
    state.mover_frame->poses.clear();
    for (const auto& [id, pose] : last)
        state.mover_frame->poses.push_back(pose);
}

}  // namespace

void State::apply(const Message& message) {
    std::visit(Overloaded{
                   [&](const director::MatchInfo& info_of_match) { apply_info(*this, info_of_match); },
                   [&](const director::PoseFrame& frame) { apply_poses(*this, frame); },
                   [](const director::MatchEvent&) {},
                   [&](const director::ObserverRequest& request) { requests[request.observer_id] = request; },
                   [&](const Withdrawal& withdrawal) { requests.erase(withdrawal.observer_id); },
                   [&](const director::CameraFrame& frame) { cameras = frame; },
                   [&](const director::MoverInfo& described) { movers = described; },
                   [&](const director::MoverFrame& frame) { apply_mover_frame(*this, frame); },
               },
               message);
}

std::vector<Message> State::messages() const {
    std::vector<Message> all;
    if (info) all.emplace_back(*info);
    if (movers) all.emplace_back(*movers);
    if (mover_frame) all.emplace_back(*mover_frame);
    if (poses) all.emplace_back(*poses);
    for (const auto& [observer, request] : requests)
        all.emplace_back(request);
    if (cameras) all.emplace_back(*cameras);
    return all;
}

}  // namespace camdir::recording
