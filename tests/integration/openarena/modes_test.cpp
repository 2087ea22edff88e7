// Team modes and elimination: spectators' cameras, and what the module records of the match.
#include <gmock/gmock.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "live_match.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::test {
namespace {

using testing::IsSubsetOf;
using testing::SizeIs;
using testing::UnorderedElementsAreArray;

using Row = std::vector<std::string>;

// The rows of a CSV file without its header.
std::vector<Row> rows_of(const std::filesystem::path& file) {
    const gzFile stream = gzopen(file.c_str(), "rb");
    std::string text;
    std::array<char, 4096> part{};
    for (int count = 0; stream && (count = gzread(stream, part.data(), part.size())) > 0;)
        text.append(part.data(), static_cast<std::size_t>(count));
    if (stream) gzclose(stream);
    std::vector<Row> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        Row row(1);
        for (const char c : line) {
            if (c == ',') {
                row.emplace_back();
            } else {
                row.back() += c;
            }
        }
        rows.push_back(row);
    }
    if (!rows.empty()) rows.erase(rows.begin());
    return rows;
}

// The groups of every match of an expression.
std::vector<Row> found(const std::string& text, const std::string& expression) {
    const std::regex regex(expression);
    std::vector<Row> result;
    for (auto match = std::sregex_iterator(text.begin(), text.end(), regex); match != std::sregex_iterator();
         ++match)
        result.emplace_back(std::next(match->begin()), match->end());
    return result;
}

class Mode : public LiveMatch {
  protected:
    Mode(const std::string& map, const std::string& type) : LiveMatch({map}) {
        settings_["g_gametype"] = type;
        settings_["director_record"] = (folder_ / "match").string();
    }

    // A spectator comes, follows two players and watches until the server's log tells enough; then the server
    // ends.
    void watch(const std::function<bool(const std::string& log)>& enough) {
        ASSERT_NO_FATAL_FAILURE(join({.width = 320, .height = 180}));
        for (const int player : {1, 2}) {
            ASSERT_TRUE(spectator().follows(player)) << logs();
            EXPECT_TRUE(spectator().draws_camera()) << logs();
        }
        ASSERT_TRUE(eventually([&] { return enough(server_->console().output()); }, 5 * patience)) << logs();
        ASSERT_TRUE(spectator().has_camera()) << logs();
        EXPECT_TRUE(spectator().draws_camera()) << logs();
        expect_players_untouched();
        ASSERT_EQ(server_->console().quit(), 0) << logs();
        for (const auto& file : std::filesystem::directory_iterator(folder_.path())) {
            const std::string name = file.path().filename();
            const bool is_other = name.ends_with("-events.csv.gz") || name.ends_with("-movers.csv.gz") ||
                                  name.ends_with("-players.csv");
            if (!is_other && name.ends_with(".csv.gz"))
                prefix_ = (folder_ / name.substr(0, name.size() - std::string(".csv.gz").size())).string();
        }
        ASSERT_NE(prefix_, "") << "no recording";
    }

    [[nodiscard]] std::vector<Row> events(const std::set<std::string>& kinds) const {
        std::vector<Row> events = rows_of(prefix_ + "-events.csv.gz");
        std::erase_if(events, [&](const Row& row) { return !kinds.contains(row[1]); });
        for (Row& row : events)
            row.erase(row.begin());  // the time
        return events;
    }

    // The game's log says who killed whom by what.
    void expect_kills_as_logged() {
        std::vector<Row> expected;
        for (const Row& line :
             found(server_->console().output(), R"((?:^|\n)Kill: (\d+) (\d+) \d+: .* by (\w+))")) {
            const bool by_world = std::stoi(line[0]) >= witness_slots;
            expected.push_back({by_world || line[0] == line[1] ? "death" : "kill", by_world ? "" : line[0],
                                line[1], line[2]});
        }
        EXPECT_THAT(events({"kill", "death"}), UnorderedElementsAreArray(expected));
    }

