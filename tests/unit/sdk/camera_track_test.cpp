#include "camera_track.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace camdir::sdk {
namespace {

struct Frame {
    std::int64_t time;
    cdir_camera camera;
    bool connected;
};

cdir_camera camera_at_x(float x) {
    return {1, 7, {x, 0.0F, 0.0F}, {0.0F, 0.0F, 0.0F, 1.0F}, 1.0F, 10.0F, 0};
}

CameraTrack track_of(const std::vector<Frame>& frames) {
    CameraTrack track;
    for (const Frame& frame : frames) {
        track.add(frame.time, frame.camera, frame.connected);
    }
    return track;
}

float number_between(float least, float most) {
    return least + (most - least) * static_cast<float>(*rc::gen::inRange(0, 100001)) / 100000.0F;
}

cdir_camera any_camera() {
    cdir_camera camera{};
    camera.camera_id = 1;
    std::generate_n(camera.position, 3, [] { return number_between(-1000.0F, 1000.0F); });
    const Eigen::Quaternionf turn = Eigen::AngleAxisf(number_between(-3.1F, 3.1F), Eigen::Vector3f::UnitZ()) *
                                    Eigen::AngleAxisf(number_between(-1.5F, 1.5F), Eigen::Vector3f::UnitY());
    Eigen::Map<Eigen::Quaternionf>(camera.orientation) = turn;
    camera.vertical_fov = number_between(0.1F, 3.0F);
    camera.clearance = number_between(0.0F, 100.0F);
    return camera;
}

std::vector<Frame> any_frames() {
    std::vector<Frame> frames;
    std::int64_t time = 0;
    const int count = *rc::gen::inRange(1, 90);
    for (int i = 0; i < count; ++i) {
        time += *rc::gen::inRange<std::int64_t>(1, 50'000'000);
        frames.push_back({time, any_camera(), *rc::gen::inRange(0, 5) != 0});
    }
    return frames;
}

bool same(const cdir_camera& a, const cdir_camera& b) {
    return std::equal(a.position, a.position + 3, b.position) &&
           std::equal(a.orientation, a.orientation + 4, b.orientation) && a.vertical_fov == b.vertical_fov &&
           a.clearance == b.clearance;
}

float angle_between(const cdir_camera& a, const cdir_camera& b) {
    using Quaternion = Eigen::Map<const Eigen::Quaternionf>;
    return Quaternion(a.orientation).angularDistance(Quaternion(b.orientation));
}

float distance_between(const cdir_camera& a, const cdir_camera& b) {
    using Vector = Eigen::Map<const Eigen::Vector3f>;
    return (Vector(a.position) - Vector(b.position)).norm();
}

// The frames that a track holds, computed the simple way.
std::vector<Frame> kept(const std::vector<Frame>& frames) {
    const auto drop =
        static_cast<std::ptrdiff_t>(frames.size()) - static_cast<std::ptrdiff_t>(CameraTrack::capacity);
    return {frames.begin() + std::max<std::ptrdiff_t>(drop, 0), frames.end()};
}

TEST(CameraTrack, EmptyTrackHasNoCamera) {
    const CameraTrack track;
    EXPECT_FALSE(track.newest());
    EXPECT_FALSE(track.at(0));
}

RC_GTEST_PROP(CameraTrack, FrameTimesGiveTheFramesThemselves, ()) {
    const std::vector<Frame> frames = any_frames();
    const CameraTrack track = track_of(frames);
    for (const Frame& frame : kept(frames)) {
        const auto view = track.at(frame.time);
        RC_ASSERT(view && same(view->camera, frame.camera) && view->frame_time == frame.time &&
                  view->late == 0);
    }
    RC_ASSERT(same(track.newest()->camera, frames.back().camera));
}

RC_GTEST_PROP(CameraTrack, BetweenTwoFramesTheCameraLiesBetweenThem, ()) {
    const std::vector<Frame> frames = kept(any_frames());
    const CameraTrack track = track_of(frames);
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const Frame& a = frames[i - 1];
        const Frame& b = frames[i];
        if (b.time - a.time < 2) continue;
        const std::int64_t time = a.time + *rc::gen::inRange<std::int64_t>(1, b.time - a.time);
        const cdir_view view = *track.at(time);
        RC_ASSERT(view.frame_time == time);
        if (!b.connected) {
            RC_ASSERT(same(view.camera, a.camera));
            continue;
        }
        const float share = static_cast<float>(time - a.time) / static_cast<float>(b.time - a.time);
        const float way = distance_between(a.camera, b.camera);
        const float turn = angle_between(a.camera, b.camera);
        RC_ASSERT(std::abs(distance_between(a.camera, view.camera) - share * way) < 1e-2F);
        RC_ASSERT(std::abs(distance_between(view.camera, b.camera) - (1.0F - share) * way) < 1e-2F);
        RC_ASSERT(std::abs(angle_between(a.camera, view.camera) - share * turn) < 2e-3F);
        RC_ASSERT(std::abs(angle_between(view.camera, b.camera) - (1.0F - share) * turn) < 2e-3F);
        const Eigen::Map<const Eigen::Quaternionf> orientation(view.camera.orientation);
        RC_ASSERT(std::abs(orientation.norm() - 1.0F) < 1e-5F);
    }
}

