// bench-movers: what a step of a shot costs without movers, with movers that are somewhere else, and with
// movers all about the player.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "camera/tracker.hpp"
#include "freespace/movers.hpp"
#include "support/mover_twins.hpp"
#include "support/plan.hpp"

namespace camdir::bench {
namespace {

constexpr double frame = 1.0 / 60.0;
constexpr int frames = 6000;
constexpr int runs = 7;

// Runs round the outer lane of the figure of eight, looking about.
std::vector<camera::TimedPose> a_lap_after_the_other(const test::Plan& plan) {
    const Vec3f corners[] = {plan.eye(1, 2), plan.eye(1, 14), plan.eye(7, 14), plan.eye(7, 2)};
    std::vector<camera::TimedPose> poses;
    double way = 0.0;
    for (int i = 0; i < frames; ++i, way += 320.0 * frame) {
        double left = way;
        std::size_t side = 0;
        const auto length = [&] { return (corners[(side + 1) % 4] - corners[side]).norm(); };
        while (left >= length()) {
            left -= length();
            side = (side + 1) % 4;
        }
        const Vec3f along = (corners[(side + 1) % 4] - corners[side]).normalized();
        camera::Pose pose;
        pose.eye = corners[side] + static_cast<float>(left) * along;
        pose.velocity = 320.0F * along;
        const float glance = 0.5F * std::sin(0.05F * static_cast<float>(i));
        pose.orientation = camera::orientation_of({std::atan2(along.y(), along.x()) + glance, 0.0F});
        poses.push_back({i * frame, pose, true});
    }
    return poses;
}

// 30 doors in a row of 10 x 3, `spacing` apart, that go up and down.
class Doors {
  public:
    Doors(const Vec3f& corner, float spacing) : corner_(corner), spacing_(spacing), movers_(shaped()) {}

    freespace::Movers& at(double time) {
        std::vector<freespace::MoverPose> poses;
        for (std::uint32_t i = 0; i < count; ++i) {
            const Vec3f place(spacing_ * static_cast<float>(i % 10), spacing_ * static_cast<float>(i / 10),
                              100.0F + 40.0F * std::sin(static_cast<float>(time) + static_cast<float>(i)));
            poses.push_back({i, corner_ + place, Quatf::Identity()});
        }
        movers_.add(time, poses);
        movers_.forget_before(time - 0.5);
        return movers_;
    }

  private:
    static constexpr std::uint32_t count = 30;

    static freespace::Movers shaped() {
        std::vector<freespace::MoverShape> shapes(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            shapes[i].name = std::to_string(i);
            shapes[i].hulls.push_back(test::box_hull({-8, -8, 0}, {8, 8, 96}));
        }
        return *freespace::Movers::of(shapes);
    }

    Vec3f corner_;
    float spacing_;
    freespace::Movers movers_;
};

// Microseconds a step: the mean over the steps, of each the least of the runs, which are all the same.
double cost_of_a_step(const freespace::Freespace& freespace, const camera::Profile& profile,
                      std::span<const camera::TimedPose> poses, const Doors* doors) {
    using Microseconds = std::chrono::duration<double, std::micro>;
    std::vector<double> least(poses.size(), std::numeric_limits<double>::infinity());
    camera::Scratch scratch(freespace);
    for (int run = 0; run < runs; ++run) {
        camera::ShotState state;
        state.time = -frame;
        std::optional<Doors> moving;
        if (doors != nullptr) moving = *doors;
        for (std::size_t i = 0; i < poses.size(); ++i) {
            const std::size_t first = i - std::min<std::size_t>(i, 20);
            const freespace::Space space(freespace, moving ? &moving->at(poses[i].time) : nullptr);
            const auto begin = std::chrono::steady_clock::now();
            (void)camera::step(space, profile, poses.subspan(first, i + 1 - first), poses[i].time, state,
                               scratch);
            least[i] = std::min(least[i], Microseconds(std::chrono::steady_clock::now() - begin).count());
        }
    }
    return std::accumulate(least.begin(), least.end(), 0.0) / static_cast<double>(least.size());
}

}  // namespace
}  // namespace camdir::bench

int main() {
    using namespace camdir;
    const test::Plan plan = test::figure_eight();
    const freespace::Freespace freespace = plan.freespace();
    const auto poses = bench::a_lap_after_the_other(plan);
    const bench::Doors far_away({5000, 5000, 0}, 60.0F);
    const bench::Doors all_about({90, 80, 0}, 96.0F);
    std::printf(
        "| solver | us without movers | us with 30 elsewhere | us with 30 all about |\n|---|---|---|---|\n");
    for (const auto solver : {camera::Solver::planner, camera::Solver::paper}) {
        camera::Profile profile;
        profile.solver = solver;
        std::printf("| `%s` | %.2f | %.2f | %.2f |\n",
                    solver == camera::Solver::planner ? "planner" : "paper",
                    bench::cost_of_a_step(freespace, profile, poses, nullptr),
                    bench::cost_of_a_step(freespace, profile, poses, &far_away),
                    bench::cost_of_a_step(freespace, profile, poses, &all_about));
    }
}
