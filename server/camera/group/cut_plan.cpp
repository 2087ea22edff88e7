#include "camera/group/cut_plan.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

#include "freespace/lookouts.hpp"

namespace camdir::camera {
namespace {

constexpr float rounding = 1e-3F;  // s, of times

// The first instant at which a shot that begins at `begin` may end; as many as there are where it may not.
std::size_t first_end(std::span<const float> times, std::size_t begin, float shortest) {
    const auto end = std::lower_bound(times.begin() + static_cast<std::ptrdiff_t>(begin), times.end(),
                                      times[begin] + shortest - rounding);
    return static_cast<std::size_t>(end - times.begin());
}

}  // namespace

void plan_cuts(std::span<const CutPlace> places, std::span<const float> times, std::span<const float> weights,
               float shortest, std::span<float> best) {
    assert(places.size() <= freespace::Lookouts::limit && times.size() <= Members::most);
    // From the instant on at which a cut is made to the place: what is shown until it may end, and the most
    // that is shown with the cuts after it.
    struct FromPlace {
        float until_end = 0.0F;
        float in_all = 0.0F;
    };
    std::array<FromPlace, freespace::Lookouts::limit> from;
    std::fill_n(from.begin(), places.size(), FromPlace{});
    std::size_t end_after = times.size();  // of a shot that begins an instant later
    for (std::size_t begin = times.size(); begin-- > 0;) {
        const std::size_t end = first_end(times, begin, shortest);
        const auto shown = [&](const CutPlace& place, std::size_t instant) {
            return (place.shows >> instant & 1U) != 0 ? weights[instant] : 0.0F;
        };
        best[begin] = -std::numeric_limits<float>::infinity();
        for (std::size_t i = 0; i < places.size(); ++i) {
            const float now = shown(places[i], begin);
            float until = from[i].until_end + now;
            float most = from[i].in_all + now;
            for (std::size_t later = end_after; later-- > end;) {
                until -= shown(places[i], later);
                most = std::max(most, until + best[later]);
            }
            from[i] = {until, most};
            best[begin] = std::max(best[begin], most - places[i].cost);
        }
        end_after = end;
    }
}

}  // namespace camdir::camera
