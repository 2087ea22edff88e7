#include "camera/group/outlook.hpp"

#include <gtest/gtest.h>

#include <random>

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
    std::mt19937 random_{3};
    Outlook outlook_;
};

TEST_F(OutlookTest, NamesLookoutsThatSeeAllEyesInOnePicture) {
    const auto positions = freespace_.lookouts().positions();
    std::size_t named = 0;
    for (std::size_t i = 0; i < 200; ++i) {
        const auto eyes = random_eyes(1 + i % max_members);
        const auto& showing = outlook_.showing(freespace_, eyes, i);
        for (std::uint32_t lookout = 0; lookout < positions.size(); ++lookout) {
            if (!showing.test(lookout)) continue;
            ++named;
            EXPECT_TRUE(fits_one_picture(positions[lookout], eyes));
            for (const Vec3f& eye : eyes)
                EXPECT_TRUE(plan_.segment_clear(positions[lookout], eye));
        }
    }
    EXPECT_GT(named, 1000U);
}

TEST_F(OutlookTest, AnswersTheSameWhateverItRemembers) {
    for (std::size_t i = 0; i < 300; ++i) {
        const std::size_t number = random_() % 80;
        const auto eyes = random_eyes(1 + random_() % 3);
        const auto answer = outlook_.showing(freespace_, eyes, number);
        EXPECT_EQ(outlook_.showing(freespace_, eyes, number), answer);
        Outlook fresh;
        EXPECT_EQ(fresh.showing(freespace_, eyes, 0), answer);
        const auto fewer = std::span(eyes).first(eyes.size() - 1);
        EXPECT_EQ(outlook_.showing(freespace_, fewer, number), fresh.showing(freespace_, fewer, 1));
    }
}

TEST_F(OutlookTest, NamesAllLookoutsWhereNobodyIsToBeShown) {
    EXPECT_EQ(outlook_.showing(freespace_, {}, 0).count(), freespace_.lookouts().positions().size());
}

TEST(Picture, HoldsEyesThatAreNotTooFarApart) {
    const Vec3f together[] = {{100.0F, 0.0F, 0.0F}, {60.0F, 60.0F, 20.0F}};
    EXPECT_TRUE(fits_one_picture(Vec3f::Zero(), together));
    const Vec3f aside[] = {{100.0F, 0.0F, 0.0F}, {0.0F, 100.0F, 0.0F}};
    EXPECT_FALSE(fits_one_picture(Vec3f::Zero(), aside));
    const Vec3f above[] = {{100.0F, 0.0F, 0.0F}, {20.0F, 0.0F, 100.0F}};
    EXPECT_FALSE(fits_one_picture(Vec3f::Zero(), above));
    EXPECT_TRUE(fits_one_picture(Vec3f::Zero(), std::span(aside).first(1)));
}

}  // namespace
}  // namespace camdir::camera
