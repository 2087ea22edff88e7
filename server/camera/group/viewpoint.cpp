#include "camera/group/viewpoint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace camdir::camera {
namespace {

constexpr float safe_share = 0.895F;           // of the picture
constexpr std::size_t most_looked_at = 100;    // lookouts that are confirmed to show the set soon
constexpr std::size_t most_timed_sights = 32;  // lookouts that are confirmed for all instants
constexpr float longest_glide = 500.0F;        // units
constexpr float time_after_the_known = 0.6F;   // s
constexpr float far_enough_of_some = 1.2F;     // s
constexpr float worth_of_the_others = 0.3F;    // while a member is dead
constexpr std::size_t numbers_of_a_set = 26;   // more instants than far_enough_of_some has: see Outlook
constexpr float time_rounding = 1e-3F;         // s, of times
constexpr float surroundings = 200.0F;         // units: where members may go next, if that is not known
constexpr std::size_t most_surroundings = 48;  // lookouts that stand for them, the roomiest
constexpr float never = std::numeric_limits<float>::infinity();

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
constexpr float cost_of_hidden_surroundings = 0.09F;

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

// Of a recorded future, the last is one that is asked about in full.
std::size_t ViewpointSearch::instants_that_count(const Members& members, MemberSet set) {
    const std::size_t known =
        set == members.soon_living() ? members.known : members.until(far_enough_of_some);
    return members.is_recorded && !is_asked_in_full(members, known - 1) ? known - 1 : known;
}

// Directors' clocks differ by whole tenths of a second, so that they ask about the same instants.
bool ViewpointSearch::is_asked_in_full(const Members& members, std::size_t instant) {
    return (static_cast<std::size_t>(members.first) + instant) % 2 == 0;
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
      known_(instants_that_count(members, set)) {
    for (std::size_t i = 0; i < known_; ++i)
        weight_[i] = (i + 1 < known_ ? members.ahead[i + 1] - members.ahead[i] : time_after_the_known) *
                     ((members.at[i].living & set) == set ? 1.0F : worth_of_the_others);
    ask(outlook);
    if (!members.is_recorded) look_around();
    if (candidate_count_ > 0)
        plan_cuts(std::span(candidates_).first(candidate_count_), std::span(members.ahead).first(known_),
                  weight_, shortest_group_shot, after_a_cut_);
    going_on_ = shows_along(way_to(Approach::glide, from.goal));
}

void ViewpointSearch::ask(Outlook& outlook) {
    if (members_.is_recorded)
        ask_about_the_recorded(outlook);
    else
        ask_about_the_foreseen(outlook);
    freespace::Lookouts::Set any;
    for (std::size_t i = 0; i < known_; ++i)
        any |= showing_[i];
    const auto positions = space_.map().lookouts().positions();
    for (std::uint32_t i = 0; i < positions.size(); ++i)
        if (any.test(i))
            candidates_[candidate_count_++] = {
                i, shows_from(i), picture_cost(positions[i]) + way_cost(Approach::cut, positions[i])};
}

void ViewpointSearch::ask_about_the_foreseen(Outlook& outlook) {
    for (std::size_t i = 0; i < known_; ++i)
        showing_[i] = outlook.showing(space_.map(), picture_, Eyes(members_.at[i], set_).span(),
                                      set_ * numbers_of_a_set + i);
}

// From where more of what lies around the members is seen, they are longer shown, wherever they go. Of the
// candidates that show them now: no other is taken.
void ViewpointSearch::look_around() {
    std::size_t count = 0;
    std::array<std::uint16_t, freespace::Lookouts::limit> showing_now;
    for (std::size_t i = 0; i < candidate_count_; ++i) {
        surroundings_seen_[i] = 0.0F;
        if ((candidates_[i].shows & 1U) != 0) showing_now[count++] = static_cast<std::uint16_t>(i);
    }
    if (count == 0) return;
    const freespace::Lookouts& lookouts = space_.map().lookouts();
    const Eyes eyes(members_.at[known_ - 1], set_);
    for (const Vec3f& eye : eyes.span()) {
        const auto around = lookouts.around(space_.map(), eye, surroundings * profile_.unit);
        std::size_t left = std::min(around.count(), most_surroundings);
        const float share = 1.0F / static_cast<float>(std::max<std::size_t>(left, 1) * eyes.span().size());
        for (std::uint32_t place = 0; left > 0; ++place) {
            if (!around.test(place)) continue;
            --left;
            const auto& seeing = lookouts.seen_from(space_.map(), place);
            for (const std::uint16_t i : std::span(showing_now).first(count))
                surroundings_seen_[i] += seeing.test(candidates_[i].lookout) ? share : 0.0F;
        }
    }
}

// Every other instant is asked about in full, once, and those between for what these leave open.
void ViewpointSearch::ask_about_the_recorded(Outlook& outlook) {
    const std::size_t number = set_ * numbers_of_a_set + static_cast<std::size_t>(members_.first);
    first_asked_ = is_asked_in_full(members_, 1) ? 1 : 2;
    for (std::size_t i = first_asked_; i < known_; i += 2)
        showing_[i] = outlook.showing(space_.map(), picture_, Eyes(members_.at[i], set_).span(), number + i);
    for (std::size_t i = first_asked_ + 1; i < known_; i += 2)
        showing_[i] = outlook.showing_between(showing_[i - 1], showing_[i + 1], space_.map(), picture_,
                                              Eyes(members_.at[i], set_).span(), number + i);
    std::fill_n(showing_.begin(), first_asked_, showing_[first_asked_]);
}

Shows ViewpointSearch::shows_from(std::uint32_t lookout) const {
    Shows shows = 0;
    for (std::size_t i = 0; i < known_; ++i)
        if (showing_[i].test(lookout)) shows |= Shows{1} << i;
    return shows;
}

Shows ViewpointSearch::shows_along(Glide glide) const {
    Shows shows = 0;
    for (std::size_t i = 0; i < known_; ++i) {
        if (i > 0) glide = after(glide, members_.ahead[i] - members_.ahead[i - 1], profile_.unit);
        if (shows_at(glide.position, i)) shows |= Shows{1} << i;
    }
    return shows;
}

// What was answered about the instant itself holds, but for movers.
Shows ViewpointSearch::shows_after_cut(const Hope& hope) const {
    const Vec3f& position = space_.map().lookouts().positions()[hope.lookout];
    Shows shows = 0;
    for (std::size_t i = 0; i < known_; ++i) {
        const bool is_answered = i >= first_asked_ && !space_.has_movers();
        if (is_answered ? (hope.shows >> i & 1U) != 0 : shows_at(position, i)) shows |= Shows{1} << i;
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

float ViewpointSearch::time_with_a_cut(Shows shows, float cut_in) const {
    float until = 0.0F;
    float most = 0.0F;
    for (std::size_t i = 0; i < known_; ++i) {
        if (i > 0 && members_.ahead[i] >= cut_in) most = std::max(most, until + after_a_cut_[i]);
        if ((shows >> i & 1U) != 0) until += weight_[i];
    }
    return std::max(most, until);
}

float ViewpointSearch::worth_of_going_on() const {
    return time_with_a_cut(going_on_, from_.cut_in) - picture_cost(from_.goal);
}

float ViewpointSearch::worth_without_a_cut() const {
    return time_with_a_cut(going_on_, never) - picture_cost(from_.goal);
}

// The sooner a cut that must come is made, the sooner may the next one: that is worth a little of its
// pictures.
bool ViewpointSearch::is_due(const Viewpoint& cut) const {
    constexpr float worth_being_early = 0.03F;  // s
    constexpr float worth_a_cut = 0.01F;        // s
    return cut.worth + worth_being_early >= time_with_a_cut(going_on_, from_.cut_in) &&
           cut.worth > time_with_a_cut(going_on_, never) + worth_a_cut;
}

// What is foreseen from the place may come otherwise: a moment that needs another cut soon is not risked for
// it.
bool ViewpointSearch::loses_by_cutting_to(const Vec3f& place) const {
    const Shows after = shows_along(way_to(Approach::cut, place));
    const float at_most = std::min(time_with_a_cut(going_on_, shortest_group_shot),
                                   time_with_a_cut(after, shortest_group_shot));
    return at_most + time_rounding < time_with_a_cut(going_on_, from_.cut_in);
}

std::optional<Viewpoint> ViewpointSearch::cut(float within) const {
    return find(Approach::cut, members_.is_recorded ? (Shows{1} << members_.until(within)) - 1 : 1);
}

std::optional<Viewpoint> ViewpointSearch::glide() const {
    return find(Approach::glide, 1);
}

std::optional<Viewpoint> ViewpointSearch::find(Approach approach, Shows begins) const {
    Hopes hopes;
    const std::size_t count = collect(approach, begins, hopes);
    std::optional<Viewpoint> best;
    float best_rank = 0.0F;
    std::size_t timed = 0;
    for (std::size_t i = 0; i < std::min(count, most_looked_at) && timed < most_timed_sights; ++i) {
        const Hope& hope = hopes[i];
        if (best && hope.rank <= best_rank) break;
        const Vec3f& position = space_.map().lookouts().positions()[hope.lookout];
        const Shows unasked = (Shows{1} << first_asked_) - 1;
        const std::size_t first = first_shown(position, begins & (hope.shows | unasked));
        if (first == known_ || (approach == Approach::glide && !can_glide(position))) continue;
        ++timed;
        const auto look = look_at_all(position, Eyes(members_.at[first], set_).span(), picture_);
        const Shows shows =
            approach == Approach::cut ? shows_after_cut(hope) : shows_along(way_to(approach, position));
        const float worth = time_with_a_cut(shows, shortest_stay(approach)) - hope.cost;
        const float rank = worth - hope.hidden_cost;
        if (!look || (best && rank <= best_rank)) continue;
        best = Viewpoint{position, *look, set_, worth};
        best_rank = rank;
    }
    return best;
}

float ViewpointSearch::shortest_stay(Approach approach) const {
    return approach == Approach::cut ? shortest_group_shot : from_.cut_in;
}

// The best first.
std::size_t ViewpointSearch::collect(Approach approach, Shows begins, Hopes& hopes) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < candidate_count_; ++i) {
        const auto& [lookout, shows, cost_of_cut] = candidates_[i];
        const Vec3f& position = space_.map().lookouts().positions()[lookout];
        const bool too_far =
            approach == Approach::glide && (position - from_.position).norm() > longest_glide * profile_.unit;
        if ((shows & begins) == 0 || too_far) continue;
        const float cost =
            approach == Approach::cut ? cost_of_cut : picture_cost(position) + way_cost(approach, position);
        const float hidden =
            members_.is_recorded ? 0.0F : cost_of_hidden_surroundings * (1.0F - surroundings_seen_[i]);
        hopes[count++] = {time_with_a_cut(shows, shortest_stay(approach)) - cost - hidden, lookout, cost,
                          hidden, shows};
    }
    std::sort(hopes.begin(), hopes.begin() + static_cast<std::ptrdiff_t>(count),
              [](const Hope& a, const Hope& b) {
                  return a.rank != b.rank ? a.rank > b.rank : a.lookout < b.lookout;
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
