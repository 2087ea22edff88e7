#include "director/match_obstacles.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace camdir::director {
namespace {

constexpr double obstacles_kept_s = 0.25;
constexpr std::ptrdiff_t worth_forgetting = 32;  // frames

}  // namespace

void MatchObstacles::set_map(const freespace::Freespace* map) {
    map_ = map;
    rebuild();
}

void MatchObstacles::clear() {
    known_.clear();
    info_.reset();
    rebuild();
}

bool MatchObstacles::add(double time, const std::shared_ptr<const MatchMovers>& movers) {
    const bool changed = append({time, movers});
    forget_before(time - obstacles_kept_s);
    return changed;
}

bool MatchObstacles::follow(const Timeline& timeline) {
    const auto all = timeline.movers();
    const double newest = known_.empty() ? -std::numeric_limits<double>::infinity() : known_.back().time;
    bool changed = false;
    for (auto known = std::ranges::upper_bound(all, newest, {}, &TimedMovers::time); known != all.end();
         ++known)
        changed |= append(*known);
    forget_before(timeline.shown() - obstacles_kept_s);
    return changed;
}

bool MatchObstacles::append(const TimedMovers& known) {
    const MatchMovers* before = known_.empty() ? nullptr : known_.back().movers.get();
    const bool is_late = !known_.empty() && known.time <= known_.back().time;
    if (is_late || (!known.movers && known_.empty())) return false;
    const auto info = known.movers ? known.movers->info : nullptr;
    if (std::exchange(info_, info) == info) {
        place(known, before);
        known_.push_back(known);
        return false;
    }
    known_.push_back(known);
    rebuild();
    return true;
}

void MatchObstacles::forget_before(double time) {
    // The one before stays: movers are where it says until the next.
    const auto kept = std::ranges::upper_bound(known_, time, {}, &TimedMovers::time);
    if (kept - known_.begin() <= worth_forgetting) return;
    known_.erase(known_.begin(), kept - 1);
    movers_.forget_before(known_.front().time);
}

void MatchObstacles::rebuild() {
    movers_ = {};
    places_.clear();
    unknown_.clear();
    if (map_ == nullptr || !info_) return;
    find_shapes(*info_);
    const MatchMovers* before = nullptr;
    for (const TimedMovers& known : known_) {
        place(known, before);
        before = known.movers.get();
    }
}

void MatchObstacles::find_shapes(const MoverInfo& info) {
    std::vector<freespace::MoverShape> shapes;
    for (const Mover& mover : info.movers) {
        const freespace::MoverShape* shape = shape_of(mover);
        if (shape == nullptr) {
            unknown_.push_back(mover.shape.name.empty() ? std::to_string(mover.id) : mover.shape.name);
            continue;
        }
        places_.emplace_back(mover.id, static_cast<std::uint32_t>(shapes.size()));
        shapes.push_back(*shape);
        // Two movers may have one model's shape, and names are to be unique.
        shapes.back().name = std::to_string(shapes.size()) + " " + mover.shape.name;
    }
    std::ranges::stable_sort(places_, {}, &decltype(places_)::value_type::first);
    auto movers = freespace::Movers::of(shapes);
    if (movers) {
        movers_ = std::move(*movers);
    } else {
        spdlog::error("the movers are no obstacles: {}", movers.error().message);
        places_.clear();
    }
}

const freespace::MoverShape* MatchObstacles::shape_of(const Mover& mover) const {
    const auto shapes = map_->movers();
    const auto found = std::ranges::find(shapes, mover.shape.name, &freespace::MoverShape::name);
    if (!mover.shape.name.empty() && found != shapes.end()) return &*found;
    const bool has_own = !mover.shape.hulls.empty() || !mover.shape.balls.empty();
    return has_own ? &mover.shape : nullptr;
}

void MatchObstacles::place(const TimedMovers& known, const MatchMovers* before) {
    poses_.clear();
    if (known.movers && (before == nullptr || known.movers->frame != before->frame)) {
        for (const MoverPose& pose : known.movers->frame->poses) {
            const auto found =
                std::ranges::lower_bound(places_, pose.mover_id, {}, &decltype(places_)::value_type::first);
            if (found != places_.end() && found->first == pose.mover_id)
                poses_.push_back({found->second, pose.position, pose.orientation});
        }
    }
    movers_.add(known.time, poses_);  // also where none has moved
}

}  // namespace camdir::director
