#include "camera/group/group_shot.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <ostream>
#include <random>
#include <vector>

#include "camera/group/viewpoint.hpp"
#include "freespace/distance.hpp"
#include "freespace/lookouts.hpp"
#include "support/allocations.hpp"
#include "walk.hpp"

namespace camdir::camera {
namespace {

constexpr double group_frame = 1.0 / 60.0;

// By member; none: not present.
using Poses = std::vector<std::optional<Pose>>;

bool flagged(const Camera& camera, std::uint32_t flag) {
    return (camera.flags & flag) != 0;
}

// A causal group shot; every camera is checked against the guarantees of step() as it comes.
class CheckedGroup {
  public:
    explicit CheckedGroup(const test::Plan& plan) : plan_(plan), freespace_(plan.freespace()) {}

    Camera step(const Poses& poses) {
        std::vector<TimedPose> timed;
        for (const auto& pose : poses)
            timed.push_back({time_, pose.value_or(Pose{}), pose.has_value()});
        std::vector<Window> windows;
        for (const TimedPose& pose : timed)
            windows.emplace_back(&pose, 1);
        const Camera camera = camera::step(freespace_, {}, windows, time_, state_, outlook_);
        check(camera, poses);
        time_ += group_frame;
        return camera;
    }

    [[nodiscard]] const freespace::Freespace& freespace() const { return freespace_; }
    [[nodiscard]] int cuts() const { return cuts_; }

  private:
    void check(const Camera& camera, const Poses& poses) {
        ASSERT_TRUE(camera.position.allFinite());
        ASSERT_TRUE(camera.orientation.coeffs().allFinite());
        EXPECT_NEAR(camera.orientation.norm(), 1.0F, 1e-4F);
        EXPECT_NEAR((camera.orientation * Vec3f::UnitY()).z(), 0.0F, 1e-4F) << "a level horizon";
        EXPECT_GT(plan_.clearance(camera.position), 0.0F);
        if (flagged(camera, cut)) {
            EXPECT_TRUE(cuts_ == 0 || time_ - last_cut_ >= shortest_group_shot - 1e-3);
            ++cuts_;
            last_cut_ = time_;
        } else {
            EXPECT_TRUE(plan_.segment_clear(position_, camera.position));
            EXPECT_LT((camera.position - position_).norm(), 400.0 * group_frame);
        }
        for (const auto& pose : poses) {
            if (!flagged(camera, target_visible) || !pose || !usable(*pose) || !pose->alive) continue;
            EXPECT_TRUE(shows(camera, pose->eye));
        }
        position_ = camera.position;
    }
    [[nodiscard]] bool shows(const Camera& camera, const Vec3f& eye) const {
        const Vec3f seen = camera.orientation.conjugate() * (eye - camera.position);
        const float half_height = std::tan(camera.vertical_fov / 2.0F);
        return plan_.segment_clear(camera.position, eye) && std::abs(seen.z()) < half_height * seen.x() &&
               std::abs(seen.y()) < 16.0F / 9.0F * half_height * seen.x();
    }

