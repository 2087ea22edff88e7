#include "director/map_binding.hpp"

#include <gtest/gtest.h>

#include "stage.hpp"
#include "support/freespace_meshes.hpp"

namespace camdir::director {
namespace {

class MapBindingTest : public testing::Test {
  protected:
    static constexpr std::uint64_t baked_hash = 7;

    // Into another generation.
    void bake() {
        freespace::Contents contents = test::square_contents();
        contents.metadata.source_hash = baked_hash;
        maps_.set_ready("square", test::make_freespace(contents));
    }
    void add() {
        maps_.add("square", false);
        bake();
    }
    [[nodiscard]] std::uint64_t count(Counter counter) const {
        Statistics sum;
        counters_.add_to(sum);
        return sum[counter];
    }

    MapLibrary maps_;
    MatchCounters counters_;
    MatchInfo info_ = Stage::info();  // on "square"
    MapBinding binding_{"m", maps_, counters_};
};

TEST_F(MapBindingTest, SaysWhyThereIsNoMap) {
    EXPECT_EQ(binding_.missing(), "no game server runs this match");
    EXPECT_TRUE(binding_.bind(info_));
    EXPECT_EQ(binding_.missing(), "map 'square' is not configured; known: none");
    maps_.add("square", false);
    maps_.add("hall", false);
    EXPECT_TRUE(binding_.bind(info_));
    EXPECT_EQ(binding_.missing(), "map 'square' is loading");
    maps_.set_failed("square", "it is no map");
    EXPECT_TRUE(binding_.bind(info_));
    EXPECT_EQ(binding_.missing(), "map 'square' failed: it is no map");
    info_.map_name = "cellar";
    EXPECT_TRUE(binding_.bind(info_));
    EXPECT_EQ(binding_.missing(), "map 'cellar' is not configured; known: hall, square");
    EXPECT_EQ(binding_.freespace(), nullptr);
}

TEST_F(MapBindingTest, TellsAnotherMapFromTheSame) {
    add();
    EXPECT_TRUE(binding_.bind(info_));
    EXPECT_NE(binding_.freespace(), nullptr);
    EXPECT_EQ(binding_.missing(), "");
    EXPECT_FALSE(binding_.bind(info_));
    maps_.set_loading("square", "it is baked again");
    EXPECT_FALSE(binding_.bind(info_)) << "the old one serves until the new one is there";
    bake();
    EXPECT_TRUE(binding_.bind(info_));
    binding_.release();
    EXPECT_EQ(binding_.freespace(), nullptr);
    EXPECT_EQ(binding_.missing(), "no game server runs this match");
    EXPECT_TRUE(binding_.bind(info_));
    maps_.remove("square");
    EXPECT_TRUE(binding_.bind(info_));
    EXPECT_EQ(binding_.freespace(), nullptr);
}

TEST_F(MapBindingTest, ReportsAnotherFileOnceAndRefusesItWhereTheMapIsStrict) {
    add();
    info_.map_hash = baked_hash + 1;
    for (int i = 0; i < 2; ++i)
        binding_.bind(info_);
    EXPECT_EQ(count(Counter::map_hash_mismatches), 1U);
    EXPECT_EQ(binding_.refusal(), "");
    maps_.add("square", true);
    EXPECT_FALSE(binding_.bind(info_));
    EXPECT_EQ(binding_.refusal(), "the game server's map 'square' is not the one that was baked");
    EXPECT_NE(binding_.freespace(), nullptr);
    info_.map_hash = baked_hash + 2;
    binding_.bind(info_);
    EXPECT_EQ(count(Counter::map_hash_mismatches), 2U);
    for (const std::uint64_t hash : {baked_hash, std::uint64_t{0}}) {
        info_.map_hash = hash;
        binding_.bind(info_);
        EXPECT_EQ(binding_.refusal(), "") << "the same, or an unknown one";
    }
    EXPECT_EQ(count(Counter::map_hash_mismatches), 2U);
}

TEST_F(MapBindingTest, ReportsAnotherScaleOnce) {
    add();
    for (const float scale : {0.0F, 0.0254F, 0.02541F}) {
        info_.metres_per_unit = scale;
        binding_.bind(info_);
        EXPECT_EQ(count(Counter::scale_mismatches), 0U) << scale;
    }
    info_.metres_per_unit = 0.0255F;
    for (int i = 0; i < 2; ++i)
        binding_.bind(info_);
    EXPECT_EQ(count(Counter::scale_mismatches), 1U);
}

TEST_F(MapBindingTest, ReportsUnknownMoversOnceForEachMap) {
    add();
    binding_.bind(info_);
    for (int i = 0; i < 2; ++i)
        binding_.report_unknown_movers({"*3", "*4"});
    EXPECT_EQ(count(Counter::unknown_movers), 2U);
    binding_.report_unknown_movers({"*4"});
    EXPECT_EQ(count(Counter::unknown_movers), 3U);
    bake();
    binding_.bind(info_);
    binding_.report_unknown_movers({"*4"});
    EXPECT_EQ(count(Counter::unknown_movers), 4U);
}

}  // namespace
}  // namespace camdir::director
