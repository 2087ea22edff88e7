// Lines of sight from the eyes of a future, as thick beams, and what is known of them from earlier plans.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "camera/directions.hpp"
#include "camera/future.hpp"
#include "camera/profile.hpp"
#include "freespace/space.hpp"

namespace camdir::camera {

// A beam that was found free. It stays free for a radius while neither of its ends has moved by more than its
// clearance exceeds that radius.
struct FreeBeam {
    Vec3f eye = Vec3f::Zero();
    Vec3f end = Vec3f::Zero();
    float clearance = -1.0F;  // along it; negative: nothing is known

    [[nodiscard]] bool covers(const Vec3f& other_eye, const Vec3f& other_end, float radius) const {
        const float spare = clearance - radius;
        return spare >= 0.0F && (other_eye - eye).squaredNorm() <= spare * spare &&
               (other_end - end).squaredNorm() <= spare * spare;
    }
};

// The last beam of each sample of a plan that was found free. A value.
class FreeBeams {
  public:
    [[nodiscard]] FreeBeam& of_sample(std::size_t i) { return beams_[number(i) % beams_.size()]; }
    // The number of a sample, which it keeps from plan to plan.
    [[nodiscard]] std::size_t number(std::size_t i) const { return first_ + i; }
    // Sample `count` becomes the first one.
    void advance(std::size_t count);

  private:
    std::array<FreeBeam, Future::capacity> beams_;
    std::size_t first_ = 0;
};

// How far directions of the grid were found free from eyes nearby: of those in one cell of space, one asks
// for all. A value, which forgets what it has no room for. What it answers is a wish that the path's own
// beams check: once in 2^32 times it may be another cell's.
class FreeLengths {
  public:
    // What the lengths depend on besides the place; another one forgets them all.
    void use(float longest, float radius);
    // The length in a direction from `eye`, to be set by the caller where it is negative: not known.
    [[nodiscard]] float& at(const Vec3f& eye, std::size_t bin, float cell);

  private:
    struct Entry {
        std::uint32_t tag = 0;
        float length = -1.0F;
    };
    std::array<Entry, 4096> entries_;
    float longest_ = 0.0F;
    float radius_ = 0.0F;
};

// Where a beam from the player's eye ends before its goal.
struct BeamEnd {
    float free_length;
    Vec3f normal;  // roughly of the obstacle: the way out of the last free ball, length 1
};

// Beams from the eyes of a future, among the movers as they are at the time of the sample. What is remembered
// is of the map alone. Their radius is 4/3 of the clearance that the camera keeps, but less than
// the eye's own clearance.
class Beams {
  public:
    Beams(const freespace::Space& space, const MapProfile& profile, const Future& future, FreeBeams& known,
          FreeLengths& lengths, freespace::RecentBalls& balls);

    // The clearance of a place near the eyes. Spares looking it up.
    void set_clearance(const Vec3f& place, float clearance) {
        clear_eye_ = place;
        clearance_ = clearance;
    }

    // How far the beam from the eye of sample i is free in a direction (unit), at most `length`.
    [[nodiscard]] float free_length(std::size_t i, const Vec3f& direction, float length);
    // The same for the profile's distance in a direction of the grid, from the eye of sample i or one nearby.
    [[nodiscard]] float free_length(std::size_t i, std::size_t bin);
    // None when the beam is free for `length`.
    [[nodiscard]] std::optional<BeamEnd> end(std::size_t i, const Vec3f& direction, float length);
    // How many samples after sample i the next one is whose number is a multiple of `stride`: from plan to
    // plan the same ones, whose beams are known. 1 .. stride.
    [[nodiscard]] std::size_t to_next_of(std::size_t stride, std::size_t i) const {
        return stride - known_.number(i) % stride;
    }

  private:
    [[nodiscard]] Box3f box_of_beams() const;
    float radius(std::size_t i);
    float radius_from(const Vec3f& eye);
    freespace::Sight sight(std::size_t i, const Vec3f& goal);
    // On the map, among movers that are not there.
    float length_on_map(std::size_t i, const Vec3f& direction, float length);
    std::optional<BeamEnd> end_on_map(std::size_t i, const Vec3f& direction, float length);
    // Where a mover ends a beam of `length`.
    std::optional<BeamEnd> end_at_mover(std::size_t i, const Vec3f& direction, float length);
    float length_among_movers(std::size_t i, const Vec3f& direction, float length);

    const freespace::Space space_;
    const MapProfile& profile_;
    const Future& future_;
    FreeBeams& known_;
    FreeLengths& lengths_;
    freespace::RecentBalls& balls_;
    std::array<float, Future::capacity> radius_;  // of each sample; negative: not asked yet
    Vec3f clear_eye_ = Vec3f::Zero();             // the last place whose clearance is known
    float clearance_ = -1.0F;
    bool has_movers_;  // in reach of a beam of the profile's distance
};

}  // namespace camdir::camera
