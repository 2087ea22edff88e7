// Cameras among doors, lifts and crushers at 60 Hz: never in one, never through one without a cut, and what
// is behind one is not seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "camera/evade.hpp"
#include "camera/group/group_shot.hpp"
#include "freespace/movers.hpp"
#include "support/allocations.hpp"
#include "support/mover_twins.hpp"
#include "walk.hpp"

namespace camdir::camera {
namespace {

using freespace::MoverPose;
using freespace::Movers;
using freespace::MoverShape;
using test::box_hull;
using test::PlacedMover;

constexpr double frame_s = 1.0 / 60.0;
constexpr double delay = 1.0;  // s, of shots with look-ahead

// Where a mover is at a time, s.
using MoverMotion = std::function<MoverPose(double)>;

MoverShape box_mover(const std::string& name, const Vec3f& min, const Vec3f& max) {
    MoverShape shape;
    shape.name = name;
    shape.hulls.push_back(box_hull(min, max));
    return shape;
}

// 0 .. 1 .. 0 ..: `pause` s at each end, `travel` s between them.
float there_and_back(double time, double pause, double travel) {
    const double phase = std::fmod(time, 2.0 * (pause + travel));
    const double on_the_way = phase < pause + travel ? phase : phase - (pause + travel);
    const double share = std::clamp((on_the_way - pause) / travel, 0.0, 1.0);
    return static_cast<float>(phase < pause + travel ? share : 1.0 - share);
}

struct Scene {
    test::Plan plan;
    std::vector<MoverShape> shapes;
    std::vector<MoverMotion> motions;
    std::function<Pose(double)> player;
};

// Two rooms with a door of 16 x 128 x 128 units in the wall of 64 between them.
test::Plan rooms_with_a_doorway() {
    return test::Plan({"#############",  //
                       "#.....#.....#",  //
                       "#.....#.....#",  //
                       "#.s.......t.#",  //
                       "#...........#",  //
                       "#.....#.....#",  //
                       "#.....#.....#",  //
                       "#############"});
}

constexpr float doorway_x = 6.5F * 64.0F;
constexpr float doorway_y = 4.0F * 64.0F;

MoverShape doorway_door() {
    return box_mover("*1", {-8, -66, -2}, {8, 66, 130});
}

// Runs along the doorway's axis from the middle of one room to that of the other, and back.
Pose running_to_and_fro(double time, double period, double offset) {
    const double phase = std::fmod(time + offset, period) / period;
    const auto share = static_cast<float>(phase < 0.5 ? 2.0 * phase : 2.0 - 2.0 * phase);
    return pose_at({150.0F + share * 530.0F, doorway_y, 54.0F},
                   phase < 0.5 ? 0.0F : std::numbers::pi_v<float>);
}

// Slides up: open from 1.65 to 2.95 s, closed from 3.3 s on. The player goes through at `passing`.
Scene sliding_door(double passing) {
    return {rooms_with_a_doorway(),
            {doorway_door()},
            {[](double time) {
                const float open = there_and_back(time, 1.3, 0.35);
                return MoverPose{0, {doorway_x, doorway_y, 128.0F * open}, Quatf::Identity()};
            }},
            [passing](double time) { return running_to_and_fro(time, 6.6, 8.25 - passing); }};
}

// The same door, closing behind a player who then stands.
Scene door_between_camera_and_player() {
    Scene scene = sliding_door(2.3);
    scene.motions[0] = [](double time) {
        const float open = time < 1.0 ? 1.0F : 1.0F - static_cast<float>(std::min((time - 1.0) / 0.3, 1.0));
        return MoverPose{0, {doorway_x, doorway_y, 128.0F * open}, Quatf::Identity()};
    };
    scene.player = [](double time) {
        const float x = std::min(200.0F + 320.0F * static_cast<float>(time), doorway_x + 60.0F);
        return pose_at({x, doorway_y, 54.0F}, 0.0F);
    };
    return scene;
}

// Turns about a hinge at one side of the doorway; the player goes through while it is open.
Scene rotating_door() {
    return {rooms_with_a_doorway(),
            {box_mover("*1", {-6, 0, -2}, {6, 126, 130})},
            {[](double time) {
                const float open = there_and_back(time, 1.5, 0.8);
                const Eigen::AngleAxisf turn(-0.5F * std::numbers::pi_v<float> * open, Vec3f::UnitZ());
                return MoverPose{0, {doorway_x, doorway_y - 63.0F, 0.0F}, Quatf(turn)};
            }},
            [](double time) { return running_to_and_fro(time, 9.2, 8.2); }};
}

// A platform of 128 x 128 x 16 units goes up and down in a large room; the player rides it, or runs below.
Scene lift(bool on_it) {
    std::vector<std::string> rows(16, "#..............#");
    rows.front() = rows.back() = std::string(16, '#');
    Scene scene{test::Plan(rows, 64.0F, 256.0F), {box_mover("*1", {-64, -64, -16}, {64, 64, 0})}, {}, {}};
    const Vec3f centre(512, 512, 0);
    const auto place = [centre](double time) {
        return Vec3f(centre + (20.0F + 130.0F * there_and_back(time, 1.0, 0.8)) * Vec3f::UnitZ());
    };
    scene.motions.push_back([place](double time) { return MoverPose{0, place(time), Quatf::Identity()}; });
    scene.player = [on_it, centre, place](double time) {
        const auto angle = static_cast<float>(time);
        const Vec3f round(std::cos(angle), std::sin(angle), 0.0F);
        if (on_it) return pose_at(place(time) + Vec3f(30.0F * round + 50.0F * Vec3f::UnitZ()), angle);
        return pose_at(centre + Vec3f(110.0F * round + 54.0F * Vec3f::UnitZ()), 3.0F * angle);
    };
    return scene;
}

// A block as wide as the corridor comes along it, to `end`, over where the camera stands behind a player who
// stands at the corridor's end, and goes back.
Scene crusher(float end) {
    return {test::Plan({"################",  //
                        "#..............#",  //
                        "#s............t#",  //
                        "################"}),
            {box_mover("*1", {-48, -68, -2}, {48, 68, 130})},
            {[end](double time) {
                const float x = 120.0F + (end - 48.0F - 120.0F) * there_and_back(time, 1.0, 1.0);
                return MoverPose{0, {x, 128.0F, 0.0F}, Quatf::Identity()};
            }},
            [](double) {
                return pose_at({900.0F, 128.0F, 54.0F}, 0.0F);
            }};
}

struct Findings {
    int frames = 0;
    int inside = 0;
    int passages = 0;
    int wrong_sights = 0;
    int cuts = 0;
    int seen = 0;
    float least_clearance = std::numeric_limits<float>::infinity();
};

// What the exact movers say of cameras that come one after the other.
class Judge {
  public:
    explicit Judge(const Scene& scene) : scene_(scene) {
        for (const MoverShape& shape : scene.shapes)
            movers_.emplace_back(shape, Vec3d::Zero(), Eigen::Quaterniond::Identity());
    }

