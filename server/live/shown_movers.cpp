#include "live/shown_movers.hpp"

#include <algorithm>
#include <utility>

namespace camdir::live {

bool ShownMovers::follow(const std::shared_ptr<const director::MatchMovers>& movers) {
    const auto info = movers ? movers->info : nullptr;
    const bool changed = std::exchange(info_, info) != info;
    if (changed) forget_gone();
    const auto frame = movers ? movers->frame : nullptr;
    if (std::exchange(frame_, frame) == frame && !changed) return false;
    if (frame)
        for (const director::MoverPose& pose : frame->poses)
            place(pose);
    return changed;
}

std::span<const director::Mover> ShownMovers::movers() const {
    return info_ ? std::span<const director::Mover>(info_->movers) : std::span<const director::Mover>();
}

void ShownMovers::forget_gone() {
    ids_.clear();
    for (const director::Mover& mover : movers())
        ids_.push_back(mover.id);
    std::ranges::sort(ids_);
    std::erase_if(poses_, [this](const director::MoverPose& pose) {
        return !std::ranges::binary_search(ids_, pose.mover_id);
    });
}

void ShownMovers::place(const director::MoverPose& pose) {
    if (!std::ranges::binary_search(ids_, pose.mover_id)) return;
    const auto found = std::ranges::lower_bound(poses_, pose.mover_id, {}, &director::MoverPose::mover_id);
    if (found != poses_.end() && found->mover_id == pose.mover_id)
        *found = pose;
    else
        poses_.insert(found, pose);
}

}  // namespace camdir::live
