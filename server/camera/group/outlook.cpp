#include "camera/group/outlook.hpp"

#include <algorithm>
#include <cmath>

#include "freespace/visibility.hpp"

namespace camdir::camera {
namespace {

constexpr float widest_cosine = 0.17F;  // of the angle between two members that a picture can hold
constexpr float tallest_sine = 0.75F;   // likewise, of the difference of their elevations

using Set = freespace::Lookouts::Set;

Set probably_showing(const freespace::Freespace& freespace, std::span<const Vec3f> eyes) {
    const freespace::Lookouts& lookouts = freespace.lookouts();
    Set showing;
    showing.set();
    for (const Vec3f& eye : eyes)
        showing &= lookouts.seeing(freespace, eye);
    if (eyes.size() < 2) return showing;
    for (std::uint32_t i = 0; i < lookouts.positions().size(); ++i)
        if (showing.test(i) && !fits_one_picture(lookouts.positions()[i], eyes)) showing.reset(i);
    return showing;
}

void keep_those_that_see(const freespace::Freespace& freespace, const Vec3f& eye, Set& lookouts) {
    if (lookouts.none()) return;
    const freespace::SightOrigin origin(freespace, eye, 0.0F);
    const auto positions = freespace.lookouts().positions();
    for (std::uint32_t i = 0; i < positions.size(); ++i)
        if (lookouts.test(i) && !origin.to(positions[i]).clear) lookouts.reset(i);
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
    answer.showing = probably_showing(freespace, eyes);
    for (const Vec3f& eye : eyes)
        keep_those_that_see(freespace, eye, answer.showing);
    return answer.showing;
}

}  // namespace camdir::camera
