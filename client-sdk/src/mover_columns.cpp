#include "mover_columns.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "borrow.hpp"
#include "checks.hpp"
#include "fixed_string.hpp"

namespace camdir::sdk {

namespace {

bool all_normals(std::span<const float> planes) {
    for (std::size_t i = 0; i < planes.size(); i += 4) {
        const double length = std::hypot(double{planes[i]}, double{planes[i + 1]}, double{planes[i + 2]});
        // Negated so that NaN fails.
        if (!(std::abs(length - 1.0) <= 1e-3)) return false;
    }
    return true;
}

}  // namespace

MoverColumns::MoverColumns(std::span<const cdir_mover> movers) {
    for (const cdir_mover& mover : movers) {
        try {
            add(mover);
        } catch (const Failure& failure) {
            throw Failure{failure.status, "mover " + std::to_string(mover.id) + ": " + failure.text};
        }
    }
}

void MoverColumns::add(const cdir_mover& mover) {
    require(std::ranges::find(ids_, mover.id) == ids_.end(), "an earlier mover has the same id");
    (void)checked_string("model", mover.model, 0, sizeof mover.model - 1);
    (void)checked_string("kind", mover.kind, 0, sizeof mover.kind - 1);
    ids_.push_back(mover.id);
    copy_string(models_.emplace_back().text, mover.model);
    copy_string(kinds_.emplace_back().text, mover.kind);
    add_hulls(mover);
    add_balls(mover);
}

void MoverColumns::add_hulls(const cdir_mover& mover) {
    require(mover.hull_count <= CDIR_MAX_HULLS, "hull_count is greater than CDIR_MAX_HULLS");
    hulls_.push_back(mover.hull_count);
    if (mover.hull_count == 0) return;
    require(mover.hull_sizes != nullptr && mover.half_spaces != nullptr, "hull_sizes or half_spaces is null");
    const float* next = mover.half_spaces;
    for (const std::uint32_t size : std::span(mover.hull_sizes, mover.hull_count)) {
        require(size >= 4 && size <= CDIR_MAX_HALF_SPACES,
                "one of hull_sizes is not 4 to CDIR_MAX_HALF_SPACES");
        require(planes_.size() / 4 + size <= CDIR_MAX_SHAPES,
                "the movers have more half spaces than CDIR_MAX_SHAPES");
        const std::span<const float> planes(next, 4 * std::size_t{size});
        require(all_finite(planes.data(), planes.size()), "a half space is not finite");
        require(all_normals(planes), "a normal of half_spaces is not of length 1");
        half_spaces_.push_back(size);
        planes_.insert(planes_.end(), planes.begin(), planes.end());
        next += planes.size();
    }
}

void MoverColumns::add_balls(const cdir_mover& mover) {
    require(mover.ball_count <= CDIR_MAX_HULLS, "ball_count is greater than CDIR_MAX_HULLS");
    balls_.push_back(mover.ball_count);
    if (mover.ball_count == 0) return;
    require(mover.balls != nullptr, "balls is null");
    require(spheres_.size() / 4 + mover.ball_count <= CDIR_MAX_SHAPES,
            "the movers have more balls than CDIR_MAX_SHAPES");
    const std::span<const float> spheres(mover.balls, 4 * std::size_t{mover.ball_count});
    require(all_finite(spheres.data(), spheres.size()), "a ball is not finite");
    for (std::size_t i = 3; i < spheres.size(); i += 4)
        require(spheres[i] > 0.0F, "the radius of a ball is not greater than 0");
    spheres_.insert(spheres_.end(), spheres.begin(), spheres.end());
}

camera_director_MoverInfo MoverColumns::sample() const {
    camera_director_MoverInfo sample{};
    borrow(sample.mover_id, ids_.data(), ids_.size());
    // An array of structs of one char array is an array of those char arrays.
    borrow(sample.model, reinterpret_cast<const char(*)[64]>(models_.data()), models_.size());
    borrow(sample.kind, reinterpret_cast<const char(*)[32]>(kinds_.data()), kinds_.size());
    borrow(sample.hulls, hulls_.data(), hulls_.size());
    borrow(sample.half_spaces, half_spaces_.data(), half_spaces_.size());
    borrow(sample.planes, planes_.data(), planes_.size());
    borrow(sample.balls, balls_.data(), balls_.size());
    borrow(sample.spheres, spheres_.data(), spheres_.size());
    return sample;
}

}  // namespace camdir::sdk
