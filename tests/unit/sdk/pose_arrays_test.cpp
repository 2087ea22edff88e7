// Poses are gathered from packed arrays and from fields of an engine's own structs.
#include "pose_arrays.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "failure.hpp"

namespace camdir::sdk {
namespace {

std::string refusal(const cdir_pose_frame& frame) {
    try {
        PoseArrays().gather(frame);
        return "";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.status, CDIR_INVALID_ARGUMENT);
        return failure.text;
    }
}

class TwoPlayers : public testing::Test {
  protected:
    TwoPlayers() {
        frame_.player_count = 2;
        frame_.player_id = ids_;
        frame_.eye = eye_;
        frame_.orientation = orientation_;
        frame_.velocity = velocity_;
        frame_.flags = flags_;
    }

    std::uint32_t ids_[2] = {1, 2};
    std::uint32_t flags_[2] = {1, 1};
    float eye_[6] = {};
    float orientation_[8] = {0, 0, 0, 1, 0.6F, 0, 0.8F, 0};
    float velocity_[6] = {};
    cdir_pose_frame frame_ = cdir_pose_frame_default();
};

TEST_F(TwoPlayers, NumbersAreFiniteAndOrientationsUnit) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(refusal(frame_), "");
    for (float* number :
         {&eye_[0], &eye_[5], &orientation_[2], &orientation_[7], &velocity_[0], &velocity_[5]}) {
        for (const float wrong : {nan, infinity, -infinity}) {
            const float right = *number;
            *number = wrong;
            EXPECT_NE(refusal(frame_), "");
            *number = right;
        }
    }
    orientation_[3] = 1.0005F;
    EXPECT_EQ(refusal(frame_), "");
    orientation_[3] = 0.998F;
    EXPECT_EQ(refusal(frame_), "an orientation is not of length 1");
}

TEST_F(TwoPlayers, HaveIdsOfTheirOwn) {
    const auto refused = [this](std::uint32_t first, std::uint32_t second) {
        ids_[0] = first;
        ids_[1] = second;
        return refusal(frame_);
    };
    EXPECT_EQ(refused(CDIR_SHOW_GROUP - 1, 0), "");
    EXPECT_EQ(refused(7, 7), "two players have the same id");
    for (const std::uint32_t reserved : {CDIR_SHOW_GROUP, CDIR_NO_PLAYER})
        EXPECT_EQ(refused(reserved, 1), "a player's id is CDIR_SHOW_GROUP or CDIR_NO_PLAYER");
}

TEST_F(TwoPlayers, OnlyTheVelocityMayBeMissing) {
    cdir_pose_frame frame = frame_;
    frame.velocity = nullptr;
    EXPECT_EQ(refusal(frame), "");
    for (const auto& [field, text] : {std::pair(&cdir_pose_frame::eye, "eye is null"),
                                      std::pair(&cdir_pose_frame::orientation, "orientation is null")}) {
        frame = frame_;
        frame.*field = nullptr;
        EXPECT_EQ(refusal(frame), text);
    }
    for (const auto& [field, text] : {std::pair(&cdir_pose_frame::player_id, "player_id is null"),
                                      std::pair(&cdir_pose_frame::flags, "flags is null")}) {
        frame = frame_;
        frame.*field = nullptr;
        EXPECT_EQ(refusal(frame), text);
    }
    EXPECT_EQ(refusal(cdir_pose_frame_default()), "") << "a frame without players needs no arrays";
}

TEST_F(TwoPlayers, CountsAndStridesThatCannotBeAreRefused) {
    frame_.eye_stride = 11;
    EXPECT_EQ(refusal(frame_), "eye_stride is 11, neither 0 nor at least 12");
    frame_.eye_stride = 12;
    frame_.flags_stride = 3;
    EXPECT_EQ(refusal(frame_), "flags_stride is 3, neither 0 nor at least 4");
    frame_.flags_stride = 0;
    EXPECT_EQ(refusal(frame_), "");
    frame_.player_count = CDIR_MAX_PLAYERS + 1;
    EXPECT_EQ(refusal(frame_), "player_count is greater than CDIR_MAX_PLAYERS");
}

// The last element ends where the array ends: the address sanitizer reports reading beyond.
TEST(PoseArrays, TakesFieldsOfAnEnginesOwnStructs) {
#pragma pack(push, 1)
    struct Entity {
        char model;  // nothing is aligned
        float eye[3], velocity[3], orientation[4];
        std::uint32_t flags, id;
    };
#pragma pack(pop)
    constexpr std::uint32_t count = CDIR_MAX_PLAYERS;
    std::vector<unsigned char> memory(count * sizeof(Entity));
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto n = static_cast<float>(i);
        const Entity entity{'x', {n, n + 1, n + 2}, {-n, 0, n}, {0, 0, i % 2 == 0 ? 1.0F : -1.0F, 0},
                            i,   1000 - i};
        std::memcpy(&memory[i * sizeof entity], &entity, sizeof entity);
    }
    const auto field = [&](std::size_t offset) { return static_cast<const void*>(memory.data() + offset); };
    cdir_pose_frame frame = cdir_pose_frame_default();
    frame.player_count = count;
    frame.player_id = static_cast<const std::uint32_t*>(field(offsetof(Entity, id)));
    frame.eye = static_cast<const float*>(field(offsetof(Entity, eye)));
    frame.orientation = static_cast<const float*>(field(offsetof(Entity, orientation)));
    frame.velocity = static_cast<const float*>(field(offsetof(Entity, velocity)));
    frame.flags = static_cast<const std::uint32_t*>(field(offsetof(Entity, flags)));
    frame.player_id_stride = frame.eye_stride = frame.orientation_stride = frame.velocity_stride =
        frame.flags_stride = sizeof(Entity);
    PoseArrays poses;
    poses.gather(frame);
    ASSERT_EQ(poses.count(), count);
    ASSERT_TRUE(poses.has_velocity());
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto n = static_cast<float>(i);
        EXPECT_EQ(poses.player_id()[i], 1000 - i);
        EXPECT_EQ(poses.flags()[i], i);
        EXPECT_EQ(poses.eye()[3 * i + 1], n + 1);
        EXPECT_EQ(poses.velocity()[3 * i], -n);
        EXPECT_EQ(poses.orientation()[4 * i + 2], i % 2 == 0 ? 1.0F : -1.0F);
    }
}

}  // namespace
}  // namespace camdir::sdk