    void look_at(const Camera& camera, double time, std::span<const Vec3f> eyes) {
        ASSERT_TRUE(camera.position.allFinite());
        ASSERT_TRUE(camera.orientation.coeffs().allFinite());
        ++findings.frames;
        const bool cuts = (camera.flags & cut) != 0;
        findings.cuts += cuts ? 1 : 0;
        const std::vector<PlacedMover> movers = placed_at(time);
        for (const PlacedMover& mover : movers) {
            const double distance = mover.distance(camera.position.cast<double>());
            findings.least_clearance = std::min(findings.least_clearance, static_cast<float>(distance));
            findings.inside += distance == 0.0 ? 1 : 0;
        }
        if (!cuts && placed_) {
            findings.passages += passes(camera.position, time) ? 1 : 0;
            EXPECT_TRUE(scene_.plan.segment_clear(position_, camera.position));
        }
        EXPECT_GT(scene_.plan.clearance(camera.position), 0.0F);
        if ((camera.flags & target_visible) != 0) {
            ++findings.seen;
            for (const Vec3f& eye : eyes)
                findings.wrong_sights += hidden(movers, camera.position, eye) ? 1 : 0;
        }
        position_ = camera.position;
        time_ = time;
        placed_ = true;
    }

    Findings findings;

  private:
    static constexpr int samples = 30;

