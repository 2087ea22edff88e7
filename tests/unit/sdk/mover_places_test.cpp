#include "mover_places.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "failure.hpp"

namespace camdir::sdk {
namespace {

// A frame of unrotated movers.
class MoverFrameArrays {
  public:
    void add(std::uint32_t id, float x) {
        ids_.push_back(id);
        positions_.insert(positions_.end(), {x, 0.0F, 0.0F});
        orientations_.insert(orientations_.end(), {0.0F, 0.0F, 0.0F, 1.0F});
    }
    [[nodiscard]] cdir_mover_frame get() const {
        cdir_mover_frame frame = cdir_mover_frame_default();
        frame.mover_count = static_cast<std::uint32_t>(ids_.size());
        frame.mover_id = ids_.data();
        frame.position = positions_.data();
        frame.orientation = orientations_.data();
        return frame;
    }

    std::vector<float> positions_, orientations_;

  private:
    std::vector<std::uint32_t> ids_;
};

MoverFrameArrays movers_at(const std::vector<std::pair<std::uint32_t, float>>& movers) {
    MoverFrameArrays frame;
    for (const auto& [id, x] : movers)
        frame.add(id, x);
    return frame;
}

class MoverPlacesTest : public testing::Test {
  protected:
    void SetUp() override { know({1, 2, 3}); }
    void know(const std::vector<std::uint32_t>& ids) { places_.set_known(ids); }
    // Whether something has moved since the call before.
    bool moves(const std::vector<std::pair<std::uint32_t, float>>& movers) {
        places_.move(movers_at(movers).get());
        const bool have_moved = places_.have_moved();
        places_.forget_moves();
        return have_moved;
    }
    [[nodiscard]] std::string refusal(const cdir_mover_frame& frame) {
        try {
            places_.move(frame);
            return "";
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.status, CDIR_INVALID_ARGUMENT);
            return failure.text;
        }
    }
    // "id x" of each.
    [[nodiscard]] std::string all() const {
        const camera_director_MoverFrame sample = places_.sample();
        std::string text;
        for (std::uint32_t i = 0; i < sample.mover_id._length; ++i)
            text += std::to_string(sample.mover_id._buffer[i]) + " " +
                    std::to_string(std::lround(sample.position._buffer[3 * i])) + ", ";
        EXPECT_EQ(sample.position._length, 3 * sample.mover_id._length);
        EXPECT_EQ(sample.orientation._length, 4 * sample.mover_id._length);
        return text;
    }

    MoverPlaces places_;
};

TEST_F(MoverPlacesTest, PutFramesTogetherThatNameSomeMovers) {
    EXPECT_EQ(all(), "") << "no place is known yet";
    EXPECT_TRUE(moves({{2, 5.0F}}));
    EXPECT_TRUE(moves({{1, 7.0F}, {3, 8.0F}}));
    EXPECT_EQ(all(), "2 5, 1 7, 3 8, ");
    EXPECT_TRUE(moves({{2, 6.0F}}));
    EXPECT_EQ(all(), "2 6, 1 7, 3 8, ");
}

TEST_F(MoverPlacesTest, KnowWhetherAnythingIsElsewhere) {
    EXPECT_FALSE(moves({}));
    EXPECT_TRUE(moves({{1, 0.0F}})) << "its first place";
    EXPECT_FALSE(moves({{1, 0.0F}}));
    EXPECT_TRUE(moves({{1, 0.5F}}));
    MoverFrameArrays turned = movers_at({{1, 0.5F}});
    turned.orientations_ = {0.0F, 0.0F, 0.6F, 0.8F};
    places_.move(turned.get());
    EXPECT_TRUE(places_.have_moved());
    places_.move(turned.get());
    EXPECT_TRUE(places_.have_moved()) << "until it has been sent";
}

TEST_F(MoverPlacesTest, ForgetThoseThatAreGone) {
    EXPECT_TRUE(moves({{1, 1.0F}, {2, 2.0F}, {3, 3.0F}}));
    know({3, 4, 1});
    EXPECT_EQ(all(), "1 1, 3 3, ");
    know({1, 2});
    EXPECT_EQ(all(), "1 1, ") << "2 has come anew";
}

TEST_F(MoverPlacesTest, RefuseFramesThatAreWrongAsAWhole) {
    EXPECT_TRUE(moves({{1, 1.0F}}));
    EXPECT_EQ(refusal(movers_at({{1, 2.0F}, {9, 0.0F}}).get()),
              "a mover is none of those in cdir_match_set_movers()");
    EXPECT_EQ(refusal(movers_at({{1, 2.0F}, {2, INFINITY}}).get()), "a mover's position is not finite");
    EXPECT_EQ(refusal(movers_at({{1, 2.0F}, {2, 0.0F}, {1, 3.0F}}).get()), "a mover is given twice");
    MoverFrameArrays skewed = movers_at({{1, 2.0F}});
    skewed.orientations_[3] = 2.0F;
    EXPECT_EQ(refusal(skewed.get()), "a mover's orientation is not of length 1");
    const MoverFrameArrays valid = movers_at({{1, 2.0F}});
    cdir_mover_frame frame = valid.get();
    frame.mover_count = CDIR_MAX_MOVERS + 1;
    EXPECT_EQ(refusal(frame), "mover_count is greater than CDIR_MAX_MOVERS");
    frame = valid.get();
    frame.position = nullptr;
    EXPECT_EQ(refusal(frame), "position is null");
    frame = valid.get();
    frame.mover_id_stride = 3;
    EXPECT_EQ(refusal(frame), "mover_id_stride is 3, neither 0 nor at least 4");
    frame = valid.get();
    frame.reserved = 1;
    EXPECT_EQ(refusal(frame), "frame.reserved is not 0");
    EXPECT_EQ(all(), "1 1, ");
    EXPECT_FALSE(places_.have_moved());
}

}  // namespace
}  // namespace camdir::sdk
