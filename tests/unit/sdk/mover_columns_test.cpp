#include "mover_columns.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "failure.hpp"

namespace camdir::sdk {
namespace {

constexpr float box[] = {1, 0, 0, 4, -1, 0, 0, 4, 0, 1, 0, 9, 0, -1, 0, 9, 0, 0, 1, 2, 0, 0, -1, 2};
constexpr std::uint32_t box_sizes[] = {6, 6};
constexpr float two_balls[] = {0, 0, 0, 1, 5, 6, 7, 8};

cdir_mover door(std::uint32_t id) {
    cdir_mover mover = cdir_mover_default();
    mover.id = id;
    std::strcpy(mover.model, "*3");
    std::strcpy(mover.kind, "func_door");
    return mover;
}

cdir_mover cart(std::uint32_t id) {
    cdir_mover mover = cdir_mover_default();
    mover.id = id;
    mover.half_spaces = box;
    mover.hull_sizes = box_sizes;
    mover.hull_count = 1;
    mover.balls = two_balls;
    mover.ball_count = 2;
    return mover;
}

TEST(MoverColumns, AreTheMoversInOrder) {
    const cdir_mover movers[] = {door(5), cart(4), cart(9)};
    const MoverColumns columns(movers);
    const camera_director_MoverInfo sample = columns.sample();
    ASSERT_EQ(sample.mover_id._length, 3U);
    EXPECT_EQ(sample.mover_id._buffer[1], 4U);
    EXPECT_STREQ(sample.model._buffer[0], "*3");
    EXPECT_STREQ(sample.kind._buffer[0], "func_door");
    EXPECT_STREQ(sample.model._buffer[2], "");
    EXPECT_EQ(sample.hulls._buffer[0], 0U);
    EXPECT_EQ(sample.hulls._buffer[2], 1U);
    ASSERT_EQ(sample.half_spaces._length, 2U);
    EXPECT_EQ(sample.half_spaces._buffer[1], 6U);
    ASSERT_EQ(sample.planes._length, 48U);
    EXPECT_EQ(sample.planes._buffer[24 + 11], 9.0F);
    EXPECT_EQ(sample.balls._buffer[1], 2U);
    ASSERT_EQ(sample.spheres._length, 16U);
    EXPECT_EQ(sample.spheres._buffer[15], 8.0F);
}

TEST(MoverColumns, OfNoMoversAreEmpty) {
    EXPECT_EQ(MoverColumns({}).sample().mover_id._length, 0U);
}

template <class Spoil>
std::string refusal_of(const Spoil& spoil) {
    cdir_mover movers[] = {door(5), cart(4)};
    spoil(movers[1]);
    try {
        const MoverColumns columns(movers);
        return "";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.status, CDIR_INVALID_ARGUMENT);
        return failure.text;
    }
}

TEST(MoverColumns, RefuseWhatIsOutOfItsRange) {
    EXPECT_EQ(refusal_of([](cdir_mover&) {}), "");
    EXPECT_EQ(refusal_of([](cdir_mover& mover) { mover.id = 5; }),
              "mover 5: an earlier mover has the same id");
    EXPECT_EQ(refusal_of([](cdir_mover& mover) { std::memset(mover.model, 'x', sizeof mover.model); }),
              "mover 4: model must have 0 to 63 bytes before its zero byte");
    EXPECT_EQ(refusal_of([](cdir_mover& mover) { mover.hull_count = 257; }),
              "mover 4: hull_count is greater than CDIR_MAX_HULLS");
    EXPECT_EQ(refusal_of([](cdir_mover& mover) { mover.half_spaces = nullptr; }),
              "mover 4: hull_sizes or half_spaces is null");
    static constexpr std::uint32_t three[] = {3};
    EXPECT_EQ(refusal_of([](cdir_mover& mover) { mover.hull_sizes = three; }),
              "mover 4: one of hull_sizes is not 4 to CDIR_MAX_HALF_SPACES");
    static constexpr float skewed[24] = {1, 1};
    EXPECT_EQ(refusal_of([](cdir_mover& mover) { mover.half_spaces = skewed; }),
              "mover 4: a normal of half_spaces is not of length 1");
    EXPECT_EQ(refusal_of([](cdir_mover& mover) { mover.balls = nullptr; }), "mover 4: balls is null");
    static constexpr float point[] = {0, 0, 0, 1, 0, 0, 0, 0};
    EXPECT_EQ(refusal_of([](cdir_mover& mover) { mover.balls = point; }),
              "mover 4: the radius of a ball is not greater than 0");
}

TEST(MoverColumns, RefuseMoreShapesThanAMatchMayHave) {
    static const std::vector<float> spheres(4 * 256, 1.0F);
    std::vector<cdir_mover> movers;
    for (std::uint32_t id = 0; id < 8; ++id) {
        movers.push_back(cdir_mover_default());
        movers.back().id = id;
        movers.back().balls = spheres.data();
        movers.back().ball_count = 256;
    }
    EXPECT_EQ(MoverColumns(movers).sample().spheres._length, 4U * CDIR_MAX_SHAPES);
    movers.push_back(cart(9));
    EXPECT_THROW(MoverColumns{movers}, Failure);
}

}  // namespace
}  // namespace camdir::sdk
