#include "camera/group/outlook.hpp"

#include <algorithm>
#include <optional>

#include "freespace/space.hpp"

namespace camdir::camera {
namespace {

using Set = freespace::Lookouts::Set;

// Those of `among` that show the eyes.
Set look(const freespace::Freespace& freespace, const PictureShape& picture, std::span<const Vec3f> eyes,
         const Set& among) {
    const auto positions = freespace.lookouts().positions();
    std::array<freespace::RecentBalls, max_members> balls;
    const auto sees_all = [&](const Vec3f& position) {
        for (std::size_t i = 0; i < eyes.size(); ++i)
            if (!freespace::is_clear(freespace, eyes[i], position, 0.0F, balls[i])) return false;
        return true;
    };
    Set showing;
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        const Vec3f& position = positions[i];
        if (among.test(i) && (eyes.empty() || fits_one_picture(position, eyes, picture)) &&
            sees_all(position))
            showing.set(i);
    }
    return showing;
}

Set probably_seeing(const freespace::Freespace& freespace, std::span<const Vec3f> eyes) {
    Set probable;
    probable.set();
    for (const Vec3f& eye : eyes)
        probable &= freespace.lookouts().seeing(freespace, eye);
    return probable;
}

}  // namespace

bool Outlook::Answer::is_of(const PictureShape& asked_for, std::span<const Vec3f> asked, bool between) const {
    return count == asked.size() && is_between == between && picture == asked_for &&
           std::ranges::equal(asked, std::span(eyes).first(count));
}

template <class Look>
const Set& Outlook::recall(const PictureShape& picture, std::span<const Vec3f> eyes, std::size_t number,
                           bool between, const Look& look) {
    Answer& answer = answers_[number % remembered];
    if (answer.is_of(picture, eyes, between)) return answer.showing;
    answer.count = eyes.size();
    answer.picture = picture;
    answer.is_between = between;
    std::ranges::copy(eyes, answer.eyes.begin());
    answer.showing = look();
    return answer.showing;
}

const Set& Outlook::showing(const freespace::Freespace& freespace, const PictureShape& picture,
                            std::span<const Vec3f> eyes, std::size_t number) {
    return recall(picture, eyes, number, false,
                  [&] { return look(freespace, picture, eyes, probably_seeing(freespace, eyes)); });
}

const Set& Outlook::showing_between(const Set& before, const Set& after,
                                    const freespace::Freespace& freespace, const PictureShape& picture,
                                    std::span<const Vec3f> eyes, std::size_t number) {
    return recall(picture, eyes, number, true,
                  [&] { return (before & after) | look(freespace, picture, eyes, before ^ after); });
}

}  // namespace camdir::camera