    const test::Plan& plan_;
    freespace::Freespace freespace_;
    GroupState state_;
    Outlook outlook_;
    double time_ = 0.0;
    Vec3f position_ = Vec3f::Zero();
    int cuts_ = 0;
    double last_cut_ = 0.0;
};

test::Plan hall() {
    return test::Plan({"##########", "#........#", "#........#", "#........#", "#........#", "##########"});
}

TEST(GroupShot, ShowsBothFromTheFirstFrame) {
    const test::Plan plan = hall();
    CheckedGroup shot(plan);
    const Camera camera = shot.step({pose_at(plan.eye(2, 3), 0.0F), pose_at(plan.eye(3, 6), 3.0F)});
    EXPECT_TRUE(flagged(camera, cut));
    EXPECT_TRUE(flagged(camera, target_visible));
}

// The share of the lookouts around a point that a place sees.
double seen_around(const freespace::Freespace& freespace, const Vec3f& point, const Vec3f& place) {
    const freespace::Lookouts& lookouts = freespace.lookouts();
    std::size_t around = 0;
    std::size_t seen = 0;
    for (const Vec3f& lookout : lookouts.positions()) {
        if ((lookout - point).norm() > 200.0F || !freespace::sight(freespace, point, lookout).clear) continue;
        ++around;
        seen += freespace::sight(freespace, place, lookout).clear;
    }
    return static_cast<double>(seen) / static_cast<double>(around);
}

// One runs behind the other, round corners.
TEST(GroupShot, SeesMostOfWhereMembersMayGoWhereTheirFutureIsNotKnown) {
    const test::Plan plan = test::figure_eight();
    const freespace::Freespace freespace = plan.freespace();
    const auto outlook = std::make_unique<Outlook>();
    double sum = 0.0;
    int shots = 0;
    for (std::uint32_t seed = 1; seed <= 24; ++seed) {
        Runner runner(plan, plan.eye('s'), seed);
        std::array<TimedPose, 2> poses;
        for (int frame = 0; frame < 230; ++frame)
            poses[frame < 200 ? 1 : 0].pose = runner.next(static_cast<float>(group_frame));
        const std::array<Window, 2> windows{Window(&poses[0], 1), Window(&poses[1], 1)};
        GroupState state;
        const Camera camera = step(freespace, {}, windows, 0.0, state, *outlook);
        if (!flagged(camera, target_visible)) continue;
        for (const TimedPose& timed : poses)
            sum += seen_around(freespace, timed.pose.eye, camera.position) / 2.0;
        ++shots;
    }
    ASSERT_GT(shots, 12);
    EXPECT_GT(sum / shots, 0.9);
}

// Poses that no game should send: anywhere, in walls, not finite, missing.
TEST(GroupShot, NonsenseNeverBreaksAPromise) {
    const test::Plan plan = test::two_rooms();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float odd_numbers[] = {0.0F,  -0.0F,  infinity, -infinity,
                                     1e38F, 1e-38F, 1e7F,     std::numeric_limits<float>::quiet_NaN()};
    for (std::uint32_t seed = 1; seed <= 16; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        std::mt19937 random(seed);
        const auto odd_number = [&] { return odd_numbers[random() % std::size(odd_numbers)]; };
        CheckedGroup shot(plan);
        std::vector<Runner> runners;
        for (std::uint32_t i = 0; i < 2 + seed % 3; ++i)
            runners.emplace_back(plan, plan.eye('s'), 4 * seed + i);
        for (int frame = 0; frame < 300; ++frame) {
            Poses poses;
            for (Runner& runner : runners) {
                Pose pose = runner.next(1.0F / 60.0F);
                const auto what = frame == 0 ? 0 : random() % 40;
                if (what == 1) pose.eye = plan.bounds().sample();
                if (what == 2) pose.eye[static_cast<int>(random() % 3)] = odd_number();
                if (what == 3) pose.orientation.coeffs()[static_cast<int>(random() % 4)] = odd_number();
                if (what == 4) pose.velocity[static_cast<int>(random() % 3)] = odd_number();
                pose.discontinuity = what == 5;
                pose.alive = what != 6;
                poses.push_back(what == 7 ? std::nullopt : std::optional(pose));
            }
            shot.step(poses);
            if (HasFailure()) return;
        }
    }
}

TEST(GroupShot, StandsStillWhilePlayersStayInTheMiddleOfThePicture) {
    const test::Plan plan = hall();
    CheckedGroup shot(plan);
    const Vec3f a = plan.eye(2, 4);
    const Vec3f b = plan.eye(2, 5);
    const Camera first = shot.step({pose_at(a, 0.0F), pose_at(b, 0.0F)});
    for (int i = 1; i < 60; ++i) {
        const Vec3f way(0.0F, 8.0F * std::sin(0.1F * static_cast<float>(i)), 0.0F);
        const Camera camera = shot.step({pose_at(a + way, 0.0F), pose_at(b - way, 0.0F)});
        EXPECT_TRUE(flagged(camera, target_visible));
        EXPECT_EQ(camera.position, first.position);
    }
    EXPECT_EQ(shot.cuts(), 1);
}

TEST(GroupShot, BeginsWhereTheDeadLie) {
    const test::Plan plan = hall();
    CheckedGroup shot(plan);
    Pose a = pose_at(plan.eye(2, 3), 0.0F);
    Pose b = pose_at(plan.eye(3, 6), 3.0F);
    a.alive = b.alive = false;
    const Camera first = shot.step({a, b});
    EXPECT_TRUE(flagged(first, cut));
    EXPECT_TRUE(flagged(first, held));
    EXPECT_LT((first.position - a.eye).norm(), 150.0F) << "at the more important one";
    a.alive = b.alive = true;
    for (int i = 0; i < 120; ++i)
        shot.step({a, b});
    EXPECT_TRUE(flagged(shot.step({a, b}), target_visible));
}

TEST(GroupShot, KeepsTheMoreImportantWhereNobodySeesBoth) {
    const test::Plan plan = test::two_rooms();
    CheckedGroup shot(plan);
    const Pose s = pose_at(plan.eye('s'), 0.0F);
    const Pose t = pose_at(plan.eye('t'), 0.0F);
    const Camera camera = shot.step({s, t});
    EXPECT_TRUE(flagged(camera, searching));
    EXPECT_TRUE(plan.segment_clear(camera.position, s.eye));
    CheckedGroup other(plan);
    EXPECT_TRUE(plan.segment_clear(other.step({t, s}).position, t.eye));
}

TEST(GroupShot, HoldsTheLastPictureWhenNobodyLives) {
    const test::Plan plan = hall();
    CheckedGroup shot(plan);
    Poses poses = {pose_at(plan.eye(2, 3), 0.0F), pose_at(plan.eye(3, 6), 3.0F)};
    const Camera before = shot.step(poses);
    for (std::optional<Pose>& pose : poses)
        pose->alive = false;
    for (int i = 0; i < 60; ++i) {
        const Camera camera = shot.step(poses);
        EXPECT_TRUE(flagged(camera, held));
        EXPECT_EQ(camera.position, before.position);
        EXPECT_TRUE(camera.orientation.isApprox(before.orientation));
    }
}

TEST(GroupShot, WaitsForAFirstPose) {
    const test::Plan plan = test::l_corridor();
    const freespace::Freespace freespace = plan.freespace();
    GroupState state;
    Outlook outlook;
    const Window nobody[2] = {};
    const Camera first = step(freespace, {}, nobody, 0.0, state, outlook);
    EXPECT_EQ(first.flags, std::uint32_t{cut | target_absent | held});
    EXPECT_EQ(step(freespace, {}, nobody, group_frame, state, outlook).flags,
              std::uint32_t{target_absent | held});
    const TimedPose pose{2 * group_frame, pose_at(plan.eye('s'), 0.0F), true};
    const Window one[2] = {{&pose, 1}, {}};
    EXPECT_TRUE(flagged(step(freespace, {}, one, 2 * group_frame, state, outlook), cut));
}

struct Run {
    std::string name;
    int members;
    test::Plan (*plan)();
};
class GroupRun : public testing::TestWithParam<Run> {};

// The checks are those of CheckedGroup.
TEST_P(GroupRun, KeepsItsPromisesAndIsDeterministic) {
    const test::Plan plan = GetParam().plan();
    CheckedGroup shot(plan);
    CheckedGroup again(plan);
    std::vector<Runner> runners;
    const auto lookouts = shot.freespace().lookouts().positions();
    for (int i = 0; i < GetParam().members; ++i)
        runners.emplace_back(plan, lookouts[static_cast<std::size_t>(i) * 3 % lookouts.size()],
                             static_cast<std::uint32_t>(100 + i));
    for (int i = 0; i < 240; ++i) {
        Poses poses;
        for (Runner& runner : runners)
            poses.push_back(runner.next(static_cast<float>(group_frame)));
        poses.front()->alive = i % 120 < 100;
        const Camera camera = shot.step(poses);
        const Camera twin = again.step(poses);
        ASSERT_EQ(camera.position, twin.position);
        ASSERT_EQ(camera.orientation.coeffs(), twin.orientation.coeffs());
        ASSERT_EQ(camera.flags, twin.flags);
        if (HasFailure()) return;
    }
}
INSTANTIATE_TEST_SUITE_P(Members, GroupRun,
                         testing::Values(Run{"TwoInAFigureEight", 2, test::figure_eight},
                                         Run{"ThreeInACorridor", 3, test::l_corridor},
                                         Run{"FourInAHall", 4, hall}),
                         [](const auto& run) { return run.param.name; });

TEST(GroupShot, StaysOnItsSideOfTheLineWherePillarsHideThePlayers) {
    const test::Plan plan({"############", "#..........#", "#..........#", "#....##....#", "#....##....#",
                           "#..........#", "#..........#", "############"});
    const freespace::Freespace freespace = plan.freespace();
    const MapProfile profile({}, freespace.metadata().metres_per_unit);
    Members members;
    members.known = 1;
    members.at[0].eyes = {plan.eye(3, 3), plan.eye(3, 8)};
    members.at[0].living = only(0) | only(1);
    Outlook outlook;
    for (const float side : {1.0F, -1.0F}) {
        const ViewpointSearch search(freespace, profile, members, members.at[0].living,
                                     {plan.eye(2, 5), side, 0.0F}, outlook);
        const auto found = search.cut(0.0F);
        ASSERT_TRUE(found);
        EXPECT_GT(side * side_of(members.now(), found->position), 0.0F);
    }
}

TEST(GroupShot, DoesNotAllocateOnAMapWhoseLookoutsAreKnown) {
    const test::Plan plan = test::figure_eight();
    const freespace::Freespace freespace = plan.freespace();
    (void)freespace.octree();
    (void)freespace.lookouts();
    Runner a(plan, freespace.lookouts().positions()[0], 1);
    Runner b(plan, freespace.lookouts().positions()[5], 2);
    GroupState state;
    Outlook outlook;
    const long before = test::allocations();
    for (int i = 0; i < 60; ++i) {
        const double time = group_frame * i;
        const TimedPose poses[] = {{time, a.next(static_cast<float>(group_frame)), true},
                                   {time, b.next(static_cast<float>(group_frame)), true}};
        const Window windows[] = {{poses, 1}, {poses + 1, 1}};
        (void)step(freespace, {}, windows, time, state, outlook);
    }
    EXPECT_EQ(test::allocations() - before, 0);
}

// Two players who run about, as recorded, and how far ahead they are known.
class Recorded {
  public:
    Recorded(const test::Plan& plan, const freespace::Freespace& freespace, int frames) {
        Runner a(plan, freespace.lookouts().positions()[0], 1);
        Runner b(plan, freespace.lookouts().positions()[5], 2);
        for (int i = 0; i < frames; ++i) {
            first.push_back({group_frame * i, a.next(static_cast<float>(group_frame)), true});
            second.push_back({group_frame * i, b.next(static_cast<float>(group_frame)), true});
        }
    }

