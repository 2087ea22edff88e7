#include "camera/group/outlook.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "freespace/visibility.hpp"
#include "walk.hpp"

namespace camdir::camera {
namespace {

class OutlookTest : public testing::Test {
  protected:
    std::vector<Vec3f> random_eyes(std::size_t count) {
        std::vector<Vec3f> eyes;
        for (std::size_t i = 0; i < count; ++i) {
            const auto positions = freespace_.lookouts().positions();
            eyes.push_back(positions[random_() % positions.size()] + Vec3f(3.0F, -2.0F, 1.0F));
        }
        return eyes;
    }

    const test::Plan plan_ = test::figure_eight();
    const freespace::Freespace freespace_ = plan_.freespace();
    const PictureShape picture_ = PictureShape::of(1.0F, 0.9F);
    std::mt19937 random_{3};
    Outlook outlook_;
};

TEST_F(OutlookTest, NamesLookoutsThatSeeAllEyesInOnePicture) {
    const auto positions = freespace_.lookouts().positions();
    std::size_t named = 0;
    for (std::size_t i = 0; i < 200; ++i) {
        const auto eyes = random_eyes(1 + i % max_members);
        const auto& showing = outlook_.showing(freespace_, picture_, eyes, i);
        for (std::uint32_t lookout = 0; lookout < positions.size(); ++lookout) {
            if (!showing.test(lookout)) continue;
            ++named;
            EXPECT_TRUE(look_at_all(positions[lookout], eyes, picture_));
            for (const Vec3f& eye : eyes)
                EXPECT_TRUE(plan_.segment_clear(positions[lookout], eye));
        }
    }
    EXPECT_GT(named, 1000U);
}

TEST_F(OutlookTest, LeavesHardlyOneOutThatSeesThemAll) {
    const auto positions = freespace_.lookouts().positions();
    std::size_t seeing = 0, named = 0;
    for (std::size_t i = 0; i < 200; ++i) {
        const auto eyes = random_eyes(1 + i % max_members);
        const auto& showing = outlook_.showing(freespace_, picture_, eyes, i);
        for (std::uint32_t lookout = 0; lookout < positions.size(); ++lookout) {
            const bool sees_all = std::ranges::all_of(eyes, [&](const Vec3f& eye) {
                return freespace::sight(freespace_, eye, positions[lookout]).clear;
            });
            if (!sees_all || !look_at_all(positions[lookout], eyes, picture_)) continue;
            ++seeing;
            named += showing.test(lookout) ? 1 : 0;
        }
    }
    EXPECT_GT(seeing, 1000U);
    EXPECT_GE(static_cast<double>(named), 0.98 * static_cast<double>(seeing));
}

TEST_F(OutlookTest, KnowsOnePictureFromAnother) {
    const PictureShape narrow = PictureShape::of(0.2F, 0.9F);
    const auto eyes = random_eyes(2);
    const auto wide = outlook_.showing(freespace_, picture_, eyes, 0);
    EXPECT_LT(outlook_.showing(freespace_, narrow, eyes, 0).count(), wide.count());
    EXPECT_EQ(outlook_.showing(freespace_, picture_, eyes, 0), wide);
}

TEST_F(OutlookTest, AnswersTheSameWhateverItRemembers) {
    for (std::size_t i = 0; i < 300; ++i) {
        const std::size_t number = random_() % 80;
        const auto eyes = random_eyes(1 + random_() % 3);
        const auto answer = outlook_.showing(freespace_, picture_, eyes, number);
        EXPECT_EQ(outlook_.showing(freespace_, picture_, eyes, number), answer);
        Outlook fresh;
        EXPECT_EQ(fresh.showing(freespace_, picture_, eyes, 0), answer);
        const auto fewer = std::span(eyes).first(eyes.size() - 1);
        EXPECT_EQ(outlook_.showing(freespace_, picture_, fewer, number),
                  fresh.showing(freespace_, picture_, fewer, 1));
    }
}

TEST_F(OutlookTest, LooksBetweenTwoInstantsOnlyWhereTheyDiffer) {
    std::size_t open = 0, found = 0, left_out = 0;
    for (std::size_t i = 0; i < 200; ++i) {
        const auto eye = random_eyes(1)[0];
        const auto with_another = [&] { return std::vector<Vec3f>{eye, random_eyes(1)[0]}; };
        const auto before = outlook_.showing(freespace_, picture_, with_another(), 3 * i);
        const auto after = outlook_.showing(freespace_, picture_, with_another(), 3 * i + 2);
        const auto eyes = with_another();
        const auto full = outlook_.showing(freespace_, picture_, eyes, 3 * i + 1);
        const auto between = outlook_.showing_between(before, after, freespace_, picture_, eyes, 3 * i + 1);
        EXPECT_TRUE((~between & before & after).none());
        EXPECT_TRUE((between & ~(before | after)).none());
        const auto positions = freespace_.lookouts().positions();
        for (std::uint32_t lookout = 0; lookout < positions.size(); ++lookout)
            EXPECT_TRUE(!(between & (before ^ after)).test(lookout) ||
                        std::ranges::all_of(eyes, [&](const Vec3f& seen) {
                            return plan_.segment_clear(positions[lookout], seen);
                        }));
        EXPECT_EQ(outlook_.showing(freespace_, picture_, eyes, 3 * i + 1), full);
        open += (full & (before ^ after)).count();
        found += (full & between & (before ^ after)).count();
        left_out += (full & ~(before | after)).count();
    }
    EXPECT_GT(open, 1000U);
    EXPECT_GE(static_cast<double>(found), 0.98 * static_cast<double>(open));  // sights are not always proved
    EXPECT_GT(left_out, 1000U);
}

TEST_F(OutlookTest, NamesAllLookoutsWhereNobodyIsToBeShown) {
    EXPECT_EQ(outlook_.showing(freespace_, picture_, {}, 0).count(),
              freespace_.lookouts().positions().size());
}

}  // namespace
}  // namespace camdir::camera
