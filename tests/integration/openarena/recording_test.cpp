// What a spectator's client records with its own command `record`.
#include <limits>

#include "live_match.hpp"

namespace camdir::test {
namespace {

class Recording : public LiveMatch {};

constexpr int interval = 50;  // ms, between the frames of the server and the pictures of a playback

Deviation at(const CommandedPath& path, int time, const drawn_record& picture) {
    return deviation(picture, path.view(time, path.snapshots().size() - 1));
}

// The level time of the first picture: of the snapshots' times that at which all pictures together fit best.
int begin_of(const CommandedPath& path, const std::vector<drawn_record>& pictures) {
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    const int last = path.snapshots().back().frame.level_time;
    for (const auto& [frame, cut] : path.snapshots()) {
        if (frame.level_time + interval * static_cast<int>(pictures.size() - 1) > last) break;
        double sum = 0.0;
        for (std::size_t i = 0; i < pictures.size() && sum < least; ++i)
            sum += at(path, frame.level_time + interval * static_cast<int>(i), pictures[i]).offset;
        if (sum < least) {
            least = sum;
            best = frame.level_time;
        }
    }
    return best;
}

TEST_F(Recording, ShowsTheSameCamerasWithoutTheServer) {
    const GameClientOptions small = {.width = 320, .height = 180};
    ASSERT_NO_FATAL_FAILURE(join(small));
    GameClient& client = spectator().client();
    ASSERT_TRUE(spectator().follows(1)) << logs();
    client.console().enter("record seen");
    for (const int player : {2, 3, 1}) {
        ASSERT_TRUE(client.draws(40)) << logs();
        ASSERT_TRUE(spectator().follows(player)) << logs();
    }
    ASSERT_TRUE(client.draws(40)) << logs();
    static_cast<void>(client.console().ask("stoprecord"));
    const auto recording = client.recording("seen");
    ASSERT_TRUE(std::filesystem::exists(recording)) << logs();
    const CommandedPath path(server_->witnessed(), spectator().slot());
    EXPECT_EQ(server_->console().quit(), 0);

    GameClient player(recording, small);
    ASSERT_TRUE(eventually([&] { return !player.console().runs(); }, 5 * patience))
        << player.console().output();
    const auto& pictures = player.drawn();
    ASSERT_GE(pictures.size(), 60U) << player.console().output();
    const int begin = begin_of(path, pictures);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const int time = begin + interval * static_cast<int>(i);
        const auto [offset, turn] = at(path, time, pictures[i]);
        EXPECT_LE(offset, 0.1) << "units off the path that was sent at " << time << " ms";
        EXPECT_LE(turn, 0.1) << "degrees off the view that was sent at " << time << " ms";
    }
}

}  // namespace
}  // namespace camdir::test