    [[nodiscard]] std::array<Window, 2> until(std::size_t frame) const {
        const std::size_t count = std::min(frame + 1, first.size());
        return {Window(first).first(count), Window(second).first(count)};
    }

    std::vector<TimedPose> first, second;
};

TEST(GroupShot, IsTheSameWhateverItsOutlookRemembers) {
    const test::Plan plan = test::figure_eight();
    const freespace::Freespace freespace = plan.freespace();
    const Recorded recorded(plan, freespace, 400);
    GroupState kept_state;
    GroupState fresh_state;
    Outlook kept;
    for (std::size_t i = 0; i + 180 < 400; ++i) {
        const auto windows = recorded.until(i + 180);
        const double time = group_frame * static_cast<double>(i);
        const auto fresh = std::make_unique<Outlook>();
        const Camera camera = step(freespace, {}, windows, time, kept_state, kept);
        const Camera twin = step(freespace, {}, windows, time, fresh_state, *fresh);
        ASSERT_EQ(camera.position, twin.position) << "frame " << i;
        ASSERT_EQ(camera.orientation.coeffs(), twin.orientation.coeffs()) << "frame " << i;
    }
}

TEST(GroupShot, KeepsWhoIsAboutToJumpInThePicture) {
    const test::Plan plan = hall();
    const freespace::Freespace freespace = plan.freespace();
    std::vector<TimedPose> first;
    std::vector<TimedPose> second;
    constexpr int jump = 60;
    for (int i = 0; i < 200; ++i) {
        first.push_back({group_frame * i, pose_at(plan.eye(2, 4), 0.0F), true});
        second.push_back({group_frame * i, pose_at(i < jump ? plan.eye(2, 5) : plan.eye(4, 1), 0.0F), true});
        second.back().pose.discontinuity = i == jump;
    }
    GroupState state;
    Outlook outlook;
    for (std::size_t i = 0; i < jump; ++i) {
        const std::array<Window, 2> windows = {Window(first), Window(second)};
        const Camera camera =
            step(freespace, {}, windows, group_frame * static_cast<double>(i), state, outlook);
        EXPECT_TRUE(flagged(camera, target_visible)) << "frame " << i;
    }
}

// Where the picture cannot hold a hidden one as well.
TEST(GroupShot, KeepsWhoIsSeenInThePictureWhereAnotherOneHides) {
    const test::Plan plan({"############################",  //
                           "#......##........##........#",  //
                           "#......##........##........#",  //
                           "#......##........##........#",  //
                           "############################"});
    CheckedGroup shot(plan);
    Poses poses = {pose_at(plan.eye(2, 13), 0.0F), pose_at(plan.eye(2, 12), 0.0F)};
    Camera camera;
    for (int i = 0; i < 30; ++i)
        camera = shot.step(poses);
    ASSERT_TRUE(flagged(camera, target_visible));
    const bool is_left = camera.position.x() < poses[0]->eye.x();
    ASSERT_GT(std::abs(camera.position.x() - poses[0]->eye.x()),
              std::abs(camera.position.y() - poses[0]->eye.y()));
    poses[1] = pose_at(plan.eye(2, is_left ? 2 : 24), 0.0F);  // behind it
    for (int i = 0; i < 60; ++i) {
        poses[0]->eye.y() += 0.5F;
        poses[1]->discontinuity = i == 0;
        camera = shot.step(poses);
        EXPECT_TRUE(flagged(camera, searching) && !flagged(camera, held)) << "frame " << i;
    }
    EXPECT_EQ(shot.cuts(), 1);
}

// One runs to and fro, close by where the camera stands, and the other is in a room of their own.
TEST(GroupShot, DoesNotWhirlRoundForOneOfTwoWhoPassesCloseBy) {
    const test::Plan plan({"##############",  //
                           "#........##..#",  //
                           "#........##..#",  //
                           "#........##..#",  //
                           "##############"});
    CheckedGroup shot(plan);
    Poses poses = {pose_at(plan.eye(2, 2), 0.0F), pose_at(plan.eye(2, 11), 0.0F)};
    Camera before = shot.step(poses);
    float fastest = 0.0F;  // rad/s: who runs, seen from the camera
    for (int i = 1; i < 600; ++i) {
        const Vec3f eye_before = poses[0]->eye;
        poses[0]->eye.x() = plan.eye(2, 4).x() + 180.0F * std::sin(0.03F * static_cast<float>(i));
        const Camera camera = shot.step(poses);
        if (!flagged(camera, cut)) {
            fastest = std::max(
                fastest,
                angle_between(poses[0]->eye - camera.position, eye_before - camera.position) * 60.0F);
            EXPECT_LE(before.orientation.angularDistance(camera.orientation) * 60.0F,
                      201.0F * radians_of_a_degree<float>)
                << "frame " << i;
        }
        before = camera;
    }
    EXPECT_GT(fastest, 300.0F * radians_of_a_degree<float>);
}

TEST(GroupShot, KeepsOneOfTwoWhoAreTooFarApartForThePicture) {
    const test::Plan plan = hall();
    CheckedGroup shot(plan);
    Poses poses = {pose_at(plan.eye(2, 4), 0.0F), pose_at(plan.eye(2, 5), 0.0F)};
    for (int i = 0; i < 20; ++i)
        ASSERT_TRUE(flagged(shot.step(poses), target_visible));
    poses = {pose_at(plan.eye(1, 1), 0.0F), pose_at(plan.eye(4, 8), 0.0F)};
    constexpr int turned = 15;  // frames
    for (int i = 0; i < 60; ++i) {
        for (auto& pose : poses)
            pose->discontinuity = i == 0;
        const Camera camera = shot.step(poses);
        EXPECT_TRUE(i < turned || !flagged(camera, held)) << "frame " << i;
        EXPECT_TRUE(i != turned || flagged(camera, searching)) << "one of them";
    }
}

// The first one hides for a moment, the second one for long.
TEST(GroupShot, WaitsForWhoIsKnownToComeBackAtOnce) {
    const test::Plan plan({"############################",  //
                           "#..#......#......#.....#...#",  //
                           "#..#......#......#.....#...#",  //
                           "#..#......#......#.....#...#",  //
                           "############################"});
    const freespace::Freespace freespace = plan.freespace();
    constexpr int leaves = 60;
    constexpr int hides = 120;
    constexpr int is_back = 132;
    std::vector<TimedPose> first;
    std::vector<TimedPose> second;
    for (int i = 0; i < 400; ++i) {
        const bool is_hidden = i >= hides && i < is_back;
        first.push_back({group_frame * i, pose_at(plan.eye(2, is_hidden ? 2 : 5), 0.0F), true});
        second.push_back({group_frame * i, pose_at(plan.eye(2, i < leaves ? 7 : 25), 0.0F), true});
        first.back().pose.discontinuity = i == hides || i == is_back;
        second.back().pose.discontinuity = i == leaves;
    }
    GroupState state;
    Outlook outlook;
    for (int i = 0; i < 200; ++i) {
        const auto known = static_cast<std::size_t>(i) + 180;
        const std::array<Window, 2> windows = {Window(first).first(known), Window(second).first(known)};
        const Camera camera = step(freespace, {}, windows, group_frame * i, state, outlook);
        EXPECT_EQ(flagged(camera, cut), i == 0) << "frame " << i;
    }
}

struct Clock {
    const char* name;
    double frame, first;  // s
    bool is_known;        // the future
    double patience;      // s: until the empty picture is left, with the next decision

