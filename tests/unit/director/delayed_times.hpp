// A delayed match on made-up times.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <utility>

#include "director/match.hpp"
#include "stage.hpp"

namespace camdir::director {

inline constexpr std::int64_t delay_ns = 3000 * ms;
inline constexpr std::int64_t step_ns = 50 * ms;  // between frames
inline constexpr std::int64_t lead_ns = DelayBuffer::lead_ns;

constexpr std::int64_t received(std::uint32_t number) {
    return number * step_ns;
}
constexpr std::int64_t due(std::uint32_t number) {
    return received(number) + delay_ns;
}

// A match with a delay of 3 s and made-up times, in ns after its description was received.
class DelayedTimes {
  public:
    // Begins long ago, even if this machine has just started: the answers to requests read the clock.
    explicit DelayedTimes(Audiences audiences = {}, std::int64_t start = ms)
        : start_(start), audiences_(std::move(audiences)) {
        maps_.add("square", false);
        maps_.set_ready("square", Stage::square());
        EXPECT_TRUE(pool_.attach(match_));
        match_.delay().announce(1, 3.0, start_);
        put(Stage::info(), 0);
        tell(Stage::request("a"));
    }

    void put(Message message, std::int64_t time) {
        EXPECT_EQ(match_.delay().put(message, start_ + time), DelayBuffer::Admission::delayed);
    }
    // Received at its number's time.
    void put_frame(const PoseFrame& frame) {
        EXPECT_EQ(match_.delay().put(frame, start_ + received(frame.frame_number)),
                  DelayBuffer::Admission::delayed);
    }
    void put_frame(std::uint32_t number) { put_frame(Stage::poses(number)); }
    void put_frames(std::uint32_t count) {
        for (std::uint32_t number = 0; number < count; ++number)
            put_frame(number);
    }
    // Past the delay.
    void tell(Message message) {
        match_.inbox().put(std::move(message));
        run();
    }
    void at(std::int64_t time) {
        if (match_.delay().release(start_ + time, match_.inbox()).any) run();
    }
    [[nodiscard]] bool any_due(std::int64_t time) { return match_.delay().state().next_due <= start_ + time; }
    [[nodiscard]] std::size_t shown() const { return publisher.frames().size(); }
    [[nodiscard]] std::uint64_t steps() const {
        Statistics sum;
        match_.counters().add_to(sum);
        return std::accumulate(sum.step.buckets.begin(), sum.step.buckets.end(), std::uint64_t{0});
    }
    [[nodiscard]] DelayBuffer& delay() { return match_.delay(); }
    [[nodiscard]] std::int64_t start() const { return start_; }

    MemoryPublisher publisher;

  private:
    void run() {
        pool_.schedule(match_);
        WorkerPool::wait_idle(match_);
    }

    const std::int64_t start_;
    MapLibrary maps_;
    Pace pace_;
    const Audiences audiences_;
    Match match_{
        "m", std::make_shared<config::Config>(Stage::default_config()), maps_, pace_, publisher, audiences_};
    WorkerPool pool_{2, 1};
};

}  // namespace camdir::director