    [[nodiscard]] std::vector<PlacedMover> placed_at(double time) const {
        std::vector<PlacedMover> placed = movers_;
        for (std::size_t i = 0; i < placed.size(); ++i) {
            const MoverPose pose = scene_.motions[i](time);
            placed[i].place(pose.position.cast<double>(), pose.orientation.cast<double>());
        }
        return placed;
    }

    // Instant by instant, while the movers move.
    [[nodiscard]] bool passes(const Vec3f& to, double time) const {
        for (int k = 0; k <= samples; ++k) {
            const float share = static_cast<float>(k) / samples;
            const Vec3d point = (position_ + share * (to - position_)).cast<double>();
            for (const PlacedMover& mover : placed_at(time_ + (time - time_) * k / samples))
                if (mover.contains(point)) return true;
        }
        return false;
    }
    [[nodiscard]] static bool hidden(const std::vector<PlacedMover>& movers, const Vec3f& from,
                                     const Vec3f& to) {
        for (int k = 0; k <= 10 * samples; ++k) {
            const Vec3f point = from + static_cast<float>(k) / (10 * samples) * (to - from);
            for (const PlacedMover& mover : movers)
                if (mover.contains(point.cast<double>())) return true;
        }
        return false;
    }

    const Scene& scene_;
    std::vector<PlacedMover> movers_;
    Vec3f position_ = Vec3f::Zero();
    double time_ = 0.0;
    bool placed_ = false;
};

// The movers of a scene as a game server tells them, frame by frame.
class ToldMovers {
  public:
    explicit ToldMovers(const Scene& scene) : scene_(scene), movers_(*Movers::of(scene.shapes)) {}

    // All that is known at `time`; nobody asks for what was 0.5 s before `asked`.
    const Movers& until(double time, double asked) {
        for (; told_ * frame_s <= time + 1e-9; ++told_) {
            std::vector<MoverPose> poses;
            for (const MoverMotion& motion : scene_.motions)
                poses.push_back(motion(told_ * frame_s));
            EXPECT_EQ(movers_.add(told_ * frame_s, poses), 0U);
        }
        movers_.forget_before(asked - 0.5);
        return movers_;
    }

