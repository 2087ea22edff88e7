// The cameras of whole runs, bit for bit: the same for every compiler, optimisation and sanitizer. The C
// library computes sines and the like, in other ways on other processors: these are Debian 12's on x86-64
// with FMA.
#include <gtest/gtest.h>

#include <cstring>

#include "walk.hpp"

namespace camdir::camera {
namespace {

// FNV-1a.
class Hash {
  public:
    template <class Value>
    void add(const Value& value) {
        unsigned char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        for (const unsigned char byte : bytes)
            value_ = (value_ ^ byte) * 0x100000001b3U;
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0xcbf29ce484222325U;
};

std::uint64_t hash_of_run(const test::Plan& plan, Solver solver, double rate, double look_ahead) {
    const freespace::Freespace freespace = plan.freespace();
    Runner runner(plan, plan.eye('s'), 7);
    std::vector<TimedPose> poses;
    for (int i = 0; i < static_cast<int>(6.0 * rate); ++i)
        poses.push_back({i / rate, runner.next(static_cast<float>(1.0 / rate)), true});

    Hash hash;
    Scratch scratch(freespace);
    ShotState state;
    state.time = -1.0 / rate;
    const auto ahead = static_cast<std::size_t>(look_ahead * rate);
    for (std::size_t i = 0; i + ahead < poses.size(); ++i) {
        const std::size_t first = i - std::min<std::size_t>(i, 20);
        const Camera camera =
            step(freespace, solved_by(solver), Window(poses).subspan(first, i + ahead + 1 - first),
                 poses[i].time, state, scratch);
        for (const float number : camera.position)
            hash.add(number);
        for (const float number : camera.orientation.coeffs())
            hash.add(number);
        hash.add(camera.clearance);
        hash.add(camera.flags);
    }
    return hash.value();
}

struct GoldenRun {
    const char* name;
    Solver solver;
    double rate;
    double look_ahead;
    std::uint64_t hash;
};

// Whoever changes cameras on purpose puts the new hashes here.
bool is_reference_machine() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("fma") != 0;
#else
    return false;
#endif
}

TEST(Golden, CamerasAreTheSameWhateverCompilesThem) {
    if (!is_reference_machine()) GTEST_SKIP() << "needs an x86-64 processor with FMA";
    for (const auto& [name, solver, rate, look_ahead, hash] :
         {GoldenRun{"paper", Solver::paper, 60.0, 0.0, 0x5eea353a20ab6744},
          GoldenRun{"planner", Solver::planner, 60.0, 0.0, 0x489b0de81168fa93},
          GoldenRun{"planner, 20 Hz", Solver::planner, 20.0, 0.0, 0xabac99e400d6a286},
          GoldenRun{"planner, 1 s", Solver::planner, 60.0, 1.0, 0xf10e8eee6a32cada}})
        EXPECT_EQ(hash_of_run(test::figure_eight(), solver, rate, look_ahead), hash) << name;
}

}  // namespace
}  // namespace camdir::camera
