// What a standby does to go on from the cameras of the director that leads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "director/messages.hpp"
#include "director/requests.hpp"
#include "freespace/space.hpp"

namespace camdir::director {

// Compares what the leader has shown with this director's own cameras of the same pose, and corrects the
// shots where they differ. One thread at a time.
class Follower {
  public:
    // Where this director's next cameras are to be written, before any other call: into memory that is used
    // again.
    [[nodiscard]] CameraFrame& next_own() {
        newest_ = own_count_++ % own_.size();
        return own_[newest_];
    }

    // The leader has shown this, which replaces what it has shown before. Other memory is left to the caller.
    void hear(CameraFrame& shown);

    struct Setting {
        std::vector<Shot>& shots;
        freespace::Space space;  // its time does not matter
        bool fixed_shots;        // those of the map may be shown
    };
    // Takes over what was heard last, once: as soon as there are own cameras of the same pose. Targets change
    // with the next frame. Where this director is ahead, the leader's camera is taken to have moved since as
    // its own did. What this director does not have changes nothing, nor does what was shown before a cut.
    void follow(const Setting& setting);

  private:
    static constexpr std::size_t max_own = 16;  // frames that are remembered

    struct Disagreement {
        const ShotCamera &own, &shown;  // at the same pose
    };

    void hear_reason(Shot& shot) const;
    // They return false where the shot goes on as it is: the leader shows what this director does not have.
    // `shot`: null where it has ended.
    bool correct(const Disagreement& disagreement, Shot* shot, const Setting& setting) const;
    bool correct_target(const ShotCamera& shown, Shot& shot, const Setting& setting) const;
    void correct_place(const Disagreement& disagreement, const ShotCamera& newest, Shot& shot,
                       const freespace::Space& space) const;
    [[nodiscard]] std::span<const CameraFrame> own() const;
    [[nodiscard]] const CameraFrame* own_of_shown_pose() const;
    [[nodiscard]] bool has_cut_since(std::uint32_t camera_id) const;

    CameraFrame shown_, shown_before_;      // the last two of the leader
    bool is_followed_ = true;               // shown_ has had its effect
    std::array<CameraFrame, max_own> own_;  // the next takes the place of the oldest
    std::size_t own_count_ = 0;             // since a shot was corrected
    std::size_t newest_ = 0;
};

}  // namespace camdir::director