    friend void PrintTo(const Clock& clock, std::ostream* out) { *out << clock.name; }
};
class EmptyPicture : public testing::TestWithParam<Clock> {};
INSTANTIATE_TEST_SUITE_P(GroupShot, EmptyPicture,
                         testing::Values(Clock{"Live", group_frame, 0.0, false, 0.35},
                                         Clock{"Known", group_frame, 0.0, true, 0.15},
                                         // Always just before an instant that is asked about.
                                         Clock{"KnownAt20Hz", 0.05, 0.045, true, 0.21}),
                         [](const auto& info) { return info.param.name; });

// Two are shown until they jump at 2 s, one to `first` and the other to `second`, where no place shows both.
void expect_left_for(const Vec3f& seen_then, const test::Plan& plan, const Vec3f& first,
                     const Vec3f& second) {
    const freespace::Freespace freespace = plan.freespace();
    const Clock& clock = EmptyPicture::GetParam();
    constexpr double jump = 2.0;  // s
    std::vector<TimedPose> one;
    std::vector<TimedPose> other;
    for (double time = clock.first; time < 7.0; time += clock.frame) {
        const bool is_before = time < jump;
        one.push_back({time, pose_at(is_before ? plan.eye(2, 5) : first, 0.0F), true});
        other.push_back({time, pose_at(is_before ? plan.eye(2, 7) : second, 0.0F), true});
        one.back().pose.discontinuity = other.back().pose.discontinuity =
            !is_before && time < jump + clock.frame;
    }
    const auto ahead = clock.is_known ? static_cast<std::size_t>(3.0 / clock.frame) : 1;
    GroupState state;
    Outlook outlook;
    for (std::size_t i = 0; one[i].time < jump + 1.5; ++i) {
        const std::array<Window, 2> windows = {Window(one).first(i + ahead), Window(other).first(i + ahead)};
        const Camera camera = step(freespace, {}, windows, one[i].time, state, outlook);
        if (one[i].time >= jump && one[i].time < jump + clock.patience) continue;
        EXPECT_FALSE(flagged(camera, held)) << one[i].time;
        const Vec3f& seen = one[i].time < jump ? one[i].pose.eye : seen_then;
        EXPECT_TRUE(plan.segment_clear(camera.position, seen)) << one[i].time;
    }
}

// Where nobody is left in it: sooner where that is known to last.
TEST_P(EmptyPicture, IsSoonLeftForWhoMattersMore) {
    const test::Plan plan({"##############",  //
                           "#..#......#..#",  //
                           "#..#......#..#",  //
                           "#..#......#..#",  //
                           "##############"});
    expect_left_for(plan.eye(2, 1), plan, plan.eye(2, 1), plan.eye(2, 12));
}

TEST_P(EmptyPicture, IsSoonLeftForTheOtherWhereNothingShowsWhoMattersMore) {
    const test::Plan plan({"##############",  //
                           "####......#..#",  //
                           "####......#..#",  //
                           "####......#..#",  //
                           "##############"});
    const Vec3f in_the_wall = plan.eye(2, 1);
    expect_left_for(plan.eye(2, 12), plan, in_the_wall, plan.eye(2, 12));
}

// A cut to one of them, who are all hidden now, may not keep the camera from where they all are soon.
TEST(GroupShot, WaitsWhereAllAreShownSoonRatherThanCutToWhoMattersMore) {
    const test::Plan plan({"##############",  //
                           "#..#......#..#",  //
                           "#..#......#..#",  //
                           "#..#......#..#",  //
                           "##############"});
    const freespace::Freespace freespace = plan.freespace();
    constexpr int away = 160;
    constexpr int back = 196;  // 0.5 s after the camera would cut to the one who matters more
    std::vector<TimedPose> first;
    std::vector<TimedPose> second;
    for (int i = 0; i < 460; ++i) {
        const bool together = i < away || i >= back;
        first.push_back({group_frame * i, pose_at(together ? plan.eye(2, 5) : plan.eye(2, 1), 0.0F), true});
        second.push_back({group_frame * i, pose_at(together ? plan.eye(2, 7) : plan.eye(2, 12), 0.0F), true});
        first.back().pose.discontinuity = second.back().pose.discontinuity = i == away || i == back;
    }
    GroupState state;
    Outlook outlook;
    for (std::size_t i = 0; i < 270; ++i) {
        const std::array<Window, 2> windows = {Window(first).first(i + 180), Window(second).first(i + 180)};
        const Camera camera =
            step(freespace, {}, windows, group_frame * static_cast<double>(i), state, outlook);
        EXPECT_EQ(flagged(camera, target_visible), i < away || i >= back) << "frame " << i;
        EXPECT_EQ(flagged(camera, cut), i == 0) << "frame " << i;
    }
}

// A cut to where all are soon, made early enough that the next one may follow in time: nothing is lost of
// what lasts for less than the shortest shot.
TEST(GroupShot, CutsEarlyToWhereAllAreShownForAMoment) {
    const test::Plan plan({"############################",  //
                           "#......#..#..#......#......#",  //
                           "#......#..#..#......#......#",  //
                           "#......#..#..#......#......#",  //
                           "############################"});
    const freespace::Freespace freespace = plan.freespace();
    struct Stay {
        int until;  // frame
        std::size_t first, second;
    };
    constexpr Stay stays[] = {{60, 2, 4}, {114, 8, 11}, {138, 15, 17}, {400, 22, 24}};
    std::vector<TimedPose> first;
    std::vector<TimedPose> second;
    for (const Stay& stay : stays)
        for (bool jumps = true; static_cast<int>(first.size()) < stay.until; jumps = false) {
            const double time = group_frame * static_cast<double>(first.size());
            first.push_back({time, pose_at(plan.eye(2, stay.first), 0.0F), true});
            second.push_back({time, pose_at(plan.eye(2, stay.second), 0.0F), true});
            first.back().pose.discontinuity = second.back().pose.discontinuity = jumps;
        }
    GroupState state;
    Outlook outlook;
    for (int i = 0; i < 200; ++i) {
        const auto known = static_cast<std::size_t>(i) + 180;
        const std::array<Window, 2> windows = {Window(first).first(known), Window(second).first(known)};
        const Camera camera = step(freespace, {}, windows, group_frame * i, state, outlook);
        EXPECT_EQ(flagged(camera, target_visible), i < stays[0].until || i >= stays[1].until)
            << "frame " << i;
    }
}

TEST(Members, OfARecordedFutureAreThoseOfWholeTwentieths) {
    const test::Plan plan = hall();
    const freespace::Freespace freespace = plan.freespace();
    std::vector<TimedPose> poses;
    for (int i = 0; i <= 100; ++i) {
        Pose pose = pose_at(plan.eye(2, 3), 0.0F);
        pose.eye.x() += 10.0F * static_cast<float>(i) * 0.05F;  // 10 units a second
        poses.push_back({0.05 * i, pose, true});
    }
    const float begin = poses[0].pose.eye.x();
    for (const double time : {1.0, 1.02, 1.0999, 2.05}) {
        const std::array<Window, 1> windows = {Window(poses)};
        const Members members = members_at(freespace, windows, time);
        EXPECT_TRUE(members.is_recorded);
        ASSERT_EQ(members.known, Members::most);
        EXPECT_EQ(members.ahead[0], 0.0F);
        for (std::size_t i = 1; i < members.known; ++i) {
            const double then = 0.05 * static_cast<double>(members.first + static_cast<std::int64_t>(i));
            EXPECT_GE(members.ahead[i], members.ahead[i - 1]);
            EXPECT_NEAR(members.ahead[i], then - time, 1e-5);
            EXPECT_NEAR(members.at[i].eyes[0].x(), begin + 10.0 * then, 1e-2);
        }
    }
    // The clocks of directors that began at different frames differ by whole tenths.
    for (std::int64_t tenth = 10; tenth < 25; ++tenth) {
        const std::array<Window, 1> windows = {Window(poses)};
        const Members members =
            members_at(freespace, windows, static_cast<double>(tenth * 100'000'000) * 1e-9);
        EXPECT_EQ(members.first, 2 * tenth);
    }
    // 0.5 s are known: after that the player is taken to run on.
    const std::array<Window, 1> windows = {Window(poses).first(31)};
    const Members members = members_at(freespace, windows, 1.0);
    EXPECT_FALSE(members.is_recorded);
    ASSERT_EQ(members.known, 4U);
    EXPECT_FLOAT_EQ(members.ahead[3], 0.6F);
    EXPECT_EQ(members.until(0.4F), 3U);
}

}  // namespace
}  // namespace camdir::camera
