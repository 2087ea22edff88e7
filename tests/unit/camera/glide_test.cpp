#include "camera/group/glide.hpp"

#include <gtest/gtest.h>

namespace camdir::camera {
namespace {

TEST(Glide, ArrivesAtItsGoalAndRests) {
    const Glide begun{Vec3f::Zero(), {0.0F, 120.0F, 0.0F}, {400.0F, 0.0F, 50.0F}};
    const Glide later = after(begun, 6.0F, 1.0F);
    EXPECT_TRUE(later.rests(1.0F));
    EXPECT_LT((later.position - begun.goal).norm(), 0.01F);
}

TEST(Glide, IsNeverFasterThanItMay) {
    Glide glide{Vec3f::Zero(), Vec3f::Zero(), {5000.0F, 0.0F, 0.0F}};
    for (int step = 0; step < 600; ++step) {
        glide = after(glide, 1.0F / 60.0F, 2.0F);
        EXPECT_LE(glide.velocity.norm(), 700.1F);
    }
    EXPECT_GT(glide.position.x(), 4900.0F);
}

TEST(Glide, IsForeseenAsItComes) {
    const Glide begun{Vec3f::Zero(), {-100.0F, 0.0F, 0.0F}, {300.0F, 80.0F, 0.0F}};
    Glide glide = begun;
    for (int step = 0; step < 60; ++step) {
        glide.velocity = glide.velocity_after(1.0F / 60.0F, 1.0F);
        glide.position += glide.velocity / 60.0F;
        EXPECT_LT((after(begun, static_cast<float>(step + 1) / 60.0F, 1.0F).position - glide.position).norm(),
                  8.0F);
    }
}

TEST(Glide, StaysWhereItRests) {
    const Vec3f place(1.0F, 2.0F, 3.0F);
    EXPECT_EQ(after({place, Vec3f::Zero(), place}, 2.0F, 1.0F).position, place);
}

}  // namespace
}  // namespace camdir::camera
