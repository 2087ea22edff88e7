// New maps and restarts under a running server, with a spectator.
#include <algorithm>
#include <set>

#include "live_match.hpp"

namespace camdir::test {
namespace {

class MapChange : public LiveMatch {
  protected:
    MapChange() : LiveMatch({"oa_dm1", "aggressor"}) {}

    [[nodiscard]] std::ptrdiff_t lives() {
        const auto& records = server_->witnessed();
        return std::count_if(records.begin(), records.end(),
                             [](const witness_record& record) { return record.kind == witness_starts; });
    }

    // Waits until the next life of a map has frames.
    void change(const std::string& command) {
        const auto before = lives();
        server_->console().enter(command);
        ASSERT_TRUE(eventually([&] { return lives() > before || !server_->console().runs(); }))
            << command << "\n"
            << logs();
        ASSERT_TRUE(server_->reaches([](const witness_record& /*frame*/) { return true; })) << command << "\n"
                                                                                            << logs();
        server_->add_bots(4);  // they leave with the map, unless they stay
    }

    [[nodiscard]] bool is_served() { return spectator().has_camera() && spectator().draws_camera(); }
};

TEST_F(MapChange, EachOfTenLivesIsServedAndAMapThatIsNotBakedIsNamed) {
    ASSERT_NO_FATAL_FAILURE(join());
    for (const char* command :
         {"map_restart 0", "map aggressor", "map_restart 0", "map_restart 0", "map oa_dm1", "map_restart 0",
          "map aggressor", "map_restart 0", "map oa_dm1", "map_restart 0"}) {
        ASSERT_NO_FATAL_FAILURE(change(command));
        ASSERT_TRUE(is_served()) << command << "\n" << logs();
    }
    ASSERT_NO_FATAL_FAILURE(change("map oa_dm3"));
    ASSERT_TRUE(eventually([&] {
        const std::string text = status();
        return text.find("no map 'oa_dm3'") != std::string::npos ||
               text.find("oa_dm3") != text.rfind("oa_dm3");
    })) << logs();
    EXPECT_FALSE(is_overlaid(*server_->newest(), spectator().slot()));
    ASSERT_NO_FATAL_FAILURE(change("map oa_dm1"));
    ASSERT_TRUE(is_served()) << logs();

    std::set<std::uint64_t> epochs;
    for (const auto& entry : tape_->entries())
        epochs.insert(entry.epoch);
    EXPECT_EQ(epochs.size(), 12U);
    expect_players_untouched();
    EXPECT_EQ(server_->console().quit(), 0) << server_->console().output();
}

}  // namespace
}  // namespace camdir::test
