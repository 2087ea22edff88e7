#include "freespace/fixed_shots.hpp"

#include <array>
#include <bitset>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "freespace/lookouts.hpp"
#include "freespace/movers.hpp"
#include "freespace/visibility.hpp"

namespace camdir::freespace {
namespace {

constexpr std::size_t most_places = 256;
constexpr std::size_t most_aims = 512;
constexpr std::size_t yaws = 16;
constexpr std::array pitches{-0.5F, -0.2F};  // rad: from above
constexpr std::size_t worth_a_shot = 100;    // a share of what there is to see
// Shots that overlook much are chosen, farther than their pictures show players well, units of 0.0254 m. By
// what is near alone fewer kills are seen (oa_rpg3dm2 at 60 Hz with 10 s of delay: 66 instead of 72).
constexpr float overlooked = 1500.0F;

using Aims = std::bitset<most_aims>;

// Evenly from the roomiest to the tightest.
std::vector<Vec3f> sample(std::span<const Vec3f> positions, std::size_t most) {
    std::vector<Vec3f> some;
    const std::size_t count = std::min(positions.size(), most);
    for (std::size_t i = 0; i < count; ++i)
        some.push_back(positions[i * positions.size() / count]);
    return some;
}

// As they are at time 0.
Movers resting(std::span<const MoverShape> shapes) {
    auto movers = Movers::of(shapes);
    assert(movers);  // opening the freespace has checked them
    std::vector<MoverPose> rest;
    for (const MoverShape& shape : shapes)
        rest.push_back({static_cast<std::uint32_t>(rest.size()), shape.rest, Quatf::Identity()});
    movers->add(0.0, rest);
    return std::move(*movers);
}

bool in_picture(const FixedShot& shot, const Vec3f& point) {
    const Vec3f forward(std::cos(shot.yaw) * std::cos(shot.pitch), std::sin(shot.yaw) * std::cos(shot.pitch),
                        std::sin(shot.pitch));
    const Vec3f right(std::sin(shot.yaw), -std::cos(shot.yaw), 0.0F);
    const Vec3f way = point - shot.position;
    const float depth = way.dot(forward);
    return depth > 0.0F && std::abs(way.dot(right)) <= fixed_shot_tan_across * depth &&
           std::abs(way.dot(right.cross(forward))) <= fixed_shot_tan_up * depth;
}

struct View {
    FixedShot shot;
    Aims seen;
};

class Search {
  public:
    explicit Search(const Freespace& freespace)
        : freespace_(freespace),
          unit_(static_cast<float>(metres_of_nominal_unit) / freespace.metadata().metres_per_unit),
          aims_(sample(freespace.lookouts().positions(), most_aims)) {
        const Movers movers = resting(freespace.movers());
        for (const Vec3f& place : sample(freespace.lookouts().positions(), most_places))
            if (movers.distance(place, 0.0).value >= fixed_shot_room * unit_) add_views(place);
    }

    std::vector<FixedShot> choose() {
        std::vector<FixedShot> shots;
        Aims missing;
        for (std::size_t i = 0; i < aims_.size(); ++i)
            missing.set(i);
        while (shots.size() < max_fixed_shots) {
            const View* best = nullptr;
            std::size_t most = aims_.size() / worth_a_shot;
            for (const View& view : views_) {
                const std::size_t count = (view.seen & missing).count();
                if (count <= most) continue;
                most = count;
                best = &view;
            }
            if (best == nullptr) break;
            missing &= ~best->seen;
            shots.push_back(best->shot);
            shots.back().spawn_point = nearest_spawn_point(best->shot.position);
        }
        return shots;
    }

  private:
    void add_views(const Vec3f& place) {
        const SightOrigin origin(freespace_, place, 0.0F);
        std::vector<std::size_t> seen;
        for (std::size_t i = 0; i < aims_.size(); ++i)
            if ((aims_[i] - place).norm() <= overlooked * unit_ && origin.to(aims_[i]).clear)
                seen.push_back(i);
        for (std::size_t turn = 0; turn < yaws; ++turn)
            for (const float pitch : pitches) {
                const float yaw =
                    2.0F * std::numbers::pi_v<float> * static_cast<float>(turn) / static_cast<float>(yaws);
                View& view = views_.emplace_back(View{{place, yaw, pitch, none}, {}});
                for (const std::size_t aim : seen)
                    view.seen.set(aim, in_picture(view.shot, aims_[aim]));
            }
    }

    [[nodiscard]] std::uint32_t nearest_spawn_point(const Vec3f& place) const {
        std::uint32_t nearest = none;
        float least = std::numeric_limits<float>::infinity();
        const auto spawns = freespace_.spawn_points();
        for (std::uint32_t i = 0; i < spawns.size(); ++i) {
            const float distance = (spawns[i].eye - place).norm();
            if (distance >= least) continue;
            least = distance;
            nearest = i;
        }
        return nearest;
    }

    const Freespace& freespace_;
    float unit_;
    std::vector<Vec3f> aims_;
    std::vector<View> views_;
};

}  // namespace

bool frames(const FixedShot& shot, const Vec3f& point, float unit) {
    return (point - shot.position).norm() <= fixed_shot_range * unit && in_picture(shot, point);
}

std::vector<FixedShot> find_fixed_shots(const Freespace& freespace) {
    return Search(freespace).choose();
}

}  // namespace camdir::freespace
