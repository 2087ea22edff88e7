#include "mover_places.hpp"

#include <algorithm>

#include "borrow.hpp"
#include "checks.hpp"
#include "gather.hpp"

namespace camdir::sdk {

void MoverPlaces::set_known(std::span<const std::uint32_t> ids) {
    known_count_ = ids.size();
    std::ranges::copy(ids, known_.begin());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        if (!is_known(ids_[i])) continue;
        ids_[kept] = ids_[i];
        positions_[kept] = positions_[i];
        orientations_[kept] = orientations_[i];
        ++kept;
    }
    count_ = kept;
}

bool MoverPlaces::is_known(std::uint32_t id) const {
    const auto known = std::span(known_).first(known_count_);
    return std::ranges::find(known, id) != known.end();
}

void MoverPlaces::move(const cdir_mover_frame& frame) {
    require(frame.mover_count <= CDIR_MAX_MOVERS, "mover_count is greater than CDIR_MAX_MOVERS");
    require(frame.reserved == 0, "frame.reserved is not 0");
    const std::size_t count = frame.mover_count;
    if (count == 0) return;
    std::array<std::uint32_t, CDIR_MAX_MOVERS> ids;
    std::array<float, 3 * CDIR_MAX_MOVERS> positions;
    std::array<float, 4 * CDIR_MAX_MOVERS> orientations;
    gather_array<1>("mover_id", frame.mover_id, frame.mover_id_stride, count, ids.data());
    gather_array<3>("position", frame.position, frame.position_stride, count, positions.data());
    gather_array<4>("orientation", frame.orientation, frame.orientation_stride, count, orientations.data());
    require(all_finite(positions.data(), 3 * count), "a mover's position is not finite");
    require(all_unit(orientations.data(), count), "a mover's orientation is not of length 1");
    require(std::all_of(ids.begin(), ids.begin() + count, [this](std::uint32_t id) { return is_known(id); }),
            "a mover is none of those in cdir_match_set_movers()");
    auto sorted = ids;
    std::sort(sorted.begin(), sorted.begin() + count);
    require(std::adjacent_find(sorted.begin(), sorted.begin() + count) == sorted.begin() + count,
            "a mover is given twice");
    for (std::size_t i = 0; i < count; ++i) {
        Place place;
        std::copy_n(&positions[3 * i], 3, place.position.begin());
        std::copy_n(&orientations[4 * i], 4, place.orientation.begin());
        put(ids[i], place);
    }
}

void MoverPlaces::put(std::uint32_t id, const Place& place) {
    const auto placed = std::span(ids_).first(count_);
    const auto index = static_cast<std::size_t>(std::ranges::find(placed, id) - placed.begin());
    if (index < count_ && place == Place{positions_[index], orientations_[index]}) return;
    if (index == count_) ids_[count_++] = id;
    positions_[index] = place.position;
    orientations_[index] = place.orientation;
    have_moved_ = true;
}

camera_director_MoverFrame MoverPlaces::sample() const {
    camera_director_MoverFrame sample{};
    borrow(sample.mover_id, ids_.data(), count_);
    borrow(sample.position, positions_.front().data(), 3 * count_);
    borrow(sample.orientation, orientations_.front().data(), 4 * count_);
    return sample;
}

}  // namespace camdir::sdk
