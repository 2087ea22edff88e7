#include "report/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/charts.hpp"
#include "report/comparison.hpp"
#include "report/distributions.hpp"
#include "two_players.hpp"

namespace camdir::report {
namespace {

using testing::HasSubstr;
using testing::Not;

// Player i of `players` has i bad frames.
struct Example {
    explicit Example(std::uint32_t players = 2) {
        for (std::uint32_t frame = 0; frame < 50; ++frame) {
            trace.frames.push_back(
                {frame * 100'000'000LL, static_cast<std::uint32_t>(trace.poses.size()), players});
            for (std::uint32_t player = 0; player < players; ++player) {
                evaluation::TracePose pose;
                pose.player = player;
                trace.poses.push_back(pose);
                judgements.emplace_back();
                judgements.back().alive = judgements.back().counted = true;
                judgements.back().distance = 120.0;
                judgements.back().faults = frame < player ? evaluation::hidden : 0;
            }
        }
        for (std::uint32_t player = 0; player < players; ++player)
            trace.players.push_back(player);
        scene.metres_per_unit = 0.0254;
        scene.vertices = {{0, 0, 0}, {100, 0, 0}, {0, 100, 0}};
        scene.triangles = {{0, 1, 2}};
        scene.bounds = Box3d(Vec3d(0, 0, 0), Vec3d(100, 100, 100));
        for (const char* name : {"<own> & first", "other"})
            subject.cameras.push_back({name, evaluation::CameraPath(trace.poses.size()), judgements,
                                       evaluation::summarise(judgements)});
    }

    scene::Scene scene;
    evaluation::Trace trace;
    std::vector<evaluation::Judgement> judgements;
    Subject subject{scene, trace, 0.0, "a.vfs", "match.csv", "", {}, {}};
};

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

TEST(Comparison, ShowsEveryFigureAsItWasMeasured) {
    Example example;
    example.subject.cameras[0].metrics.good = 95.123456789;
    example.subject.cameras[1].metrics.good = 80.0;
    const std::string html = comparison(example.subject);
    EXPECT_THAT(html,
                HasSubstr("<tr id=\"good\"><th>good <small>%</small></th><td class=\"best\"><data "
                          "value=\"95.123456789\">95.12</data></td><td><data value=\"80\">80.00</data>"));
    EXPECT_THAT(html, HasSubstr("<tr id=\"acc.p95\">"));
    EXPECT_THAT(html, HasSubstr("<data value=\"\">-</data>")) << "nothing was measured";
    EXPECT_THAT(html, HasSubstr("&lt;own&gt; &amp; first"));
    EXPECT_THAT(html, Not(HasSubstr("<own>")));
}

TEST(Comparison, MarksNothingAsBestWhereAllShowTheSame) {
    Example example;
    example.subject.cameras[0].metrics.pops = 0.001;
    example.subject.cameras[1].metrics.pops = 0.002;
    EXPECT_THAT(comparison(example.subject),
                HasSubstr("<tr id=\"pops\"><th>pops <small>/min</small></th><td><data value=\"0.001\">0.00"));
}

TEST(Charts, AreOfThePlayersWithTheMostBadFrames) {
    EXPECT_EQ(count_of(charts(Example(4).subject), "<details"), 4U);
    const std::string html = charts(Example(20).subject);
    EXPECT_EQ(count_of(html, "<details"), max_charted_players);
    EXPECT_THAT(html, HasSubstr("data-player=\"19\""));
    EXPECT_THAT(html, Not(HasSubstr("data-player=\"3\"")));
    EXPECT_THAT(html, HasSubstr("Of the 20 players the 16 with"));
}

TEST(Charts, ShowTheFiguresOfEachPlayer) {
    const std::string html = charts(Example(4).subject);
    EXPECT_THAT(html, HasSubstr("Player 0</span><span class=\"good\">good 100.0 %"));
    EXPECT_THAT(html, HasSubstr("Player 3</span><span class=\"good\">good 94.0 %"));
}

TEST(Distributions, HaveALineForEachCameraThatWasMeasured) {
    Example example;
    for (auto& camera : example.subject.cameras)
        for (std::size_t i = 0; i < camera.judgements.size(); ++i)
            camera.judgements[i].behind = static_cast<double>(i);
    const std::string html = distributions(example.subject);
    EXPECT_EQ(count_of(html, "<path class=\"camera-0\""), 1U);
    EXPECT_EQ(count_of(html, "<path class=\"camera-1\""), 1U);
    EXPECT_EQ(count_of(html, "<svg"), 4U);
}

TEST(Page, StopsOnRequest) {
    Example example;
    std::stop_source stop;
    stop.request_stop();
    const auto page = to_html(
        example.subject, [](auto, auto) {}, stop.get_token());
    ASSERT_FALSE(page);
    EXPECT_EQ(page.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace camdir::report