// The balls around both ends are free; the ball around the camera between them must lie in one of them.
RC_GTEST_PROP(CameraTrack, ClearanceStaysALowerBound, ()) {
    Frame a{0, any_camera(), false};
    Frame b{1000, any_camera(), true};
    const cdir_view view = *track_of({a, b}).at(*rc::gen::inRange<std::int64_t>(1, 1000));
    const bool inside_a =
        view.camera.clearance <= a.camera.clearance - distance_between(a.camera, view.camera) + 1e-2F;
    const bool inside_b =
        view.camera.clearance <= b.camera.clearance - distance_between(b.camera, view.camera) + 1e-2F;
    RC_ASSERT(inside_a || inside_b);
}

TEST(CameraTrack, OppositeQuaternionsAreTheSameOrientation) {
    cdir_camera flipped = camera_at_x(0.0F);
    flipped.orientation[3] = -1.0F;
    const CameraTrack track = track_of({{0, camera_at_x(0.0F), false}, {10, flipped, true}});
    EXPECT_LT(angle_between(track.at(5)->camera, camera_at_x(0.0F)), 1e-3F);
}

TEST(CameraTrack, OutsideOfTheTrackItsEndsAreReturned) {
    const CameraTrack track = track_of({{100, camera_at_x(1.0F), false}, {200, camera_at_x(2.0F), true}});
    EXPECT_EQ(track.at(50)->camera.position[0], 1.0F);
    EXPECT_EQ(track.at(50)->frame_time, 100);
    EXPECT_EQ(track.at(1'000'000)->camera.position[0], 2.0F);
    EXPECT_EQ(track.at(1'000'000)->frame_time, 200);
    EXPECT_EQ(track.at(1'000'000)->late, 999'800);
}

TEST(CameraTrack, SegmentsChangeAtCutsInterruptionsAndClears) {
    CameraTrack track;
    const auto add = [&](std::int64_t time, bool connected) {
        track.add(time, camera_at_x(static_cast<float>(time)), connected);
        return track.newest()->segment;
    };
    const std::uint32_t first = add(10, true);
    EXPECT_EQ(add(20, true), first);
    EXPECT_EQ(add(30, false), first + 1);
    track.interrupt();
    EXPECT_EQ(add(40, true), first + 2);
    track.clear();
    EXPECT_FALSE(track.newest());
    EXPECT_EQ(add(5, true), first + 3) << "an earlier time is new after a clear";
}

TEST(CameraTrack, FrameThatIsNotNewerIsSkipped) {
    const CameraTrack track = track_of(
        {{100, camera_at_x(1.0F), false}, {100, camera_at_x(8.0F), true}, {90, camera_at_x(9.0F), true}});
    EXPECT_EQ(track.newest()->camera.position[0], 1.0F);
    EXPECT_EQ(track.at(95)->camera.position[0], 1.0F);
}

TEST(CameraTrack, NothingIsInterpolatedAcrossASkippedFrame) {
    const CameraTrack track = track_of(
        {{100, camera_at_x(1.0F), false}, {100, camera_at_x(50.0F), false}, {110, camera_at_x(51.0F), true}});
    EXPECT_EQ(track.at(105)->camera.position[0], 1.0F);
    EXPECT_NE(track.newest()->segment, track.at(100)->segment);
}

}  // namespace
}  // namespace camdir::sdk
