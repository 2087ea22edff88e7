#include "camera/group/outlook.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "freespace/visibility.hpp"

namespace camdir::camera {
namespace {

constexpr float widest_cosine = 0.17F;  // of the angle between two members that a picture can hold
constexpr float tallest_sine = 0.75F;   // likewise, of the difference of their elevations

using Set = freespace::Lookouts::Set;

Set look(const freespace::Freespace& freespace, std::span<const Vec3f> eyes) {
    const freespace::Lookouts& lookouts = freespace.lookouts();
    Set probable;
    probable.set();
    std::array<std::optional<freespace::SightOrigin>, max_members> origins;
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        probable &= lookouts.seeing(freespace, eyes[i]);
        origins[i].emplace(freespace, eyes[i], 0.0F);
    }
    Set showing;
    for (std::uint32_t i = 0; i < lookouts.positions().size(); ++i) {
        const Vec3f& position = lookouts.positions()[i];
        if (probable.test(i) && fits_one_picture(position, eyes) &&
            std::ranges::all_of(std::span(origins).first(eyes.size()),
                                [&](const auto& origin) { return origin->to(position).clear; }))
            showing.set(i);
    }
    return showing;
}

}  // namespace

bool fits_one_picture(const Vec3f& position, std::span<const Vec3f> eyes) {
    std::array<Vec3f, max_members> directions;
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        directions[i] = (eyes[i] - position).normalized();
        for (std::size_t j = 0; j < i; ++j)
            if (directions[i].dot(directions[j]) < widest_cosine ||
                std::abs(directions[i].z() - directions[j].z()) > tallest_sine)
                return false;
    }
    return true;
}

bool Outlook::Answer::is_of(std::span<const Vec3f> asked) const {
    return count == asked.size() && std::ranges::equal(asked, std::span(eyes).first(count));
}

const Set& Outlook::showing(const freespace::Freespace& freespace, std::span<const Vec3f> eyes,
                            std::size_t number) {
    Answer& answer = answers_[number % remembered];
    if (answer.is_of(eyes)) return answer.showing;
    answer.count = eyes.size();
    std::ranges::copy(eyes, answer.eyes.begin());
    answer.showing = look(freespace, eyes);
    return answer.showing;
}

}  // namespace camdir::camera
