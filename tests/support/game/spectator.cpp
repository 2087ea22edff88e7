#include "support/game/spectator.hpp"

#include <algorithm>
#include <limits>

#include "support/eventually.hpp"

namespace camdir::test {
namespace {

enum { team_spectator = 3, following = 4096 };

std::vector<bool> connected_slots(GameServer& server) {
    std::vector<bool> slots(witness_slots);
    if (const auto frame = server.newest()) {
        for (int slot = 0; slot < witness_slots; ++slot)
            slots[slot] = frame->players[slot].connected != 0;
    }
    return slots;
}

}  // namespace

bool is_human_spectator(const witness_player& player) {
    return player.connected && !player.bot && player.team == team_spectator;
}

bool is_overlaid(const witness_record& frame, int slot) {
    const witness_player& player = frame.players[slot];
    return is_human_spectator(player) && (player.pm_flags & following) != 0 && player.client_num == slot;
}

double distance_to_cameras(const witness_record& frame, int slot, const std::vector<CameraTape::Entry>& tape,
                           std::optional<int> player) {
    constexpr int longest_prediction = 250;  // ms
    const Vec3d sent = eye_of(frame.players[slot]);
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [epoch, level_time, received, camera] : tape) {
        if (level_time > frame.level_time || level_time < frame.level_time - longest_prediction) continue;
        if (player && camera.target != static_cast<std::uint32_t>(*player)) continue;
        const Vec3d position = Eigen::Map<const Eigen::Vector3f>(camera.position).cast<double>();
        least = std::min(least, (sent - position).norm() - static_cast<double>(camera.clearance));
    }
    return std::max(least, 0.0);
}

Spectator::Spectator(GameServer& server, const CameraTape& tape, const GameClientOptions& options)
    : server_(server), tape_(tape), earlier_(connected_slots(server)), client_(server.port(), options) {}

bool Spectator::joins() {
    const auto spectates = [&](const witness_record& frame) {
        for (int slot = 0; slot < witness_slots; ++slot) {
            if (!earlier_[slot] && is_human_spectator(frame.players[slot])) slot_ = slot;
        }
        return slot_ >= 0;
    };
    return server_.reaches(spectates) && client_.draws(1) && has_camera() && draws_camera();
}

bool Spectator::follows(int player) {
    client_.console().enter("cmd follow " + std::to_string(player));
    return server_.reaches([&](const witness_record& frame) {
        constexpr double rounding = 0.01;
        return is_overlaid(frame, slot_) &&
               distance_to_cameras(frame, slot_, tape_.entries(), player) <= rounding;
    });
}

bool Spectator::has_camera() {
    return server_.reaches([&](const witness_record& frame) { return is_overlaid(frame, slot_); });
}

bool Spectator::has_own_view() {
    return server_.reaches([&](const witness_record& frame) { return !is_overlaid(frame, slot_); });
}

bool Spectator::draws_camera() {
    return eventually([&] {
        const auto& pictures = client_.drawn();
        if (pictures.empty()) return false;
        const CommandedPath path(server_.witnessed(), slot_);
        const auto drawn = locate(path, pictures.back());
        return drawn && drawn->offset < 0.1 && drawn->turn < 0.1 &&
               is_overlaid(path.snapshots()[path.snapshot_at(drawn->time, drawn->newest)].frame, slot_);
    });
}

}  // namespace camdir::test
