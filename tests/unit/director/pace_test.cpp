#include "director/pace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "stage.hpp"
#include "support/eventually.hpp"
#include "work_for.hpp"

namespace camdir::director {
namespace {

constexpr Pace::Load calm{.taken = 1000, .superseded = 0, .busy = 0.1};

void observe(Pace& pace, const Pace::Load& load, int intervals) {
    for (int i = 0; i < intervals; ++i)
        pace.observe(load);
}

// Intervals until the pace is faster than it is; at most 1000.
int intervals_to_speed_up(Pace& pace, const Pace::Load& load) {
    const std::uint32_t before = pace.frames_per_camera();
    int intervals = 0;
    while (pace.frames_per_camera() >= before && intervals < 1000) {
        pace.observe(load);
        ++intervals;
    }
    return intervals;
}

TEST(PaceTest, TwoIntervalsAreAHiccup) {
    Pace pace;
    for (int i = 0; i < 10; ++i) {
        observe(pace, {.taken = 50, .superseded = 50, .busy = 1.0}, 2);
        observe(pace, calm, 1);
    }
    EXPECT_EQ(pace.frames_per_camera(), 1U);
    observe(pace, {.taken = 990, .superseded = 10, .busy = 0.9}, 10);
    EXPECT_EQ(pace.frames_per_camera(), 1U) << "one in a hundred";
}

TEST(PaceTest, ItSlowsDownByWhatIsMissing) {
    Pace pace;
    observe(pace, {.taken = 450, .superseded = 150, .busy = 1.0}, 3);  // 3 of 4
    EXPECT_EQ(pace.frames_per_camera(), 2U);
    Pace slower;
    observe(slower, {.taken = 200, .superseded = 400, .busy = 1.0}, 3);  // 1 of 3
    EXPECT_EQ(slower.frames_per_camera(), 4U);
    observe(slower, {.taken = 1, .superseded = 1000, .busy = 1.0}, 3);
    EXPECT_EQ(slower.frames_per_camera(), Pace::slowest);
    Pace stuck;
    observe(stuck, {.taken = 0, .superseded = 1000, .busy = 1.0}, 3);
    EXPECT_EQ(stuck.frames_per_camera(), Pace::slowest);
}

TEST(PaceTest, AStallDoesNotCountForMore) {
    Pace pace;
    observe(pace, {.taken = 100, .superseded = 20, .busy = 1.0}, 2);
    observe(pace, {.taken = 10, .superseded = 110, .busy = 1.0}, 1);
    EXPECT_EQ(pace.frames_per_camera(), 2U);
}

TEST(PaceTest, ItSpeedsUpStepByStepWhereThereIsTime) {
    Pace pace;
    observe(pace, {.taken = 200, .superseded = 400, .busy = 1.0}, 3);
    observe(pace, {.taken = 150, .superseded = 0, .busy = 0.6}, 100);  // 0.8 with every third
    EXPECT_EQ(pace.frames_per_camera(), 4U);
    EXPECT_EQ(intervals_to_speed_up(pace, {.taken = 150, .superseded = 0, .busy = 0.3}), 1);
    EXPECT_EQ(pace.frames_per_camera(), 3U);
    observe(pace, calm, 100);
    EXPECT_EQ(pace.frames_per_camera(), 1U);
    observe(pace, calm, 100);
    EXPECT_EQ(pace.frames_per_camera(), 1U);
}

TEST(PaceTest, ItTriesLessOftenWhatHasFailed) {
    Pace pace;
    const Pace::Load late{.taken = 450, .superseded = 150, .busy = 1.0};
    int longest = 0;
    for (int i = 0; i < 10; ++i) {
        observe(pace, late, 3);
        ASSERT_EQ(pace.frames_per_camera(), 2U);
        const int intervals = intervals_to_speed_up(pace, calm);
        EXPECT_GE(intervals, longest);
        longest = intervals;
    }
    EXPECT_EQ(longest, 60);
    observe(pace, calm, 60);
    observe(pace, late, 3);
    EXPECT_EQ(intervals_to_speed_up(pace, calm), 5) << "after a minute without a late frame";
}

// Slowing down may take it below what holds: the steps back to there are no reason to try again sooner.
TEST(PaceTest, StepsBackToWhatHoldsAreNoReasonToTryAgainSooner) {
    Pace pace;
    std::vector<int> tries;
    for (int i = 0; i < 8; ++i) {
        observe(pace, {.taken = 300, .superseded = 300, .busy = 1.0}, 3);
        ASSERT_EQ(pace.frames_per_camera(), 3U);
        tries.push_back(intervals_to_speed_up(pace, calm) + intervals_to_speed_up(pace, calm));
    }
    EXPECT_EQ(tries, (std::vector{10, 20, 40, 80, 120, 120, 120, 120}));
}

// After a burst that made it try in vain, a director is at its full pace again in three minutes, not in
// seven.
TEST(PaceTest, StepsThatHoldAreTakenFaster) {
    Pace pace;
    for (int i = 0; i < 10; ++i) {
        observe(pace, {.taken = 450, .superseded = 150, .busy = 1.0}, 3);
        (void)intervals_to_speed_up(pace, calm);
    }
    observe(pace, {.taken = 1, .superseded = 1000, .busy = 1.0}, 3);
    ASSERT_EQ(pace.frames_per_camera(), Pace::slowest);
    std::vector<int> intervals;
    while (pace.frames_per_camera() > 1)
        intervals.push_back(intervals_to_speed_up(pace, calm));
    EXPECT_EQ(intervals, (std::vector{60, 60, 30, 15, 7, 5, 5}));
}

void wait_for(std::chrono::nanoseconds time) {
    std::this_thread::sleep_for(time);
}

// Takes its time over the cameras of the match `m` while it is slow.
class SlowPublisher final : public MemoryPublisher {
  public:
    explicit SlowPublisher(void (*take)(std::chrono::nanoseconds), std::chrono::milliseconds time)
        : take_(take), time_(time) {}
    using MemoryPublisher::publish;
    void publish(const std::string& match_id, const CameraFrame& frame) override {
        if (is_slow && match_id == "m") take_(time_);
        MemoryPublisher::publish(match_id, frame);
    }

