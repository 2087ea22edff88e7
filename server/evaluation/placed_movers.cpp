#include "evaluation/placed_movers.hpp"

namespace camdir::evaluation {

PlacedMovers::PlacedMovers(std::span<const scene::Mover> movers, const MoverTracks& tracks, std::int64_t time)
    : movers_(movers), placements_(movers.size()) {
    for (std::size_t i = 0; i < movers.size(); ++i)
        placements_[i] = tracks.at(i, time);
}

bool PlacedMovers::meet(const PlacedMovers& before, const Vec3d& from, const PlacedMovers& after,
                        const Vec3d& to) {
    for (std::size_t i = 0; i < before.movers_.size(); ++i) {
        const auto& first = before.placements_[i];
        const auto& last = after.placements_[i];
        if (first && last && oracle::touches(before.movers_[i], first->local(from), last->local(to)))
            return true;
    }
    return false;
}

}  // namespace camdir::evaluation