    // Every bot belongs to one of the two sides, in the recording as in the game.
    void expect_two_teams() {
        std::set<Row> teams;
        for (const witness_record& frame : server_->witnessed()) {
            for (int slot = 0; slot < witness_slots; ++slot) {
                const witness_player& player = frame.players[slot];
                if (player.bot && player.in_game)
                    teams.insert({std::to_string(slot), std::to_string(player.team)});
            }
        }
        std::set<Row> recorded;
        std::map<std::string, int> sizes;
        for (const Row& row : rows_of(prefix_ + "-players.csv")) {
            recorded.insert({row[0], row[2]});
            ++sizes[row[2]];
        }
        EXPECT_THAT(recorded, IsSubsetOf(teams));
        EXPECT_EQ(sizes, (std::map<std::string, int>{{"1", bots / 2}, {"2", bots / 2}}));
        for (const Row& row : rows_of(prefix_ + ".csv.gz"))
            EXPECT_TRUE(teams.contains({row[1], row[13]})) << "player " << row[1] << " of team " << row[13];
    }

  private:
    TemporaryFolder folder_;
    std::string prefix_;  // of the recording's files
};

bool has_kills(const std::string& log) {
    return found(log, R"((?:^|\n)(Kill):)").size() >= 5;
}

class TeamDeathmatch : public Mode {
  protected:
    TeamDeathmatch() : Mode("aggressor", "3") {}
};

TEST_F(TeamDeathmatch, TeamsAndKillsAreRecordedAndSpectatorsHaveCameras) {
    ASSERT_NO_FATAL_FAILURE(watch(has_kills));
    expect_two_teams();
    expect_kills_as_logged();
}

class CaptureTheFlag : public Mode {
  protected:
    CaptureTheFlag() : Mode("ps37ctf", "4") {}
};

TEST_F(CaptureTheFlag, FlagsAreRecordedAndSpectatorsHaveCameras) {
    const std::string taken = R"((?:^|\n)CTF: (\d+) \d+ 0: )", captured = R"((?:^|\n)CTF: (\d+) \d+ 1: )";
    ASSERT_NO_FATAL_FAILURE(
        watch([&](const std::string& log) { return has_kills(log) && !found(log, taken).empty(); }));
    expect_two_teams();
    expect_kills_as_logged();
    const auto expect_actors = [&](const std::string& kind, const std::string& line) {
        std::vector<Row> actors;
        for (const Row& row : events({kind}))
            actors.push_back({row[1]});
        const std::vector<Row> logged = found(server_->console().output(), line);
        EXPECT_THAT(actors, IsSubsetOf(logged)) << kind;
        // Who dies in the frame in which they take the flag does not have it after the frame.
        EXPECT_GE(actors.size() + 1, logged.size()) << kind;
    };
    expect_actors("flag_taken", taken);
    expect_actors("flag_captured", captured);
}

class Elimination : public Mode {
  protected:
    Elimination() : Mode("aggressor", "8") {
        settings_["elimination_warmup"] = "1";
        settings_["elimination_activewarmup"] = "2";
        settings_["elimination_roundtime"] = "20";
    }
};

TEST_F(Elimination, RoundsAreRecordedAndSpectatorsHaveCameras) {
    const std::string begin = R"((?:^|\n)ELIMINATION: (\d+) .* has started)",
                      end = R"((?:^|\n)ELIMINATION: (\d+) .* wins round)";
    ASSERT_NO_FATAL_FAILURE(watch([&](const std::string& log) { return !found(log, end).empty(); }));
    expect_two_teams();
    expect_kills_as_logged();
    std::map<std::string, std::size_t> rounds;
    for (const Row& row : events({"round"}))
        ++rounds[row[3]];
    const std::string log = server_->console().output();
    EXPECT_EQ(rounds["end"], found(log, end).size());
    EXPECT_GE(rounds["begin"], found(log, begin).size());
}

}  // namespace
}  // namespace camdir::test
