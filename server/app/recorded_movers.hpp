// The doors and lifts of a recorded match, as `direct` and `evaluate --group` ask for them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "evaluation/mover_tracks.hpp"
#include "evaluation/placed_movers.hpp"
#include "freespace/freespace.hpp"
#include "freespace/movers.hpp"
#include "scene/scene.hpp"

namespace camdir::app {

// Immutable; needs what it is made of for as long as it is asked. Without rows nothing moves.
class RecordedMovers {
  public:
    // `rows` were recorded beside `poses`; those of models that the scene or the freespace does not have are
    // left out there.
    RecordedMovers(std::span<const evaluation::MoverRow> rows, std::span<const scene::Mover> movers,
                   const freespace::Freespace& freespace, const evaluation::Trace& poses);

    [[nodiscard]] std::span<const evaluation::MoverRow> rows() const { return rows_; }
    // As the map has them.
    [[nodiscard]] evaluation::PlacedMovers exact_at(std::int64_t time) const;
    // As a director has them, but for those that the scene does not have: at all times where they are at
    // `time`.
    [[nodiscard]] freespace::Movers baked_at(std::int64_t time) const;

  private:
    std::span<const evaluation::MoverRow> rows_;
    std::span<const scene::Mover> movers_;
    evaluation::MoverTracks tracks_;  // of movers_
    freespace::Movers shapes_;
    std::vector<std::optional<std::uint32_t>> places_;  // among movers_, by shape
};

}  // namespace camdir::app