  private:
    const Scene& scene_;
    Movers movers_;
    int told_ = 0;
};

std::vector<TimedPose> poses_of(const Scene& scene, double until) {
    std::vector<TimedPose> poses;
    for (int i = 0; i * frame_s < until; ++i) {
        const double time = i * frame_s;
        poses.push_back({time, scene.player(time), true});
        if (i > 0)
            poses.back().pose.velocity =
                (poses.back().pose.eye - poses[poses.size() - 2].pose.eye) / static_cast<float>(frame_s);
    }
    return poses;
}

Findings run(const Scene& scene, Solver solver, double look_ahead, double seconds = 10.0) {
    const freespace::Freespace freespace = scene.plan.freespace();
    const std::vector<TimedPose> poses = poses_of(scene, seconds + look_ahead);
    ToldMovers movers(scene);
    Scratch scratch(freespace);
    ShotState state;
    state.time = -frame_s;
    Judge judge(scene);
    const auto ahead = static_cast<std::size_t>(std::lround(look_ahead / frame_s));
    for (std::size_t i = 0; i + ahead < poses.size(); ++i) {
        const std::size_t first = i - std::min<std::size_t>(i, 20);
        const freespace::Space space(freespace, &movers.until(poses[i + ahead].time, poses[i].time));
        const long before = test::allocations();
        const Camera camera =
            step(space, solved_by(solver), Window(poses).subspan(first, i + ahead + 1 - first), poses[i].time,
                 state, scratch);
        EXPECT_EQ(test::allocations(), before);
        judge.look_at(camera, poses[i].time, {&poses[i].pose.eye, 1});
    }
    return judge.findings;
}

void expect_kept(const Findings& found) {
    EXPECT_EQ(found.inside, 0);
    EXPECT_EQ(found.passages, 0);
    EXPECT_EQ(found.wrong_sights, 0);
}

void expect_kept(const Scene& scene, int most_cuts) {
    for (const Solver solver : {Solver::planner, Solver::paper})
        for (const double look_ahead : {0.0, delay}) {
            SCOPED_TRACE(testing::Message() << name_of(solver) << ", look-ahead " << look_ahead << " s");
            const Findings found = run(scene, solver, look_ahead);
            expect_kept(found);
            EXPECT_GT(found.least_clearance, 4.4F) << "the profile's is 4.5";
            EXPECT_GT(found.seen, found.frames / 2);
            EXPECT_LE(found.cuts, most_cuts);
        }
}

TEST(AmongMovers, ASlidingDoor) {
    for (const double passing : {1.8, 2.3, 2.9, 3.2}) {
        SCOPED_TRACE(testing::Message() << "passing at " << passing << " s");
        expect_kept(sliding_door(passing), 8);
    }
}

TEST(AmongMovers, ADoorThatClosesBehindThePlayer) {
    expect_kept(door_between_camera_and_player(), 1);
}

TEST(AmongMovers, ARotatingDoor) {
    expect_kept(rotating_door(), 6);
}

TEST(AmongMovers, ALiftThatCarriesThePlayer) {
    expect_kept(lift(true), 1);
}

TEST(AmongMovers, ALiftOverThePlayer) {
    expect_kept(lift(false), 1);
}

TEST(AmongMovers, ACrusher) {
    expect_kept(crusher(818.0F), 1);
}

// Wherever the camera is held: the block leaves it no place at the end of the corridor.
TEST(AmongMovers, ACrusherOverADeadPlayer) {
    Scene scene = crusher(960.0F);
    scene.player = [](double time) {
        Pose pose = pose_at({900.0F, 128.0F, 54.0F}, 0.0F);
        pose.alive = time < 1.0;
        return pose;
    };
    for (const Solver solver : {Solver::planner, Solver::paper}) {
        SCOPED_TRACE(name_of(solver));
        const Findings found = run(scene, solver, 0.0, 6.0);
        expect_kept(found);
        EXPECT_GT(found.cuts, 1);
    }
}

Scene ball_round_the_player(float radius) {
    Scene scene{rooms_with_a_doorway(), {}, {}, {}};
    MoverShape ball;
    ball.name = "ball";
    ball.balls.push_back({Vec3f::Zero(), radius});
    scene.shapes.push_back(ball);
    const Vec3f eye = scene.plan.eye('s');
    scene.motions.emplace_back([eye](double) { return MoverPose{0, eye, Quatf::Identity()}; });
    scene.player = [eye](double) { return pose_at(eye, 0.0F); };
    return scene;
}

// However many places near the player it covers.
TEST(AmongMovers, ABallThatFillsTheRoomLeavesTheOther) {
    const Scene scene = ball_round_the_player(420.0F);
    for (const Solver solver : {Solver::planner, Solver::paper}) {
        SCOPED_TRACE(name_of(solver));
        expect_kept(run(scene, solver, 0.0, 3.0));
    }
}

// A way out is not looked for in every frame where there is none.
TEST(AmongMovers, ABallOverTheWholeMapIsNotCutAwayFromAllTheTime) {
    const Scene scene = ball_round_the_player(1e5F);
    for (const Solver solver : {Solver::planner, Solver::paper}) {
        SCOPED_TRACE(name_of(solver));
        const Findings found = run(scene, solver, 0.0, 3.0);
        EXPECT_GT(found.cuts, 1);
        EXPECT_LT(found.cuts, 20);
    }
}

// Behind the door there is no way to the player, nor any sight of them.
TEST(AmongMovers, AClosedDoorHidesThePlayer) {
    Scene scene = sliding_door(2.3);
    scene.motions[0] = [](double) { return MoverPose{0, {doorway_x, doorway_y, 0.0F}, Quatf::Identity()}; };
    const freespace::Freespace freespace = scene.plan.freespace();
    ToldMovers movers(scene);
    const freespace::Space space = freespace::Space(freespace, &movers.until(1.0, 0.0)).at(1.0);
    const Vec3f s = scene.plan.eye('s');
    const Vec3f t = scene.plan.eye('t');
    EXPECT_TRUE(freespace::sight(freespace, s, t).clear);
    EXPECT_FALSE(freespace::sight(space, s, t).clear);
    EXPECT_NEAR(freespace::sight(space, s, t).free_length, doorway_x - 8.0F - s.x(), 0.1F);
    freespace::RoadmapSearch roadmap(freespace);
    EXPECT_TRUE(roadmap.find(s, t).found);
    EXPECT_FALSE(roadmap.find(s, t, space).found);
    EXPECT_TRUE(roadmap.find(s, s + Vec3f(64, 0, 0), space).found);
    EXPECT_FALSE(freespace::distance(space, {doorway_x, doorway_y, 64.0F}).covered());
    EXPECT_LE(freespace::distance(space, {doorway_x - 20.0F, doorway_y, 64.0F}).value, 12.0F);
}

TEST(AmongMovers, WithoutAPoseTheyChangeNothing) {
    const Scene scene = sliding_door(2.3);
    const freespace::Freespace freespace = scene.plan.freespace();
    const Movers silent = *Movers::of(scene.shapes);
    Scratch scratch(freespace);
    ShotState with;
    ShotState without;
    for (int i = 0; i < 300; ++i) {
        const Pose pose = scene.player(i * frame_s);
        const freespace::Space space(freespace, &silent);
        const Camera a = step(space, {}, &pose, frame_s, with, scratch);
        const Camera b = step(freespace, {}, &pose, frame_s, without, scratch);
        ASSERT_EQ(a.position, b.position);
        ASSERT_EQ(a.orientation.coeffs(), b.orientation.coeffs());
        ASSERT_EQ(a.flags, b.flags);
    }
}

// A group shot of two: the scene's player and one who stands at `other`.
Findings run_group(const Scene& scene, const Vec3f& other, double look_ahead) {
    const freespace::Freespace freespace = scene.plan.freespace();
    const std::vector<TimedPose> first = poses_of(scene, 10.0 + look_ahead);
    std::vector<TimedPose> second = first;
    for (TimedPose& pose : second)
        pose.pose = pose_at(other, 0.0F);
    ToldMovers movers(scene);
    GroupState state;
    Outlook outlook;
    state.time = -frame_s;
    Judge judge(scene);
    const auto ahead = static_cast<std::size_t>(std::lround(look_ahead / frame_s));
    for (std::size_t i = 0; i + ahead < first.size(); ++i) {
        const freespace::Space space(freespace, &movers.until(first[i + ahead].time, first[i].time));
        const std::array windows = {Window(first).first(i + ahead + 1), Window(second).first(i + ahead + 1)};
        const Camera camera = step(space, {}, windows, first[i].time, state, outlook);
        const std::array eyes = {first[i].pose.eye, other};
        judge.look_at(camera, first[i].time, eyes);
    }
    return judge.findings;
}

TEST(AmongMovers, GroupShots) {
    for (const double look_ahead : {0.0, delay}) {
        SCOPED_TRACE(testing::Message() << "look-ahead " << look_ahead << " s");
        const Scene door = sliding_door(2.3);
        const Findings through_a_door = run_group(door, door.plan.eye('t'), look_ahead);
        expect_kept(through_a_door);
        EXPECT_GT(through_a_door.seen, through_a_door.frames / 4);
        expect_kept(run_group(rotating_door(), door.plan.eye('s'), look_ahead));
        expect_kept(run_group(crusher(818.0F), {860.0F, 150.0F, 54.0F}, look_ahead));
        expect_kept(run_group(lift(false), {400.0F, 512.0F, 54.0F}, look_ahead));
    }
}

}  // namespace
}  // namespace camdir::camera
