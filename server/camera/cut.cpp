#include "camera/cut.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "camera/evade.hpp"
#include "camera/reach.hpp"
#include "camera/regain.hpp"
#include "freespace/roadmap.hpp"

namespace camdir::camera {
namespace {

constexpr std::array shares = {1.0F, 0.9F, 0.75F, 0.5F};  // of the way to the best spot

// The nearest corner of the slabs round the anchor that keeps kept_clearance() and sees the anchor.
std::optional<Candidate> roadmap_spot(const freespace::Space& space, const MapProfile& profile,
                                      const PlayerTrack& track) {
    if (track.slab == freespace::none) return std::nullopt;
    const freespace::Triangle& triangle = space.map().triangles()[track.slab];
    std::optional<Candidate> nearest;
    float least = 0.0F;
    for (const std::uint32_t corner : {triangle.a, triangle.b, triangle.c}) {
        const Vec3f position = space.map().vertices()[corner].position();
        const float distance = (position - track.anchor).norm();
        if (nearest && distance >= least) continue;
        const std::optional<Candidate> candidate = look_up(space, profile, track, position);
        if (!candidate || !acceptable(profile, track, *candidate)) continue;
        nearest = candidate;
        least = distance;
    }
    return nearest;
}

constexpr std::size_t most_near = 64;     // vertices that are asked about movers: the nearest
constexpr std::size_t most_spread = 128;  // and, where there is no room among these, so many of all

// The vertices of the roadmap nearest to a point, in no order.
class NearVertices {
  public:
    explicit NearVertices(const Vec3f& point) : point_(point) {}

    void consider(std::uint32_t vertex, const Vec3f& position) {
        const Entry entry{(position - point_).squaredNorm(), vertex};
        if (count_ == most_near && !(entry < entries_.front())) return;
        if (count_ == most_near) std::pop_heap(entries_.begin(), entries_.begin() + count_--);
        entries_[static_cast<std::size_t>(count_++)] = entry;
        std::push_heap(entries_.begin(), entries_.begin() + count_);
    }
    template <class Visitor>
    void for_each(const Visitor& visit) const {
        for (std::ptrdiff_t i = 0; i < count_; ++i)
            visit(entries_[static_cast<std::size_t>(i)].second);
    }

  private:
    using Entry = std::pair<float, std::uint32_t>;  // squared distance, vertex
    Vec3f point_;
    std::array<Entry, most_near> entries_;  // a heap
    std::ptrdiff_t count_ = 0;
};

// The nearest of some places that has the wanted room between movers, else the one that has most of it.
class RoomiestVertex {
  public:
    RoomiestVertex(const freespace::Space& space, const Vec3f& from, float wanted)
        : space_(space), from_(from), wanted_(wanted) {}

    void consider(std::uint32_t i) {
        const freespace::Vertex& vertex = space_.map().vertices()[i];
        const float distance = (vertex.position() - from_).norm();
        if (found() && distance >= distance_ && room_ >= wanted_) return;
        const float wanted = std::min(vertex.free_distance, wanted_);
        if (space_.mover_distance(vertex.position(), wanted).value <= 0.0F) return;  // as most are, if many
        const float room = room_soon(space_, vertex.position(), wanted);
        if (room < room_ || room <= 0.0F || (room == room_ && distance >= distance_)) return;
        vertex_ = i;
        distance_ = distance;
        room_ = room;
    }
    [[nodiscard]] bool found() const { return vertex_ != freespace::none; }
    [[nodiscard]] Vec3f position() const { return space_.map().vertices()[vertex_].position(); }

  private:
    const freespace::Space& space_;
    Vec3f from_;
    float wanted_;
    std::uint32_t vertex_ = freespace::none;
    float distance_ = 0.0F;
    float room_ = 0.0F;
};

// Where a mover is over the anchor: a vertex of the roadmap in no mover's way, near the anchor if there is
// one, if possible one that has kept_clearance(). Movers over the whole map must not make it slow: not every
// vertex is asked about.
std::optional<Candidate> free_vertex(const freespace::Space& space, const MapProfile& profile,
                                     const PlayerTrack& track) {
    const auto vertices = space.map().vertices();
    const auto is_place = [&](std::uint32_t i) {
        return freespace::on_roadmap(vertices[i]) && !space.map().incident(i).empty();
    };
    NearVertices near(track.anchor);
    std::size_t places = 0;
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        if (!is_place(i)) continue;
        near.consider(i, vertices[i].position());
        ++places;
    }
    RoomiestVertex best(space, track.anchor, kept_clearance(profile, track));
    near.for_each([&](std::uint32_t i) { best.consider(i); });
    const std::size_t stride = (places + most_spread - 1) / most_spread;
    std::size_t place = 0;
    for (std::uint32_t i = 0; i < vertices.size() && !best.found(); ++i)
        if (is_place(i) && place++ % stride == 0) best.consider(i);
    if (!best.found()) return std::nullopt;
    return look_up(space, profile, track, best.position());
}

}  // namespace

Candidate landing(const freespace::Space& space, const MapProfile& profile, const PlayerTrack& track,
                  const LineOfAction* line) {
    const Spot spot = spot_to_cut_to(space, profile, track, line);
    for (const float share : shares) {
        const Vec3f place = track.anchor + share * spot.offset;
        const auto candidate = look_up(space, profile, track, place);
        if (candidate && acceptable(profile, track, *candidate)) return *candidate;
    }
    if (const auto candidate = roadmap_spot(space, profile, track)) return *candidate;
    const Candidate anchor{track.anchor, track.slab, track.clearance, track.clearance, track.clearance};
    if (!space.has_movers() || freespace::distance(space, track.anchor).covered()) return anchor;
    return free_vertex(space, profile, track).value_or(anchor);
}

}  // namespace camdir::camera
