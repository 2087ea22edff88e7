// One programme as it is made: what is on the air now, decision by decision.
#pragma once

#include <optional>
#include <span>

#include "direction/editor.hpp"
#include "direction/material.hpp"

namespace camdir::direction {

// One thread at a time. What was shown is not revised.
class Cutter {
  public:
    // Before every beat that may have a cut, or any such beat later. Returns the shot that begins at `now`;
    // nothing when the one on the air goes on. `moments`: those of the material at `now`. `choice`: the
    // rushes that may be on the air; empty: all. What is on the air and not of the choice ends at once.
    std::optional<Shot> decide(const Material& material, std::span<const Moment> moments, const Rules& rules,
                               double unit, Beat now, std::span<const std::size_t> choice = {});

    // Somebody else has decided so.
    void cut_to(const Shot& shot) { on_air_.shot = shot; }

    [[nodiscard]] const std::optional<Shot>& on_air() const { return on_air_.shot; }

  private:
    OnAir on_air_;
};

}  // namespace camdir::direction
