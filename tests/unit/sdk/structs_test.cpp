// A library of today serves callers of every earlier version of the ABI.
#include "structs.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

namespace camdir::sdk {
namespace {

// What a struct looks like in a caller that was compiled earlier, and what it has become.
struct OldShape {
    std::uint32_t struct_size;
    std::uint32_t width;
};
struct Shape {
    std::uint32_t struct_size;
    std::uint32_t width;
    std::uint64_t added;
};

}  // namespace

template <>
inline constexpr std::uint32_t least_size<Shape> = sizeof(OldShape);
template <>
Shape default_of<Shape>() {
    return {sizeof(Shape), 1, 7};
}

namespace {

template <class Call>
std::string refusal(const Call& call) {
    try {
        call();
        return "";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.status, CDIR_INVALID_ARGUMENT);
        return failure.text;
    }
}

Shape* as_shape(void* memory) {
    return static_cast<Shape*>(memory);
}

TEST(Structs, AnOlderCallersStructIsReadWithDefaultsAndWrittenNoFurther) {
    std::array<OldShape, 2> old{{{sizeof(OldShape), 5}, {111, 222}}};
    const Shape read = read_struct("shape", as_shape(&old));
    EXPECT_EQ(read.struct_size, sizeof(Shape));
    EXPECT_EQ(read.width, 5U);
    EXPECT_EQ(read.added, 7U) << "the default of what the caller does not have";

    write_struct(as_shape(&old), Shape{0, 6, 8});
    EXPECT_EQ(old[0].struct_size, sizeof(OldShape));
    EXPECT_EQ(old[0].width, 6U);
    EXPECT_EQ(old[1].struct_size, 111U) << "written beyond the caller's struct";
}

TEST(Structs, ArraysAreWalkedByTheFirstOnesSize) {
    std::array<OldShape, 3> old{{{sizeof(OldShape), 5}, {sizeof(OldShape), 6}, {sizeof(OldShape), 7}}};
    const std::vector<Shape> read = read_array("shapes", as_shape(&old), 3);
    ASSERT_EQ(read.size(), 3U);
    for (std::uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(read[i].width, 5 + i);
        EXPECT_EQ(read[i].added, 7U);
    }
    const StructArray<Shape> written("shapes", as_shape(&old), 2);
    written.write(1, Shape{0, 60, 8});
    EXPECT_EQ(old[1].width, 60U);
    EXPECT_EQ(old[1].struct_size, sizeof(OldShape));
    EXPECT_EQ(old[2].width, 7U);

    EXPECT_TRUE(read_array<Shape>("shapes", nullptr, 0).empty());
    EXPECT_EQ(refusal([] { (void)read_array<Shape>("shapes", nullptr, 1); }), "shapes is null");
    old[2].struct_size = 0;
    EXPECT_EQ(refusal([&] { (void)read_array("shapes", as_shape(&old), 3); }),
              "shapes[2].struct_size is 0, not at least 8: begin with its _default() or _init() function");
}

TEST(Structs, SizesOfNoVersionAreRefused) {
    for (const std::uint32_t size : {0U, 7U, 17U, 0xffffffffU}) {
        Shape shape{size, 1, 1};
        EXPECT_NE(refusal([&] { (void)read_struct("shape", &shape); }), "") << size;
    }
    for (const std::uint32_t size : {8U, 12U, 16U}) {
        Shape shape{size, 1, 1};
        EXPECT_EQ(refusal([&] { (void)read_struct("shape", &shape); }), "") << size;
    }
    Shape later{24, 1, 1};
    EXPECT_EQ(refusal([&] { (void)read_struct("shape", &later); }),
              "shape.struct_size is 24, not at most 16: the caller was compiled for a later library, or has "
              "not initialised it");
}

TEST(Structs, AreInitialisedAsFarAsTheCallerHasThem) {
    std::array<unsigned char, 32> memory{};
    for (const std::uint32_t size : {0U, 3U, 8U, 16U, 24U}) {
        memory.fill(0xee);
        initialise(as_shape(&memory), size);
        std::array<unsigned char, 32> expected;
        expected.fill(0xee);
        if (size >= 4) {
            const Shape made{size, 1, 7};
            std::memset(expected.data(), 0, size);
            std::memcpy(expected.data(), &made, std::min<std::size_t>(size, sizeof made));
        }
        EXPECT_EQ(memory, expected) << size;
    }
    initialise<Shape>(nullptr, 16);
}

TEST(Structs, TheHeadersDefaultsAreTheLibrarys) {
    EXPECT_EQ(cdir_match_info_default().struct_size, sizeof(cdir_match_info));
    EXPECT_EQ(cdir_match_info_default().rate_hz, 60.0F);
    EXPECT_STREQ(cdir_context_options_default().network_interface, "lo");
    EXPECT_EQ(cdir_context_options_default().security, nullptr);
    EXPECT_EQ(cdir_shot_request_default().target, CDIR_CHOOSE_TARGET);
    EXPECT_EQ(cdir_match_event_default().actor, CDIR_NO_PLAYER);
    EXPECT_EQ(cdir_observer_options_default().interpolation_delay, 50'000'000);
    EXPECT_EQ(cdir_shot_status_default().state, static_cast<std::uint32_t>(CDIR_SHOT_NOT_REQUESTED));
    EXPECT_EQ(cdir_camera_default().orientation[3], 1.0F);
    EXPECT_EQ(cdir_player_default().struct_size, sizeof(cdir_player));
}

}  // namespace
}  // namespace camdir::sdk
