#include "camera/group/viewpoint.hpp"

#include <algorithm>
#include <cmath>

namespace camdir::camera {
namespace {

constexpr float safe_share = 0.895F;           // of the picture
constexpr std::size_t most_looked_at = 100;    // lookouts that are confirmed for now
constexpr std::size_t most_timed_sights = 32;  // lookouts that are confirmed for all instants
constexpr float longest_glide = 500.0F;        // units
constexpr float time_after_the_known = 0.6F;   // s
constexpr float far_enough_of_some = 0.6F;     // s
constexpr float worth_of_the_others = 0.3F;    // while a member is dead
constexpr std::size_t numbers_of_a_set = 7;    // spreads sets over what an outlook remembers

constexpr Shows within_a_moment = 7;  // 0.1 to 0.2 s

// Costs, s.
constexpr float cost_of_a_cut = 0.01F;
constexpr float far_away = 350.0F;  // units: farther members are small in the picture
constexpr float cost_of_twice_as_far = 0.03F;
constexpr float too_near = 90.0F;  // nearer members fill the picture and turn the camera
constexpr float cost_of_touching = 0.15F;
constexpr float steep_slope = 0.6F;  // sine: steeper views from above or below
constexpr float cost_of_steepness = 0.15F;
constexpr float cost_of_crossing = 0.1F;  // of a cut over the line of action
constexpr float cost_of_jump = 0.02F;     // of a cut to nearly the same picture
constexpr float same_place = 120.0F;      // units
constexpr float cost_of_longest_glide = 0.2F;

}  // namespace

PictureShape safe_area(const MapProfile& profile) {
    return PictureShape::of(profile.vertical_fov, safe_share);
}

float side_of(const Members::Instant& members, const Vec3f& position) {
    const Eyes eyes(members, members.living);
    if (eyes.span().size() != 2) return 0.0F;
    const Vec3f line = eyes.span()[1] - eyes.span()[0];
    return line.cross(position - eyes.span()[0]).z();
}

MemberSet seen_from(const freespace::Space& space, const Vec3f& position, const Members::Instant& members) {
    const freespace::SightOrigin origin(space.map(), position, 0.0F);
    MemberSet seen = 0;
    for (std::size_t member = 0; member < max_members; ++member)
        if ((members.living & only(member)) != 0 && origin.to(members.eyes[member]).clear &&
            space.mover_sweep(position, members.eyes[member], 0.0F).clear)
            seen |= only(member);
    return seen;
}

// Who dies or leaves meanwhile need not be seen then.
ViewpointSearch::ViewpointSearch(const freespace::Space& space, const MapProfile& profile,
                                 const Members& members, MemberSet set, const Standpoint& from,
                                 Outlook& outlook)
    : space_(space),
      profile_(profile),
      picture_(safe_area(profile)),
      members_(members),
      set_(set),
      from_(from),
      known_(set == members.soon_living() ? members.known : members.until(far_enough_of_some)) {
    for (std::size_t i = 0; i < known_; ++i)
        weight_[i] = (i + 1 < known_ ? members.ahead[i + 1] - members.ahead[i] : time_after_the_known) *
                     ((members.at[i].living & set) == set ? 1.0F : worth_of_the_others);
    ask(outlook);
    if (candidate_count_ > 0)
        plan_cuts(std::span(candidates_).first(candidate_count_), std::span(members.ahead).first(known_),
                  weight_, shortest_group_shot, after_a_cut_);
}

// What is recorded of the next tenth of a second stands for now, so that every instant is asked about once.
void ViewpointSearch::ask(Outlook& outlook) {
    const bool now_as_soon = members_.is_recorded && known_ > 1;
    freespace::Lookouts::Set any;
    for (std::size_t i = now_as_soon ? 1 : 0; i < known_; ++i) {
        const Eyes eyes(members_.at[i], set_);
        const std::size_t number = members_.is_recorded ? static_cast<std::size_t>(members_.first) + i : i;
        showing_[i] = outlook.showing(space_.map(), picture_, eyes.span(), set_ * numbers_of_a_set + number);
        any |= showing_[i];
    }
    if (now_as_soon) showing_[0] = showing_[1];
    const auto positions = space_.map().lookouts().positions();
    for (std::uint32_t i = 0; i < positions.size(); ++i)
        if (any.test(i))
            candidates_[candidate_count_++] = {
                i, shows_from(i), picture_cost(positions[i]) + way_cost(Approach::cut, positions[i])};
}

Shows ViewpointSearch::shows_from(std::uint32_t lookout) const {
    Shows shows = 0;
    for (std::size_t i = 0; i < known_; ++i)
        if (showing_[i].test(lookout)) shows |= 1U << i;
    return shows;
}

Shows ViewpointSearch::shows_along(Glide glide) const {
    Shows shows = 0;
    for (std::size_t i = 0; i < known_; ++i) {
        if (i > 0) glide = after(glide, members_.ahead[i] - members_.ahead[i - 1], profile_.unit);
        if (shows_at(glide.position, i)) shows |= 1U << i;
    }
    return shows;
}

bool ViewpointSearch::shows_at(const Vec3f& position, std::size_t instant) const {
    const MemberSet wanted = set_ & members_.at[instant].living;
    const Eyes eyes(members_.at[instant], set_);
    return (wanted == 0 || fits_one_picture(position, eyes.span(), picture_)) &&
           (seen_from(at_instant(instant), position, members_.at[instant]) & wanted) == wanted;
}

freespace::Space ViewpointSearch::at_instant(std::size_t instant) const {
    return space_.at(space_.time() + static_cast<double>(members_.ahead[instant]));
}

float ViewpointSearch::time_of(Shows shows, std::size_t first, std::size_t end) const {
    float time = 0.0F;
    for (std::size_t i = first; i < end; ++i)
        if ((shows >> i & 1U) != 0) time += weight_[i];
    return time;
}

float ViewpointSearch::time_with_a_cut(Shows shows, float cut_in) const {
    float most = time_of(shows, 0, known_);
    for (std::size_t i = 1; i < known_; ++i)
        if (members_.ahead[i] >= cut_in) most = std::max(most, time_of(shows, 0, i) + after_a_cut_[i]);
    return most;
}

float ViewpointSearch::worth_of_going_on(const Vec3f& goal) const {
    return time_with_a_cut(shows_along(way_to(Approach::glide, goal)), from_.cut_in) - picture_cost(goal);
}

// What is foreseen from the place may come otherwise: a moment that needs another cut soon is not risked for
// it.
bool ViewpointSearch::loses_by_cutting_to(const Vec3f& place, const Vec3f& goal) const {
    constexpr float rounding = 1e-3F;  // s
    const Shows stays = shows_along(way_to(Approach::glide, goal));
    const Shows after = shows_along(way_to(Approach::cut, place));
    const float at_most =
        std::min(time_with_a_cut(stays, shortest_group_shot), time_with_a_cut(after, shortest_group_shot));
    return at_most + rounding < time_with_a_cut(stays, from_.cut_in);
}

std::optional<Viewpoint> ViewpointSearch::cut() const {
    return find(Approach::cut);
}

std::optional<Viewpoint> ViewpointSearch::glide() const {
    return find(Approach::glide);
}

std::optional<Viewpoint> ViewpointSearch::find(Approach approach) const {
    Hopes hopes;
    const Shows begins = beginnings(approach);
    const std::size_t count = collect(approach, begins, hopes);
    std::optional<Viewpoint> best;
    std::size_t timed = 0;
    for (std::size_t i = 0; i < std::min(count, most_looked_at) && timed < most_timed_sights; ++i) {
        const Hope& hope = hopes[i];
        if (best && hope.worth <= best->worth) break;
        const Vec3f& position = space_.map().lookouts().positions()[hope.lookout];
        const std::size_t first = first_shown(position, begins);
        if (first == known_ || (approach == Approach::glide && !can_glide(position))) continue;
        ++timed;
        const auto look = look_at_all(position, Eyes(members_.at[first], set_).span(), picture_);
        const Shows shows = shows_along(way_to(approach, position));
        const float worth = time_with_a_cut(shows, shortest_stay(approach)) - hope.cost;
        if (look && (!best || worth > best->worth)) best = Viewpoint{position, *look, set_, worth};
    }
    return best;
}

// A cut may come a moment before the set is shown, when that is known.
Shows ViewpointSearch::beginnings(Approach approach) const {
    return approach == Approach::cut && members_.is_recorded ? within_a_moment : 1U;
}

float ViewpointSearch::shortest_stay(Approach approach) const {
    return approach == Approach::cut ? shortest_group_shot : from_.cut_in;
}

// The best first.
std::size_t ViewpointSearch::collect(Approach approach, Shows begins, Hopes& hopes) const {
    std::size_t count = 0;
    for (const auto& [lookout, shows, cost_of_cut] : std::span(candidates_).first(candidate_count_)) {
        const Vec3f& position = space_.map().lookouts().positions()[lookout];
        const bool too_far =
            approach == Approach::glide && (position - from_.position).norm() > longest_glide * profile_.unit;
        if ((shows & begins) == 0 || too_far) continue;
        const float cost =
            approach == Approach::cut ? cost_of_cut : picture_cost(position) + way_cost(approach, position);
        hopes[count++] = {time_with_a_cut(shows, shortest_stay(approach)) - cost, lookout, cost};
    }
    std::sort(hopes.begin(), hopes.begin() + static_cast<std::ptrdiff_t>(count),
              [](const Hope& a, const Hope& b) {
                  return a.worth != b.worth ? a.worth > b.worth : a.lookout < b.lookout;
              });
    return count;
}

// The first of these instants at which sights show the set from the position; known_: none.
std::size_t ViewpointSearch::first_shown(const Vec3f& position, Shows instants) const {
    for (std::size_t i = 0; i < known_; ++i)
        if ((instants >> i & 1U) != 0 && shows_at(position, i)) return i;
    return known_;
}

Glide ViewpointSearch::way_to(Approach approach, const Vec3f& position) const {
    if (approach == Approach::cut) return {position, Vec3f::Zero(), position};
    return {from_.position, from_.velocity, position};
}

bool ViewpointSearch::can_glide(const Vec3f& position) const {
    const float radius = profile_.minimum_clearance;
    return freespace::sight(space_, from_.position, position, radius).clear;
}

float ViewpointSearch::picture_cost(const Vec3f& position) const {
    const Eyes eyes(members_.now(), set_);
    float cost = 0.0F;
    float furthest = 0.0F;
    for (const Vec3f& eye : eyes.span()) {
        const Vec3f way = eye - position;
        const float distance = way.norm();
        furthest = std::max(furthest, distance);
        cost += cost_of_touching * std::max(1.0F - distance / (too_near * profile_.unit), 0.0F);
        const float slope = std::abs(way.z()) / std::max(distance, profile_.unit);
        cost += cost_of_steepness * std::max(slope - steep_slope, 0.0F);
    }
    return cost + cost_of_twice_as_far * std::log2(std::max(furthest / (far_away * profile_.unit), 1.0F));
}

float ViewpointSearch::way_cost(Approach approach, const Vec3f& position) const {
    const float way = (position - from_.position).norm();
    if (approach == Approach::glide) return cost_of_longest_glide * way / (longest_glide * profile_.unit);
    const bool crosses = from_.side * side_of(members_.now(), position) < 0.0F;
    return cost_of_a_cut + (crosses ? cost_of_crossing : 0.0F) +
           (way < same_place * profile_.unit ? cost_of_jump : 0.0F);
}

}  // namespace camdir::camera
