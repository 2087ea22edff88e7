// A recording that is shown as if its match went on, also where some of it is damaged.
#include "recording/playback.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "recording/writer.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::recording {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t begin = 1'700'000'000 * second;

// A fragment of a second each.
class StoredMatch {
  public:
    explicit StoredMatch(std::uint32_t fragments) {
        Start start;
        start.match.match_id = "m";
        start.fragment_duration = second;
        auto writer = Writer::create(folder(), start, 1ULL << 40U);
        EXPECT_TRUE(writer);
        for (std::uint32_t n = 0; n < fragments; ++n)
            EXPECT_TRUE(writer->append({begin + n * second, director::MatchEvent{}}));
        EXPECT_TRUE(writer->finish());
    }
    [[nodiscard]] fs::path folder() const { return folder_ / "r"; }
    void damage(std::uint32_t fragment) const {
        std::ofstream(folder() / std::to_string(fragment) / "full", std::ios::app) << "x";
    }

  private:
    test::TemporaryFolder folder_;
};

TEST(Playback, GoesOnOverWhatIsDamaged) {
    const StoredMatch recorded(8);
    for (const std::uint32_t fragment : {0U, 3U, 4U, 7U})
        recorded.damage(fragment);
    auto playback = Playback::open(recorded.folder());
    ASSERT_TRUE(playback) << playback.error().message;
    ASSERT_TRUE(playback->go_on(1.5, 2.0));
    EXPECT_EQ(playback->at(0.0).sync.last, 1U);
    EXPECT_EQ(playback->at(0.2).sync.last, 1U);
    EXPECT_EQ(playback->at(0.3).sync.last, 2U);
    EXPECT_EQ(playback->at(0.8).sync.last, 3U) << "damaged, when it should begin";
    EXPECT_EQ(playback->at(1.3).sync.last, 4U);
    EXPECT_EQ(playback->at(1.8).sync.last, 5U);
    EXPECT_TRUE(playback->at(1.8).is_live);
    EXPECT_EQ(playback->at(100.0).sync.last, 7U);
    EXPECT_FALSE(playback->at(100.0).is_live);
}

TEST(Playback, OfNothingThatCanBeReadSaysWhy) {
    const StoredMatch recorded(2);
    recorded.damage(0);
    recorded.damage(1);
    auto playback = Playback::open(recorded.folder());
    ASSERT_TRUE(playback);
    const auto begun = playback->go_on(0.0, 1.0);
    ASSERT_FALSE(begun);
    EXPECT_NE(begun.error().message.find("full: byte 24"), std::string::npos) << begun.error().message;
}

TEST(Playback, OfASyncThatNamesAnythingIsOfWhatIsThere) {
    const StoredMatch recorded(3);
    fs::remove_all(recorded.folder() / "1");
    std::ofstream(recorded.folder() / "sync")
        << R"({"first_fragment":0,"last_fragment":4294967295,"version":1})";
    auto playback = Playback::open(recorded.folder());
    ASSERT_TRUE(playback);
    ASSERT_TRUE(playback->go_on(0.0, 1000.0));
    EXPECT_EQ(playback->at(1e9).sync.last, 2U);
    const auto reader = Reader::open(recorded.folder());
    const auto left_out = reader->replay(0, [](const Record&) {});
    ASSERT_EQ(left_out.size(), 1U);
    EXPECT_NE(left_out[0].message.find(": 1: missing"), std::string::npos) << left_out[0].message;
    fs::remove_all(recorded.folder() / "0");
    fs::remove_all(recorded.folder() / "2");
    const auto none = Reader::open(recorded.folder());
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("none of the fragments 0 to 4294967295"), std::string::npos);
}

TEST(Reader, FindsTheLastFragmentUpToATimeOfThoseThatCanBeRead) {
    std::mt19937 random(7);
    for (int round = 0; round < 20; ++round) {
        const StoredMatch recorded(12);
        std::vector<bool> damaged(12);
        for (std::uint32_t n = 0; n < 12; ++n) {
            damaged[n] = random() % 3 == 0;
            if (damaged[n]) recorded.damage(n);
        }
        const auto reader = Reader::open(recorded.folder());
        ASSERT_TRUE(reader);
        for (std::uint32_t at = 0; at < 12; ++at) {
            std::uint32_t expected = at;
            while (expected > 0 && damaged[expected])
                --expected;
            EXPECT_EQ(reader->fragment_at(begin + at * second + second / 2), expected) << round << ' ' << at;
        }
    }
}

TEST(Reader, LeavesOutWhatIsDamagedAndSaysWhy) {
    const StoredMatch recorded(6);
    recorded.damage(0);
    recorded.damage(3);
    fs::remove(recorded.folder() / "4" / "delta");
    const auto reader = Reader::open(recorded.folder());
    ASSERT_TRUE(reader);
    std::vector<std::int64_t> visited;
    const auto left_out = reader->replay(0, [&](const Record& record) {
        if (std::holds_alternative<director::MatchEvent>(record.message))
            visited.push_back((record.time - begin) / second);
    });
    EXPECT_EQ(visited, (std::vector<std::int64_t>{1, 2, 3, 5})) << "what is before 3 is known from 2";
    ASSERT_EQ(left_out.size(), 2U);
    EXPECT_NE(left_out[0].message.find("0/full: byte 24"), std::string::npos) << left_out[0].message;
    EXPECT_NE(left_out[1].message.find("4/delta: cannot open"), std::string::npos) << left_out[1].message;
}

}  // namespace
}  // namespace camdir::recording
