// `evaluate --trace` of a recording's folder.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "evaluation/trace.hpp"
#include "hall_match.hpp"
#include "recording/writer.hpp"
#include "support/child_process.hpp"

namespace camdir {
namespace {

using nlohmann::json;

class EvaluateRecording : public HallMatch {
  protected:
    // The poses of the trace, after those of an epoch that is not looked at, and a spectator.
    void SetUp() override {
        HallMatch::SetUp();
        const auto trace = evaluation::read_trace(trace_);
        ASSERT_TRUE(trace);
        recording::Start start;
        start.match.match_id = "m";
        start.match.metres_per_unit = 1.0F;
        auto writer = recording::Writer::create(recording_, start, 1ULL << 40);
        ASSERT_TRUE(writer);
        std::uint32_t number = 0;
        const auto append = [&](director::PoseFrame frame) {
            frame.poses.push_back({9, Vec3f::Zero(), Quatf::Identity(), Vec3f::Zero(), 4, {}});
            frame.frame_number = number;
            ASSERT_TRUE(writer->append({number++ * 16'000'000LL, frame}));
        };
        append({1, 0, 77, 0, {{5, Vec3f::Zero(), Quatf::Identity(), Vec3f::Zero(), 1, {}}}});
        start.match.epoch = 2;
        ASSERT_TRUE(writer->append({16'000'000, start.match}));
        for (const evaluation::TraceFrame& frame : trace->frames) {
            director::PoseFrame poses{2, 0, frame.time, 0, {}};
            for (const evaluation::TracePose& pose : trace->poses_of(frame))
                poses.poses.push_back({pose.player,
                                       pose.eye.cast<float>(),
                                       pose.orientation.cast<float>(),
                                       pose.velocity.cast<float>(),
                                       1,
                                       {}});
            append(poses);
        }
        ASSERT_TRUE(writer->finish());
    }

    [[nodiscard]] json figures_of(const std::string& trace) const {
        const std::string file = folder_ / "figures.json";
        test::ChildProcess process(
            {CAMERA_DIRECTOR, "evaluate", vfs_, "--map", map_, "--trace", trace, "--json", file});
        EXPECT_EQ(process.wait(), 0) << process.errors();
        const Bytes bytes = read_file(file).value();
        return json::parse(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    }

    const std::string recording_ = folder_ / "recording";
};

TEST_F(EvaluateRecording, HasTheFiguresOfTheSameMatchAsATable) {
    const json of_table = figures_of(trace_);
    const json of_recording = figures_of(recording_);
    ASSERT_EQ(of_table.size(), of_recording.size());
    for (const auto& [name, value] : of_table.items()) {
        if (!value.is_number()) continue;
        EXPECT_NEAR(of_recording.at(name).get<double>(), value.get<double>(),
                    1e-3 + 0.02 * std::abs(value.get<double>()))
            << name;
    }
}

}  // namespace
}  // namespace camdir
