// What a witness of chaos records, and the verdict on it.
#include <gmock/gmock.h>

#include "soak/chaos_page.hpp"
#include "soak/verdict.hpp"
#include "soak/witness.hpp"

namespace camdir::soak {
namespace {

using testing::HasSubstr;
using testing::Not;

class ViewRecordTest : public testing::Test {
  protected:
    // At 10 frames per second.
    void see(std::uint32_t pose_number, double time, std::uint32_t flags = 0) {
        frame_.pose_number = pose_number;
        camera_.flags = flags;
        record_.add(frame_, &camera_, 0.002, time);
    }

    ViewRecord record_;
    camera_director::CameraFrame frame_ = cdir_camera_frame_default();
    camera_director::Camera camera_ = cdir_camera_default();
};

TEST_F(ViewRecordTest, ConsecutiveFramesAreNoFault) {
    for (std::uint32_t i = 0; i < 5; ++i)
        see(i, 0.1 * i, i == 0 ? CDIR_CAMERA_CUT : 0);
    const Seen seen = record_.take(0.5);
    EXPECT_EQ(seen.frames, 5U);
    EXPECT_EQ(seen.lost + seen.stale + seen.cuts + seen.unanswered + seen.epochs, 0U);
    EXPECT_NEAR(seen.gap_s, 0.1, 1e-9);
    EXPECT_NEAR(seen.silent_s, 0.1, 1e-9);
}

TEST_F(ViewRecordTest, WhatIsMissingStaleOrCutCounts) {
    see(0, 0.0);
    see(4, 0.4);
    see(3, 0.5);
    see(5, 0.5, CDIR_CAMERA_CUT);
    record_.add(frame_, nullptr, 0.0, 0.6);
    ++frame_.epoch;
    see(0, 0.7);
    const Seen seen = record_.take(0.7);
    EXPECT_EQ(seen.lost, 3U);
    EXPECT_EQ(seen.stale, 1U);
    EXPECT_EQ(seen.cuts, 1U);
    EXPECT_EQ(seen.unanswered, 1U);
    EXPECT_EQ(seen.epochs, 1U);
    EXPECT_NEAR(seen.gap_s, 0.4, 1e-9);
    EXPECT_EQ(record_.take(0.7).lost, 0U);
}

// A minute of one director, which a flood meets from 20 s to 30 s.
Timeline flooded() {
    Timeline timeline;
    timeline.scenario.directors = 1;
    for (int i = 0; i < 120; ++i) {
        Slice& slice = timeline.slices.emplace_back();
        slice.begin = 0.5 * i;
        slice.end = slice.begin + 0.5;
        slice.seen.frames = 15;
        slice.seen.gap_s = slice.seen.silent_s = 0.033;
        slice.directors[0] = Usage{17, 50.0, 20, 14};
    }
    ActRecord& act = timeline.acts.emplace_back();
    act.act.kind = ActKind::flood_observers;
    act.begin = 20.0;
    act.end = 30.0;
    act.act.for_s = 10.0;
    act.act.count = 10'000;
    act.invented = 9'900;
    return timeline;
}

std::vector<std::string> failures(const Timeline& timeline, bool sanitized = false) {
    std::vector<std::string> names;
    for (const Check& check : judge(timeline, sanitized))
        if (is_failed(check)) names.push_back(check.what);
    return names;
}

void expect_failure(const Timeline& timeline, const std::string& what) {
    EXPECT_THAT(failures(timeline), testing::ElementsAre(HasSubstr(what)));
}

TEST(Verdict, AFloodThatNobodyNoticesPasses) {
    EXPECT_THAT(failures(flooded()), testing::IsEmpty());
    EXPECT_EQ(judged_share(flooded()), 1.0);
}

TEST(Verdict, FramesLostInAFloodFail) {
    Timeline timeline = flooded();
    timeline.slices[50].seen.lost = 1;
    expect_failure(timeline, "frames lost");
}

TEST(Verdict, AFloodThatDoesNotArriveFails) {
    Timeline timeline = flooded();
    timeline.acts[0].invented = 9'000;
    expect_failure(timeline, "flood_observers: answered");
}

TEST(Verdict, AFloodOfMatchesThatDoesNotArriveFailsBesideOneOfObservers) {
    Timeline timeline = flooded();
    timeline.acts.push_back(timeline.acts[0]);
    timeline.acts[1].act.kind = ActKind::flood_matches;
    timeline.acts[1].act.count = 100;
    timeline.acts[1].invented = 96;
    EXPECT_THAT(failures(timeline), testing::IsEmpty());
    timeline.acts[1].invented = 0;
    expect_failure(timeline, "flood_matches: answered");
}

TEST(Verdict, WhatAFloodThatWasStoppedWasAnsweredIsNotJudged) {
    Timeline timeline = flooded();
    timeline.acts[0].end = 25.0;
    timeline.acts[0].invented = 0;
    EXPECT_THAT(failures(timeline), testing::IsEmpty());
}

TEST(Verdict, FramesLostWhileTheMachineStallsAreNotJudged) {
    Timeline timeline = flooded();
    timeline.slices[50].seen.lost = 1;
    timeline.slices[49].stall_s = 0.1;
    EXPECT_THAT(failures(timeline), testing::IsEmpty());
    EXPECT_LT(judged_share(timeline), 1.0);
}

TEST(Verdict, FramesLostAtAllTimesAreNotTheFloodsDoing) {
    Timeline timeline = flooded();
    for (Slice& slice : timeline.slices)
        slice.seen.lost = 1;
    EXPECT_THAT(failures(timeline), testing::IsEmpty());
    for (std::size_t i = 40; i < 60; ++i)
        timeline.slices[i].seen.lost = 3;
    expect_failure(timeline, "frames lost");
}

TEST(Verdict, CutsGapsAndEpochsFail) {
    Timeline timeline = flooded();
    timeline.slices[50].seen.cuts = 1;
    expect_failure(timeline, "cuts");
    timeline = flooded();
    timeline.slices[50].seen.gap_s = 0.5;
    expect_failure(timeline, "gap");
    timeline = flooded();
    timeline.slices[50].seen.epochs = 1;
    expect_failure(timeline, "epoch");
}

TEST(Verdict, CamerasThatDoNotReturnFail) {
    Timeline timeline = flooded();
    for (std::size_t i = 50; i < timeline.slices.size(); ++i)
        timeline.slices[i].seen.silent_s = timeline.slices[i].end - 25.0;
    expect_failure(timeline, "cameras again");
}

Timeline grown(Timeline timeline, double from_s, double to_mib) {
    for (Slice& slice : timeline.slices)
        if (slice.begin >= from_s) slice.directors[0]->resident_mib = to_mib;
    return timeline;
}

TEST(Verdict, GrowthFails) {
    EXPECT_THAT(failures(grown(flooded(), 30.0, 60.0)), testing::IsEmpty());  // 5 % and 8 MiB are 10.5
    expect_failure(grown(flooded(), 30.0, 61.0), "memory");
}

TEST(Verdict, AfterAWarmUpTheLevelHolds) {
    Timeline timeline = grown(flooded(), 5.0, 90.0);
    timeline.scenario.warm_up_s = 10.0;
    EXPECT_THAT(failures(timeline), testing::IsEmpty());
    EXPECT_THAT(failures(grown(timeline, 30.0, 94.0)), testing::IsEmpty());  // 5 % are 4.5
    expect_failure(grown(timeline, 30.0, 95.0), "memory");
}

TEST(Verdict, AProcessThatWasStartedLaterIsWarmedUpToo) {
    Timeline timeline = flooded();
    timeline.scenario.settle_s = 4.0;
    for (std::size_t i = 70; i < timeline.slices.size(); ++i)  // from 35 s on; 8 s later it has its level
        timeline.slices[i].directors[0] = Usage{18, i < 86 ? 30.0 : 50.0, 20, 14};
    EXPECT_THAT(failures(timeline), testing::ElementsAre(HasSubstr("process 18: memory")));
    timeline.scenario.warm_up_s = 10.0;
    EXPECT_THAT(failures(timeline), testing::IsEmpty());
}

TEST(Verdict, ObserversOfACrowdThatWaitTooLongFail) {
    Timeline timeline = flooded();
    timeline.acts[0].act.kind = ActKind::crowd;
    timeline.acts[0].waited_s = 9.9;
    timeline.slices[50].seen.lost = 100;
    timeline.slices[50].seen.gap_s = 1.5;
    EXPECT_THAT(failures(timeline), testing::IsEmpty());
    timeline.acts[0].waited_s = 10.1;
    expect_failure(timeline, "crowd");
}

TEST(Verdict, DescriptorsAndThreadsThatStayFail) {
    Timeline timeline = flooded();
    for (std::size_t i = 60; i < timeline.slices.size(); ++i)
        timeline.slices[i].directors[0]->descriptors = 21;
    expect_failure(timeline, "descriptors");
}

TEST(Verdict, OfSanitizedDirectorsNeitherMemoryNorWhatObserversSeeIsJudged) {
    Timeline timeline = flooded();
    timeline.slices[50].seen.gap_s = 5.0;
    timeline.slices[50].seen.lost = 100;
    timeline.slices[50].seen.cuts = 1;
    for (std::size_t i = 60; i < timeline.slices.size(); ++i)
        timeline.slices[i].directors[0]->resident_mib = 500.0;
    EXPECT_THAT(failures(timeline, true), testing::IsEmpty());
    for (std::size_t i = 60; i < timeline.slices.size(); ++i)
        timeline.slices[i].directors[0]->threads = 15;
    EXPECT_THAT(failures(timeline, true), testing::ElementsAre(HasSubstr("threads")));
}

TEST(ChaosPage, ShowsVerdictActsAndSeriesWithoutScripts) {
    Timeline timeline = flooded();
    timeline.acts[0].failure = "<broken>";
    const std::string html = to_html(timeline, judge(timeline));
    EXPECT_THAT(html, HasSubstr("<h1>Chaos: FAILED</h1>"));
    EXPECT_THAT(html, HasSubstr("flood_observers at 20 s"));
    EXPECT_THAT(html, HasSubstr("&lt;broken&gt;"));
    EXPECT_THAT(html, HasSubstr("<path class=\"line camera-0\" d=\"M"));
    EXPECT_THAT(html, Not(HasSubstr("<script")));
    EXPECT_THAT(html, Not(HasSubstr("http")));
}

}  // namespace
}  // namespace camdir::soak
