// What viewers are shown of a match's moving obstacles.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "director/messages.hpp"

namespace camdir::live {

// The game server writes a frame when a mover is elsewhere, and leaves out whom it likes: these are where all
// of them are. Of one epoch; one thread at a time.
class ShownMovers {
  public:
    // As of a pose frame, null: none. Returns whether there are others than before.
    bool follow(const std::shared_ptr<const director::MatchMovers>& movers);

    // Empty: there are none.
    [[nodiscard]] std::span<const director::Mover> movers() const;
    // Of those that have been somewhere, ascending by id.
    [[nodiscard]] std::span<const director::MoverPose> poses() const { return poses_; }

  private:
    void forget_gone();
    void place(const director::MoverPose& pose);

    std::shared_ptr<const director::MoverInfo> info_;
    std::shared_ptr<const director::MoverFrame> frame_;
    std::vector<std::uint32_t> ids_;  // of `info_`, ascending
    std::vector<director::MoverPose> poses_;
};

}  // namespace camdir::live
