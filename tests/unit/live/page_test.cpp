// The page's readers of a recording and of the stream see the same match (server/page, in Node.js).
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "base/file.hpp"
#include "live/relay.hpp"
#include "recording/reader.hpp"
#include "recording/writer.hpp"
#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::live {
namespace {

using nlohmann::json;

constexpr std::int64_t frame_ns = 50'000'000;
constexpr std::int64_t recorded_from = 1'700'000'000'000'000'000;

// Records a match and streams it, frame by frame.
class Match {
  public:
    explicit Match(const std::filesystem::path& folder)
        : writer_(std::move(*recording::Writer::create(folder, start(), 1ULL << 40))) {
        info_ = start().match;
        show(info_);
        EXPECT_EQ(relay_.join("cup \xe2\x82\xac", viewer_), Relay::Admission::joined);
    }

    void next_epoch() {
        ++info_.epoch;
        info_.map_name = "yard";
        frame_time_ = -7'000'000'000;
        movers_ = nullptr;
        info_.players.push_back({70'000, "late", "", 2});
        show(info_);
    }

    void show_frame() {
        director::PoseFrame poses{info_.epoch, ++number_, frame_time_ += frame_ns, time_ - 123'456'789, {}};
        // Some are not seen in every frame; 9 is never listed.
        for (const std::uint32_t id : {3U, 4U, 9U, 70'000U})
            if (random_() % 8 != 0 && (id != 9 || number_ > 150)) poses.poses.push_back(pose(id));
        const director::CameraFrame cameras = cameras_of(poses);
        poses.movers = move();
        append(poses);
        append(cameras);
        relay_.show(info_.match_id, poses, cameras);
        take();
        add_expected(poses, cameras);
        if (random_() % 5 == 0) show_event();
        if (random_() % 20 == 0)
            append(director::ObserverRequest{info_.match_id, "tv", 3, {}, "close", "{}"});
        time_ += frame_ns;
    }

    [[nodiscard]] json finish() {
        EXPECT_TRUE(writer_.finish());
        take();
        return {{"match_id", info_.match_id},
                {"fragment_duration", start().fragment_duration},
                {"frames", frames_},
                {"notes", notes_}};
    }

  private:
    static recording::Start start() {
        recording::Start start;
        start.match.match_id = "cup \xe2\x82\xac";
        start.match.epoch = 1ULL << 60U;
        start.match.map_name = "hall";
        start.match.metres_per_unit = 0.0254F;
        start.match.rate_hz = 20.0F;
        start.match.players = {{3, "Ann", "soldier", 1}, {4, "Bob", "", 2}};
        return start;
    }

    // Of all, in some frames; now and then there are others.
    std::shared_ptr<const director::MatchMovers> move() {
        if (!movers_ || random_() % 40 == 0) {
            director::MoverInfo info{info_.epoch, {}};
            for (std::uint32_t id = 0; id < random_() % 5; ++id) {
                director::Mover mover;
                mover.id = 10 * id;
                mover.shape = {"*" + std::to_string(id), "func_door \xc3\xa9", {}, {{place(), 1.5F}}, {}};
                freespace::ConvexHull hull;
                for (int i = 0; i < 4; ++i)
                    hull.half_spaces.push_back({place().normalized(), number()});
                mover.shape.hulls = {hull, hull};
                info.movers.push_back(mover);
            }
            movers_ = std::make_shared<director::MoverInfo>(info);
            mover_frame_ = nullptr;
            append(info);
        }
        if (!mover_frame_ || random_() % 2 == 0) {
            director::MoverFrame frame{info_.epoch, frame_time_, time_, {}};
            for (const director::Mover& mover : movers_->movers)
                frame.poses.push_back({mover.id, place(), rotation()});
            mover_frame_ = std::make_shared<director::MoverFrame>(frame);
            append(frame);
        }
        return std::make_shared<director::MatchMovers>(director::MatchMovers{movers_, mover_frame_});
    }

    float number() { return std::uniform_real_distribution<float>(-4096.0F, 4096.0F)(random_); }
    Vec3f place() { return {number(), number(), number()}; }
    Quatf rotation() { return Quatf(number(), number(), number(), number()).normalized(); }

    director::PlayerPose pose(std::uint32_t id) {
        director::PlayerPose pose{id, place(), rotation(), place(), 1, {}};
        if (random_() % 10 == 0) pose.flags |= director::pose_discontinuity;
        if (random_() % 2 == 0) pose.discontinuities = static_cast<std::uint32_t>(random_());
        return pose;
    }

    director::CameraFrame cameras_of(const director::PoseFrame& poses) {
        director::CameraFrame frame{
            poses.epoch, number_, poses.frame_number, poses.frame_time, poses.source_time, {}, {}};
        for (const std::uint32_t id : {5U, 4'000'000'000U}) {
            if (random_() % 30 == 0) continue;
            if (random_() % 10 == 0) target_[id] = std::array{3U, 4U, 9U, director::no_player}[random_() % 4];
            const std::uint32_t flags = (random_() % 4 == 0 ? 1U : 0U) | (random_() % 2 == 0 ? 2U : 4U);
            frame.cameras.push_back({id, target_[id], place(), rotation(), 1.0F, number(), flags});
            if (random_() % 3 == 0) frame.reasons.push_back({id, {3, director::no_player, "duel"}});
        }
        return frame;
    }

    void show_event() {
        const director::MatchEvent event{info_.epoch,
                                         frame_time_ - static_cast<std::int64_t>(random_() % 1'000'000'000),
                                         static_cast<std::uint32_t>(random_() % 12),
                                         3,
                                         random_() % 2 == 0 ? director::no_player : 4U,
                                         12.5F,
                                         "rocket \xc3\xa9"};
        append(event);
        relay_.show(info_.match_id, event);
        take();
    }

    void show(const director::MatchInfo& info) {
        append(info);
        relay_.show(info);
        take();
    }

    void append(const recording::Message& message) { EXPECT_TRUE(writer_.append({time_, message})); }

    // Milliseconds from the recording's begin, of the game's time in this epoch.
    [[nodiscard]] double model_ms(std::int64_t frame_time) const {
        return 1e-6 * static_cast<double>(time_ - recorded_from + frame_time - frame_time_);
    }

    void take() {
        while (const auto message = viewer_->take()) {
            if (message->kind != Message::Kind::note) continue;
            json note = json::parse(message->content);
            if (note["kind"] == "history") continue;
            if (note.contains("t")) note["t"] = note["t"].get<double>() + model_ms(0);
            if (note.contains("epoch"))  // above what JavaScript has of a number
                note["epoch"] = std::to_string(info_.epoch);
            if (note["kind"] == "movers") mover_list_ = note["movers"];
            notes_.push_back(note);
            if (note["kind"] == "match")
                for (const json& player : note["players"])
                    slots_[player["id"].get<std::uint32_t>()] = player["slot"];
        }
    }

    static json numbers(const Vec3f& v) { return {v.x(), v.y(), v.z()}; }
    static json numbers(const Quatf& q) { return {q.x(), q.y(), q.z(), q.w()}; }
    [[nodiscard]] json slot(std::uint32_t id) const { return slots_.contains(id) ? slots_.at(id) : json(); }

    void add_expected(const director::PoseFrame& poses, const director::CameraFrame& cameras) {
        poses_ = poses;
        cameras_ = cameras;
        const std::int64_t source_us = poses.source_time / 1000;
        json players = json::array();
        for (const auto& pose : poses.poses) {
            if (!slots_.contains(pose.player_id)) slots_[pose.player_id] = slots_.size();
            players.push_back({{"slot", slot(pose.player_id)},
                               {"flags", pose.flags},
                               {"position", numbers(pose.eye)},
                               {"rotation", numbers(pose.orientation)}});
        }
        json shots = json::array();
        for (const auto& camera : cameras.cameras)
            shots.push_back({{"id", camera.camera_id},
                             {"target", slot(camera.target)},
                             {"flags", camera.flags},
                             {"position", numbers(camera.position)},
                             {"rotation", numbers(camera.orientation)},
                             {"fov", camera.vertical_fov}});
        json movers = json::array();
        for (const director::MoverPose& mover : poses.movers->frame->poses)
            movers.push_back({{"id", mover.mover_id},
                              {"position", numbers(mover.position)},
                              {"rotation", numbers(mover.orientation)}});
        frames_.push_back({{"t", model_ms(poses.frame_time)},
                           {"number", poses.frame_number},
                           {"source_time_ms", static_cast<double>(source_us) / 1e3},
                           {"players", players},
                           {"cameras", shots},
                           {"movers", movers},
                           {"mover_list", mover_list_}});
    }

    std::mt19937 random_{7};
    std::int64_t time_ = recorded_from;
    std::int64_t frame_time_ = 0;
    std::uint32_t number_ = 0;
    std::map<std::uint32_t, std::uint32_t> target_;
    std::map<std::uint32_t, json> slots_;  // by player
    director::MatchInfo info_;
    director::PoseFrame poses_;
    director::CameraFrame cameras_;
    recording::Writer writer_;
    Relay relay_{1};
    std::shared_ptr<Viewer> viewer_ = std::make_shared<Viewer>([] {});
    std::shared_ptr<const director::MoverInfo> movers_;
    std::shared_ptr<const director::MoverFrame> mover_frame_;
    json mover_list_ = json::array();  // as viewers of the stream are told
    json frames_ = json::array();
    json notes_ = json::array();
};

TEST(Page, ReadsTheSameOfARecordingAsOfTheStream) {
    if (test::ChildProcess({"/usr/bin/env", "node", "--version"}).wait() != 0)
        GTEST_SKIP() << "needs the package nodejs";
    const test::TemporaryFolder folder;
    Match match(folder / "r");
    for (int i = 0; i < 300; ++i)
        match.show_frame();
    match.next_epoch();
    for (int i = 0; i < 150; ++i)
        match.show_frame();
    ASSERT_TRUE(write_file(folder / "expected.json", match.finish().dump()));
    test::ChildProcess node({"/usr/bin/env", "node", CAMDIR_RECORDING_CHECK, (folder / "r").string(),
                             (folder / "expected.json").string()});
    EXPECT_EQ(node.wait(), 0) << node.errors();
}

}  // namespace
}  // namespace camdir::live