    [[nodiscard]] float rate_hz(const std::string& match_id = "m") const { return shown(match_id)->rate_hz; }

    std::atomic<bool> is_slow{true};

  private:
    void (*const take_)(std::chrono::nanoseconds);
    const std::chrono::milliseconds time_;
};

TEST(PaceTest, AnOverloadedDirectorDeclaresALowerRateAndSpeedsUpAgain) {
    SlowPublisher publisher(wait_for, std::chrono::milliseconds(5));
    MapLibrary maps;
    maps.set_ready("square", Stage::square());
    Director director(Stage::default_config(), maps, publisher);
    director.receive(Stage::info());
    director.receive(Stage::request("a"));
    std::uint32_t number = 0;
    const auto plays_until = [&](const auto& condition) {
        return test::eventually([&] {
            for (int i = 0; i < 4; ++i) {
                PoseFrame frame = Stage::poses(++number);
                frame.source_time =
                    std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
                receive(director, "m", frame);
                if (!publisher.is_slow) director.flush();  // calm, however busy the machine is
            }
            return condition();
        });
    };
    const auto pace = [&] { return director.statistics().frames_per_camera; };
    ASSERT_TRUE(plays_until([&] { return pace() > 1 && publisher.rate_hz() < Stage::info().rate_hz; }));
    const auto before = director.statistics();
    ASSERT_TRUE(plays_until([&] {
        const auto now = director.statistics();
        return now[Counter::drop_paced] > before[Counter::drop_paced] &&
               now[Counter::camera_frames] > before[Counter::camera_frames];
    }));
    publisher.is_slow = false;
    // One step is enough: each takes seconds of calm.
    std::uint32_t slowest = pace();
    ASSERT_TRUE(plays_until([&] {
        slowest = std::max(slowest, pace());
        const float frames = publisher.rate_hz() * static_cast<float>(pace());
        return pace() < slowest && std::abs(frames - Stage::info().rate_hz) < 0.01F;
    }));
}

void expect_that_it_is_slowed_down_alone(SlowPublisher& publisher) {
    MapLibrary maps;
    maps.set_ready("square", Stage::square());
    config::Config config = Stage::default_config();
    config.limits.workers = 2;
    Director director(config, maps, publisher);
    for (const char* match : {"m", "other"}) {
        director.receive(Stage::info(match));
        ObserverRequest request = Stage::request("a");
        request.match_id = match;
        director.receive(request);
    }
    std::uint32_t number = 0;
    const auto plays_until = [&](const auto& condition) {
        return test::eventually([&] {
            ++number;
            for (const char* match : {"m", "other"}) {
                PoseFrame frame = Stage::poses(number);
                receive(director, match, frame);
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            return condition();
        });
    };
    ASSERT_TRUE(plays_until([&] { return publisher.rate_hz() < publisher.rate_hz("other"); }));
    const auto before = director.statistics();
    ASSERT_TRUE(plays_until(
        [&] { return director.statistics()[Counter::drop_paced] > before[Counter::drop_paced] + 20; }));
    EXPECT_LT(publisher.rate_hz(), publisher.rate_hz("other"));
    EXPECT_EQ(director.statistics()[Counter::silences], 0U);
    publisher.is_slow = false;
    EXPECT_TRUE(plays_until([&] { return publisher.rate_hz() == publisher.rate_hz("other"); }));
}

TEST(PaceTest, AMatchWhoseCamerasTakeLongIsSlowedDownAlone) {
    SlowPublisher publisher(work_for, std::chrono::milliseconds(35));
    expect_that_it_is_slowed_down_alone(publisher);
}

TEST(PaceTest, AMatchWhoseWritesWaitLongIsSlowedDownAlone) {
    SlowPublisher publisher(wait_for, std::chrono::milliseconds(60));
    expect_that_it_is_slowed_down_alone(publisher);
}

// As when its thread gets no processor.
TEST(PaceTest, AMatchThatIsHeldUpLosesNoFrame) {
    SlowPublisher publisher(wait_for, std::chrono::milliseconds(30));
    MapLibrary maps;
    maps.set_ready("square", Stage::square());
    Director director(Stage::default_config(), maps, publisher);
    director.receive(Stage::info());
    director.receive(Stage::request("a"));
    for (std::uint32_t number = 1; number <= 20; ++number) {
        receive(director, "m", Stage::poses(number));
        ASSERT_TRUE(test::eventually([&] { return publisher.frames().size() == number; })) << number;
    }
    EXPECT_EQ(director.statistics()[Counter::drop_paced], 0U);
    EXPECT_EQ(publisher.rate_hz(), Stage::info().rate_hz);
}

}  // namespace
}  // namespace camdir::director
