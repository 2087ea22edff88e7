// The place from which a group is best shown, now and for as far as is known.
#pragma once

#include <array>
#include <optional>

#include "camera/group/cut_plan.hpp"
#include "camera/group/framing.hpp"
#include "camera/group/glide.hpp"
#include "camera/group/members.hpp"
#include "camera/group/outlook.hpp"
#include "camera/profile.hpp"
#include "freespace/lookouts.hpp"
#include "freespace/space.hpp"

namespace camdir::camera {

struct Viewpoint {
    Vec3f position = Vec3f::Zero();
    Look look;            // with those shown in the middle
    MemberSet shown = 0;  // now or, of a cut in a known future, soon
    float worth = 0.0F;   // see ViewpointSearch
};

// Where the camera comes from.
struct Standpoint {
    Vec3f position = Vec3f::Zero();
    float side = 0.0F;    // of the line of action: see side_of(); 0: any
    float cut_in = 0.0F;  // s: until it may cut
    Vec3f velocity = Vec3f::Zero();
    Vec3f goal = Vec3f::Zero();  // that it glides to; where it is, when it stands
};

// No shot between two cuts is shorter, s.
inline constexpr float shortest_group_shot = 0.75F;

// The part of the picture in which members count as shown.
[[nodiscard]] PictureShape safe_area(const MapProfile& profile);

// On which side of the line between two living members the position is, seen from above: > 0 left of the way
// from the more important one to the other; 0 where there are not two. From the other side they change places
// in the picture.
[[nodiscard]] float side_of(const Members::Instant& members, const Vec3f& position);

// The living members whose eyes a sight from `position` reaches.
[[nodiscard]] MemberSet seen_from(const freespace::Space& space, const Vec3f& position,
                                  const Members::Instant& members);

// The search for viewpoints of some of the members, among the lookouts.
//
// The worth of a decision is the time, s, for which all of the set are shown: from the place that it leads
// to and on the way, and, from the instant on at which the camera may and should cut away from there, by the
// best sequence of cuts. What is not known yet counts as if it went on a little as it is. A cut, and what
// makes a picture worse (members far or very near, steep views, a crossed line of action), costs a part of a
// second each. Of places that are worth about the same, that one is taken from which most is seen of what
// lies around the members, where their future is not known. While a member of the set is dead, the others
// count for less. Of less than all members only the next 1.2 s count: it is asked for where there is no
// better.
class ViewpointSearch {
  public:
    ViewpointSearch(const freespace::Space& space, const MapProfile& profile, const Members& members,
                    MemberSet set, const Standpoint& from, Outlook& outlook);

    // Of going on as it does.
    [[nodiscard]] float worth_of_going_on() const;

    // Likewise without any cut.
    [[nodiscard]] float worth_without_a_cut() const;

    // Whether it must cut sooner or later, and this cut is as good as a later one.
    [[nodiscard]] bool is_due(const Viewpoint& cut) const;

    // Whether all are shown for less time after a cut to the place than by going on.
    [[nodiscard]] bool loses_by_cutting_to(const Vec3f& place) const;

    // The best lookout to cut to, that shows the set now or, in a known future, within so many seconds.
    [[nodiscard]] std::optional<Viewpoint> cut(float within) const;

    // The best lookout to glide to, on a straight way that is free.
    [[nodiscard]] std::optional<Viewpoint> glide() const;

  private:
    template <class Value>
    using ByInstant = std::array<Value, Members::most>;
    enum class Approach { cut, glide };
    // What a lookout promises.
    struct Hope {
        float rank;  // its worth, less the cost of surroundings that it hides
        std::uint32_t lookout;
        float cost;
        float hidden_cost;
        Shows shows;
    };
    using Hopes = std::array<Hope, freespace::Lookouts::limit>;

    [[nodiscard]] static std::size_t instants_that_count(const Members& members, MemberSet set);
    [[nodiscard]] static bool is_asked_in_full(const Members& members, std::size_t instant);
    void look_around();
    void ask(Outlook& outlook);
    void ask_about_the_foreseen(Outlook& outlook);
    void ask_about_the_recorded(Outlook& outlook);
    [[nodiscard]] Shows shows_from(std::uint32_t lookout) const;
    // As if nothing were in its way.
    [[nodiscard]] Shows shows_along(Glide glide) const;
    [[nodiscard]] Shows shows_after_cut(const Hope& hope) const;
    [[nodiscard]] bool shows_at(const Vec3f& position, std::size_t instant) const;
    [[nodiscard]] freespace::Space at_instant(std::size_t instant) const;
    [[nodiscard]] float time_with_a_cut(Shows shows, float cut_in) const;
    [[nodiscard]] float picture_cost(const Vec3f& position) const;
    [[nodiscard]] float way_cost(Approach approach, const Vec3f& position) const;
    [[nodiscard]] std::optional<Viewpoint> find(Approach approach, Shows begins) const;
    [[nodiscard]] float shortest_stay(Approach approach) const;
    std::size_t collect(Approach approach, Shows begins, Hopes& hopes) const;
    [[nodiscard]] std::size_t first_shown(const Vec3f& position, Shows instants) const;
    [[nodiscard]] Glide way_to(Approach approach, const Vec3f& position) const;
    [[nodiscard]] bool can_glide(const Vec3f& position) const;

    const freespace::Space space_;
    const MapProfile& profile_;
    const PictureShape picture_;  // the part in which members count as shown
    const Members& members_;
    MemberSet set_;
    Standpoint from_;
    std::size_t known_;                            // instants that count
    std::size_t first_asked_ = 0;                  // of these: it stands for those before it
    ByInstant<freespace::Lookouts::Set> showing_;  // the lookouts that show the set
    ByInstant<float> weight_{};                    // s
    ByInstant<float> after_a_cut_{};               // the most time from this instant on, less the cuts' costs
    std::array<CutPlace, freespace::Lookouts::limit> candidates_;  // that show the set at some instant
    std::size_t candidate_count_ = 0;
    // By candidate, the share of what lies around the members that it sees; where their future is not known.
    std::array<float, freespace::Lookouts::limit> surroundings_seen_;
    Shows going_on_ = 0;  // of going on to the goal
};

}  // namespace camdir::camera
