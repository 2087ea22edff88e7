// `evaluate --trace` of a recording's folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "evaluation/events.hpp"
#include "evaluation/trace.hpp"
#include "hall_match.hpp"
#include "recording/writer.hpp"
#include "support/child_process.hpp"

namespace camdir {
namespace {

using nlohmann::json;

class EvaluateRecording : public HallMatch {
  protected:
    // The poses and kills of the trace, after those of an epoch that is not looked at, and a spectator.
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
        const auto append_kill = [&](director::MatchEvent kill) {
            kill.kind = 1;
            ASSERT_TRUE(writer->append({number * 16'000'000LL, kill}));
        };
        append({1, 0, 77, 0, {{5, Vec3f::Zero(), Quatf::Identity(), Vec3f::Zero(), 1, {}}}});
        append_kill({1, 77, 0, 5, 5, 0.0F, ""});
        start.match.epoch = 2;
        ASSERT_TRUE(writer->append({16'000'000, start.match}));
        const auto events = evaluation::read_events(events_, *trace);
        ASSERT_TRUE(events);
        for (const evaluation::TraceEvent& event : *events)
            append_kill({2, event.time, 0, event.actor.value_or(director::no_player),
                         event.subject.value_or(director::no_player), 0.0F, event.detail});
        append_kill({2, trace->frames.front().time, 0, 9, 9, 0.0F, "a spectator"});
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

    [[nodiscard]] json figures_of(const std::vector<std::string>& match) const {
        const std::string file = folder_ / "figures.json";
        std::vector<std::string> command = {CAMERA_DIRECTOR, "evaluate", vfs_, "--map", map_, "--json", file};
        command.insert(command.end(), match.begin(), match.end());
        test::ChildProcess process(command);
        EXPECT_EQ(process.wait(), 0) << process.errors();
        const Bytes bytes = read_file(file).value();
        return json::parse(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    }

    const std::string recording_ = folder_ / "recording";
};

TEST_F(EvaluateRecording, HasTheFiguresOfTheSameMatchAsATable) {
    const json of_table = figures_of({"--trace", trace_, "--events", events_});
    const json of_recording = figures_of({"--trace", recording_});
    ASSERT_EQ(of_table.size(), of_recording.size());
    EXPECT_TRUE(of_table.at("kill_in_view").is_number());
    for (const auto& [name, value] : of_table.items()) {
        if (!value.is_number()) continue;
        EXPECT_NEAR(of_recording.at(name).get<double>(), value.get<double>(),
                    1e-3 + 0.02 * std::abs(value.get<double>()))
            << name;
    }
}

TEST_F(EvaluateRecording, SaysWhyNoFrameIsJudged) {
    const Bytes bytes = read_file(trace_).value();
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    ASSERT_TRUE(write_file(trace_, text.substr(0, text.find("\n400,") + 1)));
    test::ChildProcess process({CAMERA_DIRECTOR, "evaluate", vfs_, "--map", map_, "--trace", trace_});
    EXPECT_EQ(process.wait(), 0) << process.errors();
    EXPECT_THAT(process.errors(), testing::HasSubstr("no frame is judged, hence "));
}

}  // namespace
}  // namespace camdir
