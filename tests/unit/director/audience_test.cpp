// What audiences are shown of a match.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <mutex>
#include <string>
#include <vector>

#include "director/clock.hpp"
#include "stage.hpp"
#include "support/eventually.hpp"

namespace camdir::director {
namespace {

using test::eventually;
using testing::ElementsAre;

// Writes down what it is shown.
class Diary final : public Audience {
  public:
    void show(const MatchInfo& shown) override { note(shown.match_id, "epoch " + number(shown.epoch)); }
    void show(const std::string& match_id, const PoseFrame& poses, const CameraFrame& cameras) override {
        EXPECT_EQ(cameras.epoch, poses.epoch);
        EXPECT_EQ(cameras.pose_number, poses.frame_number);
        EXPECT_EQ(cameras.frame_time, poses.frame_time);
        EXPECT_EQ(cameras.source_time, poses.source_time);
        std::string entry = "poses " + number(poses.frame_number);
        for (const PlayerPose& pose : poses.poses)
            if ((pose.flags & pose_discontinuity) != 0) entry += ", " + number(pose.player_id) + " jumped";
        for (const ShotCamera& camera : cameras.cameras)
            entry += ", camera of " + number(camera.target);
        note(match_id, entry);
    }
    void show(const std::string& match_id, const MatchEvent& event) override {
        note(match_id, "event of " + number(event.actor));
    }
    void request(const ObserverRequest& request) override {
        note(request.match_id, request.observer_id + " asks");
    }
    void request_ended(const std::string& match_id, const std::string& observer_id) override {
        note(match_id, observer_id + " leaves");
    }
    void end(const std::string& match_id) override { note(match_id, "end"); }

    [[nodiscard]] std::vector<std::string> entries() const {
        const std::lock_guard lock(mutex_);
        return entries_;
    }

  private:
    static std::string number(std::uint64_t value) { return std::to_string(value); }
    void note(const std::string& match_id, const std::string& entry) {
        const std::lock_guard lock(mutex_);
        entries_.push_back(match_id + ": " + entry);
    }

    mutable std::mutex mutex_;
    std::vector<std::string> entries_;
};

void report_event(Stage& stage, std::uint64_t epoch, std::uint32_t actor) {
    stage.director.receive("m", MatchEvent{epoch, 0, 1, actor});
    stage.director.flush();
}

TEST(Audience, SeesWhatTakesEffectInItsOrder) {
    Diary diary;
    Stage stage(Stage::default_config(), {&diary});
    stage.ask(Stage::request("early", 2));
    stage.start();
    stage.send(Stage::poses(1));
    stage.director.request_ended("m", "early");
    stage.send(Stage::poses(2));
    report_event(stage, 1, 3);
    stage.director.match_ended("m");
    stage.director.flush();
    EXPECT_THAT(diary.entries(), ElementsAre("m: early asks", "m: epoch 1", "m: poses 1, camera of 2",
                                             "m: early leaves", "m: poses 2", "m: event of 3", "m: end"));
}

TEST(Audience, SeesNothingOfARequestThatIsMadeAgain) {
    Diary diary;
    Stage stage(Stage::default_config(), {&diary});
    stage.ask(Stage::request("a"));
    stage.ask(Stage::request("a"));
    stage.ask(Stage::request("a", 2));
    stage.director.request_ended("m", "a");
    stage.ask(Stage::request("a", 2));
    EXPECT_THAT(diary.entries(), ElementsAre("m: a asks", "m: a asks", "m: a leaves", "m: a asks"));
    EXPECT_EQ(stage.director.statistics()[Counter::requests], 3U);
}

TEST(Audience, SeesNothingOfWhatIsDropped) {
    Diary diary;
    Stage stage(Stage::default_config(), {&diary});
    stage.start(Stage::info("m", 2));
    stage.start(Stage::info("m", 1));
    stage.send(Stage::poses(5, 2));
    stage.send(Stage::poses(4, 2));
    stage.send(Stage::poses(6, 1));
    report_event(stage, 1, 3);
    EXPECT_THAT(diary.entries(), ElementsAre("m: epoch 2", "m: poses 5"));
}

TEST(Audience, SeesMatchesWithoutTheirMap) {
    Diary diary;
    Stage stage(Stage::default_config(), {&diary});
    MatchInfo elsewhere = Stage::info();
    elsewhere.map_name = "unknown";
    stage.start(elsewhere);
    stage.ask(Stage::request("a"));
    stage.send(Stage::poses(1));
    EXPECT_THAT(diary.entries(), ElementsAre("m: epoch 1", "m: a asks", "m: poses 1"));
}

TEST(Audience, LearnsOfJumpsByTheirCount) {
    Diary diary;
    Stage stage(Stage::default_config(), {&diary});
    stage.start();
    for (std::uint32_t number = 1; number <= 3; ++number) {
        PoseFrame frame = Stage::poses(number, 1, {7});
        frame.poses[0].discontinuities = number / 3;
        stage.send(frame);
    }
    EXPECT_THAT(diary.entries(),
                ElementsAre("m: epoch 1", "m: poses 1", "m: poses 2", "m: poses 3, 7 jumped"));
}

TEST(Audience, SeesNothingBeforeObserversDo) {
    Diary diary;
    config::Config config = Stage::default_config();
    config.matches.minimum_delay_s = 0.3;
    Stage stage(config, {&diary});
    const std::int64_t begin = now_ns();
    stage.start();
    stage.send(Stage::poses(1));
    report_event(stage, 1, 3);
    stage.ask(Stage::request("a", 2));
    const auto entries = diary.entries();
    if (now_ns() - begin < 300 * ms) {
        EXPECT_THAT(entries, ElementsAre("m: a asks"));
    }
    EXPECT_TRUE(eventually([&] { return diary.entries().size() == 4; }));
    EXPECT_THAT(diary.entries(),
                ElementsAre("m: a asks", "m: epoch 1", "m: poses 1, camera of 2", "m: event of 3"));
}

TEST(Audience, ThereMayBeSeveral) {
    Diary one;
    Diary other;
    Stage stage(Stage::default_config(), {&one, &other});
    stage.start();
    stage.send(Stage::poses(1));
    EXPECT_THAT(one.entries(), ElementsAre("m: epoch 1", "m: poses 1"));
    EXPECT_EQ(one.entries(), other.entries());
}

}  // namespace
}  // namespace camdir::director
