#include "app/recorded_movers.hpp"

#include <cassert>
#include <utility>

namespace camdir::app {

RecordedMovers::RecordedMovers(std::span<const evaluation::MoverRow> rows,
                               std::span<const scene::Mover> movers, const freespace::Freespace& freespace,
                               const evaluation::Trace& poses)
    : rows_(rows), movers_(movers), tracks_(rows, movers, poses) {
    if (rows.empty()) return;
    auto shapes = freespace::Movers::of(freespace.movers());
    assert(shapes);  // opening the freespace has checked them
    shapes_ = std::move(*shapes);
    const auto places = evaluation::places_by_model(movers);
    for (const freespace::MoverShape& shape : freespace.movers()) {
        const auto model = evaluation::model_of(shape.name);
        const auto place = model ? places.find(*model) : places.end();
        places_.push_back(place != places.end() ? std::optional(place->second) : std::nullopt);
    }
}

evaluation::PlacedMovers RecordedMovers::exact_at(std::int64_t time) const {
    if (rows_.empty()) return {};
    return {movers_, tracks_, time};
}

freespace::Movers RecordedMovers::baked_at(std::int64_t time) const {
    freespace::Movers movers = shapes_;
    std::vector<freespace::MoverPose> poses;
    for (std::uint32_t shape = 0; shape < places_.size(); ++shape)
        if (const auto placement = places_[shape] ? tracks_.at(*places_[shape], time) : std::nullopt)
            poses.push_back({shape, placement->position.cast<float>(),
                             placement->orientation.cast<float>().normalized()});
    movers.add(0.0, poses);
    return movers;
}

}  // namespace camdir::app
