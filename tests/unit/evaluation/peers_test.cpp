// The metrics against figures that were measured independently: other people's cameras on recorded matches.
#include "evaluation/peers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "evaluation/metrics.hpp"
#include "scene/load.hpp"
#include "support/openarena.hpp"
#include "support/shared_files.hpp"
#include "tiny_trace.hpp"

namespace camdir::evaluation {
namespace {

namespace fs = std::filesystem;

TEST(Peers, SitWhereTheirNamesSay) {
    Trace trace;
    trace.players = {0};
    TracePose pose = standing(0, {10, 20, 30});
    pose.orientation = quake_orientation(0, 90, 0);
    pose.discontinuity = true;
    add_frame(trace, 0, {pose});
    const CameraPath eye = follow(Peer::eye, trace, 0.0254);
    EXPECT_EQ(eye[0].position, pose.eye);
    EXPECT_TRUE(eye[0].cut);
    EXPECT_LT((follow(Peer::rigid, trace, 0.0254)[0].position - Vec3d(10, -100, 30)).norm(), 1e-9);
    EXPECT_LT((follow(Peer::rigid, trace, 1.0)[0].position - Vec3d(10, 20 - 3.048, 30)).norm(), 1e-9);
    EXPECT_TRUE(find_peer("rigid") == Peer::rigid);
    EXPECT_FALSE(find_peer("drone"));
}

// A row of the peers' tables by the name of its column.
using Row = std::map<std::string, double>;

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> found;
    std::istringstream row(line.substr(1));
    for (std::string cell; std::getline(row, cell, '|');) {
        const auto first = cell.find_first_not_of(' ');
        if (first == std::string::npos) continue;
        found.push_back(cell.substr(first, cell.find_last_not_of(' ') + 1 - first));
    }
    return found;
}

Row find_row(const fs::path& tables, const std::string& section, const std::string& camera) {
    std::ifstream file(tables);
    std::string line;
    while (std::getline(file, line) && !line.starts_with("## " + section)) {
    }
    std::vector<std::string> names;
    while (std::getline(file, line) && !line.starts_with("## ")) {
        if (!line.starts_with("|")) continue;
        const auto row = cells(line);
        if (names.empty()) names = row;
        if (row[0] != camera) continue;
        Row values;
        for (std::size_t i = 1; i < row.size(); ++i)
            values[names[i]] = std::stod(row[i]);
        return values;
    }
    return {};
}

struct Match {
    const char* map;
    int rate;
};

void PrintTo(const Match& match, std::ostream* out) {
    *out << match.map << " at " << match.rate << " Hz";
}

class PeersOnMatch : public testing::TestWithParam<Match> {
  protected:
    void SetUp() override {
        const auto& [map, rate] = GetParam();
        const std::string tables = "design/peers.md";
        const std::string trace = std::string("traces/") + map + "-" + std::to_string(rate) + "hz.csv.gz";
        std::string needs;
        for (const std::string& name : {tables, trace})
            if (!test::shared_file(name)) needs += test::needs_shared_file(name) + '\n';
        if (!needs.empty()) GTEST_SKIP() << needs;
        const auto source = test::openarena_map(map);
        if (!source) GTEST_SKIP() << test::needs_openarena_map(map);
        tables_ = *test::shared_file(tables);
        trace_ = *test::shared_file(trace);
        source_ = *source;
    }

    fs::path tables_;
    fs::path trace_;
    std::string source_;
};

TEST_P(PeersOnMatch, MeasureAsElsewhere) {
    const Match& match = GetParam();
    const auto trace = read_trace(trace_);
    ASSERT_TRUE(trace) << trace.error().message;
    const auto scene = scene::load(source_);
    ASSERT_TRUE(scene) << scene.error().message;
    const oracle::Oracle oracle(*scene);
    for (const std::string camera : {"eye", "rigid"}) {
        SCOPED_TRACE(camera);
        const Row row =
            find_row(tables_, std::string(match.map) + ", " + std::to_string(match.rate) + " Hz", camera);
        ASSERT_EQ(row.size(), 27U);
        const CameraPath cameras = follow(*find_peer(camera), *trace, scene->metres_per_unit);
        const Metrics m = measure(*scene, oracle, *trace, cameras, {}, {}).value();
        // The tables round to the last digit shown.
        const auto same = [&](const char* column, double value, double digit) {
            EXPECT_NEAR(value, row.at(column), 0.501 * digit) << column;
        };
        same("good %", m.good, 0.1);
        same("head %", m.visible_head, 0.1);
        same("body %", m.visible_body, 0.1);
        // Pockets that are neither solid nor joined to a spawn point are outside the map here, but were not
        // there; faces between two solids are no obstacles' surfaces here, but were there. Only a camera that
        // is out of the free space can tell.
        const auto from_to = [&](const char* column, double value, double below, double above) {
            EXPECT_GE(value, row.at(column) - below) << column;
            EXPECT_LE(value, row.at(column) + above) << column;
        };
        from_to("<4u %", m.clearance_lt4, 0.01, 0.03 * row.at("solid %"));
        from_to("solid %", m.in_solid, 0.01, 0.05 * row.at("solid %"));
        from_to("fly %", m.fly_through, 0.5 * row.at("fly %"), 0.0);
        same("derr u", m.dist_err, 0.1);
        same("derr p95", m.dist_err_p95, 1);
        same("close %", m.too_close, 0.1);
        same("behind °", m.behind, 0.1);
        same("beh p95", m.behind_p95, 1);
        same("frame %", m.in_frame, 0.1);
        same("acc rms", m.acc.rms, 1);
        same("acc p95", m.acc.p95, 1);
        same("acc p99", m.acc.p99, 1);
        same("jerk p95 k", m.jerk.p95 / 1000, 1);
        same("ω p95", m.ang_speed.p95, 1);
        same("ω p99", m.ang_speed.p99, 1);
        same("ω̇ p95", m.ang_acc.p95, 1);
        same("pops /min", m.pops, 0.1);
        same("cuts /min", m.cuts, 0.1);
        same("max rot °", m.max_rotation, 0.1);
    }
}

std::string named(const testing::TestParamInfo<Match>& info) {
    return std::string(info.param.map) + "_" + std::to_string(info.param.rate);
}

INSTANTIATE_TEST_SUITE_P(Recorded, PeersOnMatch,
                         testing::Values(Match{"oa_dm1", 60}, Match{"oa_dm1", 20}, Match{"oa_dm3", 60},
                                         Match{"oa_dm3", 20}, Match{"oa_rpg3dm2", 60},
                                         Match{"oa_rpg3dm2", 20}, Match{"aggressor", 60},
                                         Match{"aggressor", 20}),
                         named);

}  // namespace
}  // namespace camdir::evaluation
