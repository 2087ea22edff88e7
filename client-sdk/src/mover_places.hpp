// Where the movers of a match are.
#pragma once

#include <camera_director.h>
#include <camera_director/camera_director.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace camdir::sdk {

// Puts the frames of a game together, which need not name all movers: what is sent says where all are, so
// that a frame may be lost. One thread at a time.
class MoverPlaces {
  public:
    // These exist from now on, at most CDIR_MAX_MOVERS; those that did before are where they were.
    void set_known(std::span<const std::uint32_t> ids);
    // Throws a Failure with CDIR_INVALID_ARGUMENT that says what is wrong with the frame, and changes
    // nothing.
    void move(const cdir_mover_frame& frame);

    // Whether one is elsewhere than at the last forget_moves().
    [[nodiscard]] bool have_moved() const { return have_moved_; }
    void forget_moves() { have_moved_ = false; }
    // All that have a place. Without match_id, epoch and times. It points into this object.
    [[nodiscard]] camera_director_MoverFrame sample() const;

  private:
    struct Place {
        std::array<float, 3> position;
        std::array<float, 4> orientation;
        bool operator==(const Place&) const = default;
    };
    [[nodiscard]] bool is_known(std::uint32_t id) const;
    void put(std::uint32_t id, const Place& place);

    std::size_t known_count_ = 0;
    std::array<std::uint32_t, CDIR_MAX_MOVERS> known_;
    // Of those that have a place.
    std::size_t count_ = 0;
    std::array<std::uint32_t, CDIR_MAX_MOVERS> ids_;
    std::array<std::array<float, 3>, CDIR_MAX_MOVERS> positions_;
    std::array<std::array<float, 4>, CDIR_MAX_MOVERS> orientations_;
    bool have_moved_ = false;
};

}  // namespace camdir::sdk
