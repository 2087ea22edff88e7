#include "camera/group/outlook.hpp"

#include <algorithm>
#include <optional>

#include "freespace/space.hpp"

namespace camdir::camera {
namespace {

using Set = freespace::Lookouts::Set;

Set look(const freespace::Freespace& freespace, const PictureShape& picture, std::span<const Vec3f> eyes) {
    const freespace::Lookouts& lookouts = freespace.lookouts();
    Set probable;
    probable.set();
    std::array<freespace::RecentBalls, max_members> balls;
    for (const Vec3f& eye : eyes)
        probable &= lookouts.seeing(freespace, eye);
    const auto sees_all = [&](const Vec3f& position) {
        for (std::size_t i = 0; i < eyes.size(); ++i)
            if (!freespace::is_clear(freespace, eyes[i], position, 0.0F, balls[i])) return false;
        return true;
    };
    Set showing;
    for (std::uint32_t i = 0; i < lookouts.positions().size(); ++i) {
        const Vec3f& position = lookouts.positions()[i];
        if (probable.test(i) && (eyes.empty() || fits_one_picture(position, eyes, picture)) &&
            sees_all(position))
            showing.set(i);
    }
    return showing;
}

}  // namespace

bool Outlook::Answer::is_of(const PictureShape& asked_for, std::span<const Vec3f> asked) const {
    return count == asked.size() && picture == asked_for &&
           std::ranges::equal(asked, std::span(eyes).first(count));
}

const Set& Outlook::showing(const freespace::Freespace& freespace, const PictureShape& picture,
                            std::span<const Vec3f> eyes, std::size_t number) {
    Answer& answer = answers_[number % remembered];
    if (answer.is_of(picture, eyes)) return answer.showing;
    answer.count = eyes.size();
    answer.picture = picture;
    std::ranges::copy(eyes, answer.eyes.begin());
    answer.showing = look(freespace, picture, eyes);
    return answer.showing;
}

}  // namespace camdir::camera
