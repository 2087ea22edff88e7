// The moving obstacles of a match, for its trackers and its direction.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "director/messages.hpp"
#include "director/timeline.hpp"
#include "freespace/freespace.hpp"
#include "freespace/movers.hpp"

namespace camdir::director {

// Finds the shapes of a match's movers, and follows where they are over the times that its cameras are
// computed for and foresee. One thread at a time; movers() may be asked by several until the next change.
//
// With a delay, what has come or gone by the newest known time has so for all: a mover that leaves the match
// is no obstacle for up to that long before.
class MatchObstacles {
  public:
    // Of another map: shapes are looked up anew. Null: there is none, and no obstacles.
    void set_map(const freespace::Freespace* map);
    // Time begins anew, without movers.
    void clear();

    // The movers as of a frame; null: none. A time that is not later than the last one adds
    // nothing. Both functions return whether the shapes have changed.
    bool add(double time, const std::shared_ptr<const MatchMovers>& movers);
    // The same of all frames that the timeline has come to know.
    bool follow(const Timeline& timeline);

    [[nodiscard]] const freespace::Movers& movers() const { return movers_; }
    // Movers that have a shape.
    [[nodiscard]] std::size_t count() const { return places_.size(); }
    // Those that have none: by model, or by number where they name none.
    [[nodiscard]] const std::vector<std::string>& unknown() const { return unknown_; }

  private:
    bool append(const TimedMovers& known);
    void forget_before(double time);
    void rebuild();
    void find_shapes(const MoverInfo& info);
    [[nodiscard]] const freespace::MoverShape* shape_of(const Mover& mover) const;
    void place(const TimedMovers& known, const MatchMovers* before);

    const freespace::Freespace* map_ = nullptr;
    std::vector<TimedMovers> known_;  // ascending by time
    // Of the newest of them.
    std::shared_ptr<const MoverInfo> info_;
    freespace::Movers movers_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> places_;  // id, place among the shapes; by id
    std::vector<std::string> unknown_;
    std::vector<freespace::MoverPose> poses_;  // during place()
};

}  // namespace camdir::director
