#include "camera_track.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "support/allocations.hpp"

namespace camdir::sdk {
namespace {

struct Frame {
    std::int64_t time;
    cdir_camera camera;
    bool connected;
};

cdir_camera camera_at_x(float x) {
    cdir_camera camera = cdir_camera_default();
    camera.position[0] = x;
    camera.vertical_fov = 1.0F;
    camera.clearance = 10.0F;
    return camera;
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

cdir_camera any_camera(float size = 1000.0F) {
    cdir_camera camera{};
    camera.camera_id = 1;
    std::generate_n(camera.position, 3, [=] { return number_between(-size, size); });
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

Eigen::Vector3d moved(const cdir_camera& from, const cdir_camera& to) {
    using Vector = Eigen::Map<const Eigen::Vector3f>;
    return Vector(to.position).cast<double>() - Vector(from.position).cast<double>();
}

// The rotation vector.
Eigen::Vector3d turned(const cdir_camera& from, const cdir_camera& to) {
    using Quaternion = Eigen::Map<const Eigen::Quaternionf>;
    const Eigen::AngleAxisd turn(Quaternion(from.orientation).cast<double>().normalized().conjugate() *
                                 Quaternion(to.orientation).cast<double>().normalized());
    return turn.angle() * turn.axis();
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
    CameraTrack track;
    EXPECT_FALSE(track.newest());
    EXPECT_FALSE(track.at(0));
}

RC_GTEST_PROP(CameraTrack, FrameTimesGiveTheFramesThemselves, ()) {
    const std::vector<Frame> frames = any_frames();
    CameraTrack track = track_of(frames);
    for (const Frame& frame : kept(frames)) {
        const auto view = track.at(frame.time);
        RC_ASSERT(view && same(view->camera, frame.camera) && view->frame_time == frame.time &&
                  view->late == 0);
    }
    RC_ASSERT(same(track.newest()->camera, frames.back().camera));
}

RC_GTEST_PROP(CameraTrack, BetweenUnconnectedFramesTheCameraIsTheEarlierOne, ()) {
    const std::vector<Frame> frames = kept(any_frames());
    CameraTrack track = track_of(frames);
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const Frame& a = frames[i - 1];
        const Frame& b = frames[i];
        if (b.time - a.time < 2) continue;
        const std::int64_t time = a.time + *rc::gen::inRange<std::int64_t>(1, b.time - a.time);
        const View view = *track.at(time);
        RC_ASSERT(view.frame_time == time && view.late == 0);
        RC_ASSERT(b.connected || same(view.camera, a.camera));
    }
}

RC_GTEST_PROP(CameraTrack, PositionAndOrientationHaveOneVelocityAtEveryFrame, ()) {
    CameraTrack track;
    std::vector<Frame> frames;
    std::int64_t time = 0;
    for (int i = 0; i < 8; ++i) {
        time += *rc::gen::inRange<std::int64_t>(10'000'000, 50'000'000);
        frames.push_back({time, any_camera(10.0F), true});
        frames.back().camera.clearance = number_between(2.0F, 20.0F);
        track.add(time, frames.back().camera, true);
        if (*rc::gen::inRange(0, 2) == 0) (void)track.at(time - 1);  // before the next frame has arrived
    }
    for (std::size_t i = 1; i + 1 < frames.size(); ++i) {
        const std::int64_t step = 10'000;
        const auto velocity = [&](std::int64_t side) {
            const auto camera = [&](std::int64_t n) {
                return track.at(frames[i].time + side * n * step)->camera;
            };
            const double seconds = 2e-9 * static_cast<double>(side * step);
            // Of the parabola through three places on one side.
            const auto at_frame = [&](const auto& place) {
                return Eigen::Vector3d((4.0 * place(camera(1)) - place(camera(2))) / seconds);
            };
            return std::pair(at_frame([&](const cdir_camera& at) { return moved(frames[i].camera, at); }),
                             at_frame([&](const cdir_camera& at) { return turned(frames[i].camera, at); }));
        };
        const auto [moving_before, turning_before] = velocity(-1);
        const auto [moving_after, turning_after] = velocity(1);
        RC_ASSERT((moving_before - moving_after).norm() < 20.0);   // units/s, of up to 3400
        RC_ASSERT((turning_before - turning_after).norm() < 1.0);  // rad/s, of up to 300
    }
}

// Also where the balls of two frames are too small to meet.
RC_GTEST_PROP(CameraTrack, EveryPositionIsOnTheStraightWayOrInTheBallOfAFrame, ()) {
    std::vector<Frame> frames;
    std::int64_t time = 0;
    const float size = *rc::gen::element(1.0F, 10.0F, 100.0F);
    for (int i = 0; i < 10; ++i) {
        time += *rc::gen::inRange<std::int64_t>(1'000'000, 50'000'000);
        frames.push_back({time, any_camera(size), true});
        frames.back().camera.clearance = number_between(-1.0F, 20.0F);
    }
    CameraTrack track = track_of(frames);
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const cdir_camera& a = frames[i - 1].camera;
        const cdir_camera& b = frames[i].camera;
        for (int n = 1; n < 50; ++n) {
            const cdir_camera at =
                track.at(frames[i - 1].time + n * (frames[i].time - frames[i - 1].time) / 50)->camera;
            const Eigen::Vector3d way = moved(a, b);
            const double share = std::clamp(moved(a, at).dot(way) / (way.squaredNorm() + 1e-12), 0.0, 1.0);
            const double off = (moved(a, at) - share * way).norm();
            RC_ASSERT(off < 1e-3 || distance_between(a, at) < a.clearance + 1e-3F ||
                      distance_between(b, at) < b.clearance + 1e-3F);
        }
    }
}

// A camera that is thrown: a parabola in time, and a turn that does so too.
RC_GTEST_PROP(CameraTrack, IrregularFramesOfASmoothMotionGiveThatMotion, ()) {
    const auto thrown = [](std::int64_t time) {
        const double t = 1e-9 * static_cast<double>(time);
        cdir_camera camera = camera_at_x(static_cast<float>(300.0 * t - 200.0 * t * t));
        const double angle = t + 2.0 * t * t;
        Eigen::Map<Eigen::Quaternionf>(camera.orientation) =
            Eigen::AngleAxisd(angle, Eigen::Vector3d(0.0, 0.6, 0.8)).cast<float>();
        return camera;
    };
    CameraTrack track;
    std::vector<std::int64_t> times = {0};
    while (times.size() < 10)
        times.push_back(times.back() + *rc::gen::inRange<std::int64_t>(5'000'000, 50'000'000));
    for (const std::int64_t time : times)
        track.add(time, thrown(time), true);
    const std::int64_t time = *rc::gen::inRange(times[1], times[8]);
    const cdir_camera camera = track.at(time)->camera;
    RC_ASSERT(distance_between(camera, thrown(time)) < 1e-3F);
    RC_ASSERT(turned(camera, thrown(time)).norm() < 1e-4);
}

TEST(CameraTrack, ACameraThatComesToAStandstillDoesNotOvershoot) {
    CameraTrack track;
    const float places[] = {0.0F, 10.0F, 20.0F, 28.0F, 30.0F, 30.0F, 30.0F, 31.0F, 40.0F};
    for (int i = 0; i < 9; ++i)
        track.add(i * 1000, camera_at_x(places[i]), true);
    float before = 0.0F;
    for (int time = 0; time <= 8000; time += 10) {
        const float now = track.at(time)->camera.position[0];
        EXPECT_GE(now, before) << time;
        before = now;
    }
    for (int time = 4000; time <= 6000; time += 10)
        EXPECT_EQ(track.at(time)->camera.position[0], 30.0F);
}

// Asked for the cameras of a display, while frames arrive.
RC_GTEST_PROP(CameraTrack, AWayThatHasBeenShownDoesNotBend, ()) {
    const std::vector<Frame> frames = any_frames();
    CameraTrack track;
    std::vector<std::pair<std::int64_t, cdir_camera>> shown;
    for (const Frame& frame : frames) {
        const auto newest = track.newest();
        track.add(frame.time, frame.camera, frame.connected);
        if (!newest) continue;
        const std::int64_t back = *rc::gen::inRange<std::int64_t>(0, 80'000'000);
        const std::int64_t time = std::max<std::int64_t>(frame.time - back, 0);
        shown.emplace_back(time, track.at(time)->camera);
    }
    const std::int64_t oldest = kept(frames).front().time;
    for (const auto& [time, camera] : shown)
        RC_ASSERT(time < oldest || same(track.at(time)->camera, camera));
}

RC_GTEST_PROP(CameraTrack, WhatIsBeyondACutMakesNoDifference, ()) {
    std::vector<Frame> frames;
    for (int i = 0; i < 6; ++i)
        frames.push_back({i * 1000, any_camera(), i != 3});
    const std::int64_t time = *rc::gen::inRange<std::int64_t>(0, 3000);
    const std::vector<Frame> first(frames.begin(), frames.begin() + 3);
    RC_ASSERT(same(track_of(frames).at(time)->camera, track_of(first).at(time)->camera));
    const std::vector<Frame> second(frames.begin() + 3, frames.end());
    RC_ASSERT(same(track_of(frames).at(time + 3000)->camera, track_of(second).at(time + 3000)->camera));
}

TEST(CameraTrack, NothingIsAllocated) {
    CameraTrack track;
    const long before = test::allocations();
    for (std::int64_t time = 0; time < 3000; ++time) {
        if (time % 16 == 0) track.add(time, camera_at_x(static_cast<float>(time % 100)), time % 160 != 0);
        (void)track.at(time - 20);
    }
    EXPECT_EQ(test::allocations() - before, 0);
}

TEST(CameraTrack, FieldOfViewIsLinear) {
    cdir_camera wide = camera_at_x(0.0F);
    wide.vertical_fov = 2.0F;
    CameraTrack track = track_of({{0, camera_at_x(0.0F), false}, {10, wide, true}, {20, wide, true}});
    EXPECT_FLOAT_EQ(track.at(5)->camera.vertical_fov, 1.5F);
    EXPECT_FLOAT_EQ(track.at(15)->camera.vertical_fov, 2.0F);
}

// The balls around both ends are free; the ball around the camera between them must lie in one of them.
RC_GTEST_PROP(CameraTrack, ClearanceStaysALowerBound, ()) {
    CameraTrack track;
    std::array<cdir_camera, 4> frames;
    for (std::size_t i = 0; i < 4; ++i) {
        frames[i] = any_camera(100.0F);
        track.add(static_cast<std::int64_t>(1000 * i), frames[i], true);
    }
    const Frame a{1000, frames[1], true};
    const Frame b{2000, frames[2], true};
    const View view = *track.at(*rc::gen::inRange<std::int64_t>(1001, 2000));
    const bool inside_a =
        view.camera.clearance <= a.camera.clearance - distance_between(a.camera, view.camera) + 1e-2F;
    const bool inside_b =
        view.camera.clearance <= b.camera.clearance - distance_between(b.camera, view.camera) + 1e-2F;
    RC_ASSERT(inside_a || inside_b);
}

TEST(CameraTrack, OppositeQuaternionsAreTheSameOrientation) {
    cdir_camera flipped = camera_at_x(0.0F);
    flipped.orientation[3] = -1.0F;
    CameraTrack track = track_of({{0, camera_at_x(0.0F), false}, {10, flipped, true}});
    EXPECT_LT(angle_between(track.at(5)->camera, camera_at_x(0.0F)), 1e-3F);
}

TEST(CameraTrack, OutsideOfTheTrackItsEndsAreReturned) {
    CameraTrack track = track_of({{100, camera_at_x(1.0F), false}, {200, camera_at_x(2.0F), true}});
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
    CameraTrack track = track_of(
        {{100, camera_at_x(1.0F), false}, {100, camera_at_x(8.0F), true}, {90, camera_at_x(9.0F), true}});
    EXPECT_EQ(track.newest()->camera.position[0], 1.0F);
    EXPECT_EQ(track.at(95)->camera.position[0], 1.0F);
}

TEST(CameraTrack, NothingIsInterpolatedAcrossASkippedFrame) {
    CameraTrack track = track_of(
        {{100, camera_at_x(1.0F), false}, {100, camera_at_x(50.0F), false}, {110, camera_at_x(51.0F), true}});
    EXPECT_EQ(track.at(105)->camera.position[0], 1.0F);
    EXPECT_NE(track.newest()->segment, track.at(100)->segment);
}

}  // namespace
}  // namespace camdir::sdk
