// Doors of a real game server, and the cameras of a real director among them, over real DDS.
#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "base/geometry.hpp"
#include "hall.hpp"
#include "support/eventually.hpp"
#include "support/raw_peer.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {
namespace {

using camera_director::Camera;
using camera_director::CameraFrame;
using camera_director::Context;
using camera_director::Match;
using camera_director::Observer;

// A board across the hall, 60 units behind the player, where a camera would stand. It is open above.
const Box3f board(Vec3f(-70.0F, -300.0F, -200.0F), Vec3f(-50.0F, 300.0F, 200.0F));
constexpr float open_height = 600.0F;
constexpr float speed = 20.0F;  // units a frame
constexpr std::uint32_t door_id = 5;
const std::array<Vec3f, 2> eyes{Vec3f::Zero(), Vec3f(0.0F, 80.0F, 0.0F)};

bool crosses(const Box3f& box, const Vec3f& from, const Vec3f& to) {
    float enter = 0.0F, leave = 1.0F;
    const Vec3f way = to - from;
    for (int axis = 0; axis < 3; ++axis) {
        if (way[axis] == 0.0F) {
            if (from[axis] <= box.min()[axis] || from[axis] >= box.max()[axis]) return false;
            continue;
        }
        const float a = (box.min()[axis] - from[axis]) / way[axis];
        const float b = (box.max()[axis] - from[axis]) / way[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter < leave;
}

// Two players stand in the hall, the first at the origin, and look along x. The door opens and closes as it
// is told.
class DoorGame {
  public:
    DoorGame(const Context& context, const std::string& match_id) : info_(info_of(match_id)) {
        match_ = std::make_unique<Match>(Match::open(context, info_).value());
        announce();
        thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
    }

    void close_door() { closes_ = true; }
    [[nodiscard]] bool is_closed() const { return is_closed_; }
    // A new epoch, without a door.
    void restart() {
        const std::lock_guard lock(mutex_);
        match_->restart(info_).value();
        heights_.clear();
        has_door_ = false;
        frame_ = 0;
    }
    [[nodiscard]] std::uint64_t epoch() const {
        const std::lock_guard lock(mutex_);
        return match_->epoch().value();
    }
    // Where the board was in the frame of this time; nothing: there was none, or no such frame.
    [[nodiscard]] std::optional<Box3f> board_at(std::int64_t frame_time) const {
        const std::lock_guard lock(mutex_);
        const auto height = heights_.find(frame_time);
        if (height == heights_.end()) return std::nullopt;
        const Vec3f up = height->second * Vec3f::UnitZ();
        return Box3f(board.min() + up, board.max() + up);
    }

  private:
    static camera_director::MatchInfo info_of(const std::string& match_id) {
        camera_director::MatchInfo info;
        info.match_id = match_id;
        info.map_name = "hall";
        info.players = {{.id = 1, .name = "anna"}, {.id = 2, .name = "bert"}};
        return info;
    }

    void announce() {
        camera_director::Mover door{.id = door_id, .kind = "func_door"};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::array<float, 4> up{}, down{};
            up[axis] = 1.0F;
            up[3] = board.max()[static_cast<int>(axis)];
            down[axis] = -1.0F;
            down[3] = -board.min()[static_cast<int>(axis)];
            door.half_spaces.insert(door.half_spaces.end(), up.begin(), up.end());
            door.half_spaces.insert(door.half_spaces.end(), down.begin(), down.end());
        }
        door.hull_sizes = {6};
        match_->set_movers({&door, 1}).value();
    }

    void run(const std::stop_token& stop) {
        auto due = std::chrono::steady_clock::now();
        while (!stop.stop_requested()) {
            {
                const std::lock_guard lock(mutex_);
                publish(std::int64_t{16'666'667} * frame_++);
            }
            due += std::chrono::microseconds(16'667);
            std::this_thread::sleep_until(due);
        }
    }

    void publish(std::int64_t time) {
        if (has_door_) {
            height_ = closes_ ? std::max(0.0F, height_ - speed) : open_height;
            heights_[time] = height_;
            is_closed_ = height_ == 0.0F;
            const float position[3] = {0.0F, 0.0F, height_};
            match_
                ->publish(camera_director::MoverFrame{.frame_time = time,
                                                      .mover_id = {&door_id, 1},
                                                      .position = position,
                                                      .orientation = unrotated_})
                .value();
        }
        static constexpr std::array<std::uint32_t, 2> ids{1, 2}, flags{CDIR_POSE_ALIVE, CDIR_POSE_ALIVE};
        static constexpr std::array<float, 8> orientations{0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F};
        match_
            ->publish(camera_director::PoseFrame{.frame_time = time,
                                                 .player_id = ids,
                                                 .eye = std::span(eyes[0].data(), 6),
                                                 .orientation = orientations,
                                                 .flags = flags})
            .value();
    }

    static constexpr std::array<float, 4> unrotated_{0.0F, 0.0F, 0.0F, 1.0F};
    const camera_director::MatchInfo info_;
    std::atomic<bool> closes_{false}, is_closed_{false};
    mutable std::mutex mutex_;
    std::unique_ptr<Match> match_;
    std::map<std::int64_t, float> heights_;
    bool has_door_ = true;
    float height_ = open_height;
    std::int64_t frame_ = 0;
    std::jthread thread_;
};

Vec3f place_of(const Camera& camera) {
    return Vec3f(camera.position);
}
bool shows_player(const Camera& camera) {
    return (camera.flags & CDIR_CAMERA_TARGET_VISIBLE) != 0;
}

class MoversTest : public testing::Test {
  protected:
    void SetUp() override { ASSERT_TRUE(server_->ready()) << server_->log(); }

    // A camera behind the player, beyond where the board closes, sees it.
    bool sees_from_behind(Observer& observer, std::uint64_t epoch) {
        return sees(observer, [&](const CameraFrame& frame, auto cameras) {
            return frame.epoch == epoch && cameras.size() == 1 && shows_player(cameras[0]) &&
                   place_of(cameras[0]).x() < board.min().x();
        });
    }
    // The board where it was when this camera was taken, if it is of the game's epoch. The camera is not in
    // it, and does not say that it shows those whom it looks at through it.
    static std::optional<Box3f> heeded_board(const DoorGame& game, const CameraFrame& frame,
                                             const Camera& camera, std::span<const Vec3f> shown) {
        const auto door = game.board_at(frame.frame_time);
        if (!door || frame.epoch != game.epoch()) return std::nullopt;
        const Vec3f place = place_of(camera);
        EXPECT_FALSE(door->contains(place)) << place.transpose();
        for (const Vec3f& eye : shown)
            EXPECT_FALSE(shows_player(camera) && crosses(*door, place, eye))
                << place.transpose() << ", the board at " << door->min().transpose();
        return door;
    }
    static bool is_closed(const std::optional<Box3f>& door) {
        return door && door->min().z() == board.min().z();
    }
    // Until `count` cameras have seen the player past the closed board.
    static bool looks_past_the_board(Observer& observer, const DoorGame& game, int count) {
        return sees(observer, [&](const CameraFrame& frame, auto cameras) {
            if (cameras.size() != 1) return false;
            const auto door = heeded_board(game, frame, cameras[0], std::span(eyes).first(1));
            if (is_closed(door) && shows_player(cameras[0])) --count;
            return count == 0;
        });
    }

    TestDomain domain_;
    std::optional<Server> server_{domain_.id()};
    Context context_ = Context::open(connection(domain_.id())).value();
};

TEST_F(MoversTest, NoCameraLooksThroughADoorThatCloses) {
    DoorGame game(context_, "cup");
    Observer observer = Observer::open(context_, "cup", "anna").value();
    observer.request({.target = 1}).value();
    ASSERT_TRUE(sees_from_behind(observer, game.epoch())) << server_->log();
    game.close_door();
    EXPECT_TRUE(looks_past_the_board(observer, game, 120)) << server_->log();
}

TEST_F(MoversTest, AGroupShotDoesNotLookThroughADoorEither) {
    DoorGame game(context_, "cup");
    Observer observer = Observer::open(context_, "cup", "anna").value();
    observer.request({.target = CDIR_SHOW_GROUP, .group = {1, 2}}).value();
    ASSERT_TRUE(sees_own_camera(observer)) << server_->log();
    game.close_door();
    int closed = 0;
    EXPECT_TRUE(sees(observer, [&](const CameraFrame& frame, auto cameras) {
        if (cameras.size() == 1 && is_closed(heeded_board(game, frame, cameras[0], eyes))) ++closed;
        return closed == 60;
    })) << server_->log();
}

TEST_F(MoversTest, ANewEpochForgetsTheDoor) {
    DoorGame game(context_, "cup");
    Observer observer = Observer::open(context_, "cup", "anna").value();
    observer.request({.target = 1}).value();
    ASSERT_TRUE(sees_from_behind(observer, game.epoch())) << server_->log();
    game.close_door();
    ASSERT_TRUE(looks_past_the_board(observer, game, 1)) << server_->log();
    game.restart();
    EXPECT_TRUE(sees_from_behind(observer, game.epoch())) << server_->log();
}

TEST_F(MoversTest, AStrangersBoardIsNone) {
    const DoorGame game(context_, "cup");
    Observer observer = Observer::open(context_, "cup", "anna").value();
    observer.request({.target = 1}).value();
    ASSERT_TRUE(sees_from_behind(observer, game.epoch())) << server_->log();
    RawPeer stranger(domain_.id(), "cup");
    RawMoverInfo info("cup", game.epoch());
    info.add_mover(door_id);
    info.add_box({-70.0F, -300.0F, -200.0F}, {-50.0F, 300.0F, 200.0F});
    RawMoverFrame frame("cup", game.epoch(), 0);
    frame.add(door_id, {0.0F, 0.0F, 0.0F});
    stranger.write(info.sample());
    stranger.write(frame.sample());
    ASSERT_TRUE(eventually([&] {
        return server_->log().find("MoverInfo of match 'cup' dropped: not_owner") != std::string::npos &&
               server_->log().find("MoverFrame of match 'cup' dropped: not_owner") != std::string::npos;
    })) << server_->log();
    int frames = 0;
    EXPECT_TRUE(sees(observer, [&](const CameraFrame& /*frame*/, auto cameras) {
        EXPECT_TRUE(!cameras.empty() && shows_player(cameras[0]));
        return ++frames == 60;
    }));
}

TEST_F(MoversTest, AStandbyThatTakesOverHasTheSameDoor) {
    Server second(domain_.id(), {.participant_index = 1, .strength = 50, .director_id = 2});
    ASSERT_TRUE(second.ready()) << second.log();
    DoorGame game(context_, "cup");
    Observer observer = Observer::open(context_, "cup", "anna").value();
    observer.request({.target = 1}).value();
    ASSERT_TRUE(sees_from_behind(observer, game.epoch())) << server_->log();
    ASSERT_TRUE(eventually([&] {
        observer.poll().value();
        return observer.counters().value().directors == 2;
    })) << second.log();
    game.close_door();
    ASSERT_TRUE(looks_past_the_board(observer, game, 60)) << server_->log();
    server_->process().send_signal(SIGKILL);
    std::uint64_t director = 0;
    ASSERT_TRUE(sees(observer, [&](const CameraFrame& frame, auto /*cameras*/) {
        director = frame.director_id;
        return director == 2;
    })) << second.log();
    EXPECT_TRUE(looks_past_the_board(observer, game, 60)) << second.log();
}

}  // namespace
}  // namespace camdir::test
