// The game module with an engine and a game of the tests, eight bots and human spectators, and a director of
// the tests over real DDS.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>

#include "engine.h"
#include "fake_engine.hpp"
#include "integration/sdk/directors_domain.hpp"
#include "integration/sdk/fake_director.hpp"
#include "proxy.h"
#include "support/eventually.hpp"

namespace camdir::test {
namespace {

// Answers every request, and every frame with the cameras of the accepted shots, which stand at x = the
// observer's number and look at player 100 + number.
class Cameraman {
  public:
    explicit Cameraman(std::uint32_t domain) : director_(domain, "cup") {}

    std::string refused_profile = "none of the director's";

    void serve() {
        while (const auto request = director_.take_request())
            requests_[request->observer_id] = *request;
        while (const auto poses = director_.take_poses()) {
            if (poses->epoch != epoch_) answered_.clear();
            epoch_ = poses->epoch;
            answer();
            write_cameras(*poses);
        }
    }

    [[nodiscard]] FakeDirector& director() { return director_; }
    [[nodiscard]] std::uint64_t epoch() const { return epoch_; }
    [[nodiscard]] std::size_t requests() const { return requests_.size(); }

  private:
    static std::uint32_t number(const std::string& observer) {
        return static_cast<std::uint32_t>(std::stoul(observer.substr(std::string("spectator-").size())));
    }
    [[nodiscard]] bool accepts(const ReceivedRequest& request) const {
        return request.profile != refused_profile;
    }

    void answer() {
        for (const auto& [observer, request] : requests_) {
            const auto found = answered_.find(observer);
            if (found != answered_.end() && found->second == request.profile) continue;
            answered_[observer] = request.profile;
            if (accepts(request)) {
                director_.write_status(observer, epoch_, 1, number(observer));
            } else {
                director_.write_status(observer, epoch_, 0, 0, "no profile " + request.profile);
            }
        }
    }

    void write_cameras(const ReceivedPoses& poses) {
        CameraFrameArrays frame{.match_id = "cup", .epoch = epoch_};
        frame.frame_number = frame_number_++;
        frame.pose_number = poses.frame_number;
        frame.frame_time = poses.frame_time;
        frame.source_time = frame.write_time = poses.source_time;
        for (const auto& [observer, request] : requests_) {
            if (!accepts(request)) continue;
            const std::uint32_t id = number(observer);
            frame.add_camera(id, static_cast<float>(id));
            frame.target.back() = 2;
        }
        director_.write(frame);
    }

    FakeDirector director_;
    std::map<std::string, ReceivedRequest> requests_;
    std::map<std::string, std::string> answered_;
    std::uint64_t epoch_ = 0;
    std::uint32_t frame_number_ = 0;
};

class OpenArenaModule : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_TRUE(domain_.joined()) << "every domain is taken";
        director_.emplace(domain_.number());
        engine_.cvars["director_enable"] = "1";
        engine_.cvars["director_match"] = "cup";
        engine_.cvars["director_domain"] = domain_.text();
        engine_.start_map("oa_dm1");
    }

    // The module's thread lives as long as the process: it must leave the domain before the domain goes.
    void TearDown() override {
        if (!director_) return;
        engine_.cvars["director_enable"] = "0";
        engine_.run_frames(40);
        EXPECT_TRUE(eventually([&] { return director_->director().info_has_ended(); }));
        director_.reset();
    }

    // Runs frames and the director until the condition holds.
    template <class Condition>
    [[nodiscard]] bool until(const Condition& holds) {
        return eventually([&] {
            engine_.run_frames(1);
            if (director_) director_->serve();
            return holds();
        });
    }

    [[nodiscard]] static const viewer_shot* shot(int slot) {
        const director_report* report = module_report();
        return report == nullptr ? nullptr : &report->shots[slot];
    }
    // What the engine would send a client.
    [[nodiscard]] float shown_x(int slot) const {
        float origin[3];
        read_vector(origin, engine_.client(slot), PS_ORIGIN);
        return origin[0];
    }
    [[nodiscard]] bool sees_camera(int slot) const { return shown_x(slot) == static_cast<float>(slot); }

    [[nodiscard]] std::uint64_t published_epoch() {
        std::optional<ReceivedInfo> info;
        EXPECT_TRUE(eventually([&] { return (info = director_->director().take_info()).has_value(); }));
        return info ? info->epoch : 0;
    }

    DirectorsDomain domain_;
    std::optional<Cameraman> director_;
    FakeEngine engine_;
};

TEST_F(OpenArenaModule, ShotsAreOpenedServedRefusedWithTheReasonAndClosed) {
    engine_.connect(8);
    engine_.connect(9);
    ASSERT_TRUE(until([&] { return sees_camera(8) && sees_camera(9); }));
    EXPECT_EQ(director_->requests(), 2U);
    EXPECT_EQ(shot(8)->state, CDIR_SHOT_ACCEPTED);

    director_->refused_profile = "wide";
    engine_.command = {"director", "profile", "wide"};
    FakeEngine::call(GAME_CLIENT_COMMAND, 9);
    ASSERT_TRUE(until([&] { return shot(9) != nullptr && shot(9)->state == CDIR_SHOT_REFUSED; }));
    EXPECT_STREQ(shot(9)->reason, "no profile wide");
    EXPECT_TRUE(until([&] { return !sees_camera(9) && sees_camera(8); }));

    EXPECT_FALSE(director_->director().request_has_ended());
    engine_.disconnect(8);
    EXPECT_TRUE(eventually([&] {
        engine_.run_frames(1);
        return director_->director().request_has_ended();
    }));
    EXPECT_TRUE(until([&] { return shot(8) != nullptr && shot(8)->state == CDIR_SHOT_NOT_REQUESTED; }));
}

TEST_F(OpenArenaModule, DoorsArePublishedByTheirModels) {
    const auto place = [&](int number, int model, float height) {
        std::uint8_t* entity = engine_.entity(number);
        const float origin[3] = {0.0F, 0.0F, height}, angles[3] = {0.0F, 90.0F, 0.0F};
        write_int(entity, ENTITY_IN_USE, 1);
        write_int(entity, ENTITY_TYPE, ENTITY_TYPE_MOVER);
        write_int(entity, ENTITY_BRUSH_MODEL, 1);
        write_int(entity, ENTITY_MODEL_INDEX, model);
        write_vector(entity, ENTITY_ORIGIN, origin);
        write_vector(entity, ENTITY_ANGLES, angles);
    };
    std::optional<ReceivedMovers> movers;
    std::optional<ReceivedMoverFrame> frame;
    const auto announced = [&](std::size_t count) {
        if (auto taken = director_->director().take_movers()) movers = taken;
        return movers && movers->mover_id.size() == count;
    };
    const auto published = [&](std::vector<float> positions) {
        if (auto taken = director_->director().take_mover_frame()) frame = taken;
        return frame && frame->position == positions;
    };
    place(70, 3, 0.0F);
    ASSERT_TRUE(until([&] { return announced(1) && published({0, 0, 0}); }));
    EXPECT_THAT(movers->model, testing::ElementsAre("*3"));
    EXPECT_EQ(movers->mover_id, frame->mover_id);
    EXPECT_NEAR(frame->orientation[2], 0.7071F, 1e-4F);
    EXPECT_EQ(frame->epoch, movers->epoch);
    place(70, 3, 64.0F);
    EXPECT_TRUE(until([&] { return published({0, 0, 64}); }));
    place(71, 5, 8.0F);
    ASSERT_TRUE(until([&] { return announced(2) && published({0, 0, 64, 0, 0, 8}); }));
    EXPECT_THAT(movers->model, testing::ElementsAre("*3", "*5"));

    const std::uint64_t epoch = movers->epoch;
    engine_.level_time = 1000;
    engine_.start_map("oa_dm2");
    place(70, 4, 1.0F);
    write_int(engine_.entity(71), ENTITY_IN_USE, 0);
    ASSERT_TRUE(until([&] { return announced(1) && published({0, 0, 1}); }));
    EXPECT_THAT(movers->model, testing::ElementsAre("*4"));
    EXPECT_GT(movers->epoch, epoch);
}

TEST_F(OpenArenaModule, EveryLifeIsAnEpochOfTheSameMatchAndIsServedAgain) {
    engine_.connect(8);
    ASSERT_TRUE(until([&] { return sees_camera(8); }));
    std::uint64_t epoch = published_epoch();
    for (const char* map : {"oa_dm2", "oa_dm2"}) {
        engine_.level_time = 1000;
        engine_.start_map(map);
        EXPECT_FALSE(sees_camera(8)) << "a camera of the life before";
        ASSERT_TRUE(until([&] { return sees_camera(8); })) << map;
        const std::uint64_t next = published_epoch();
        EXPECT_GT(next, epoch);
        EXPECT_EQ(director_->epoch(), next);
        EXPECT_EQ(module_report()->epoch, next);
        epoch = next;
    }
    EXPECT_EQ(director_->director().observer_count(), 1U) << "the observer lives on";
}

TEST_F(OpenArenaModule, ADirectorThatIsKilledIsMissedAndServesAgainWhenItIsBack) {
    engine_.connect(8);
    const auto directors = [] { return module_report() == nullptr ? 0U : module_report()->directors; };
    ASSERT_TRUE(until([&] { return sees_camera(8) && directors() == 1; }));
    const std::uint64_t epoch = published_epoch();
    director_.reset();
    ASSERT_TRUE(until([&] { return directors() == 0; }));
    EXPECT_TRUE(until([&] { return !sees_camera(8); })) << "the game's own view";
    director_.emplace(domain_.number());
    ASSERT_TRUE(until([&] { return sees_camera(8); }));
    EXPECT_GT(published_epoch(), epoch) << "announced anew";
}

}  // namespace
}  // namespace camdir::test
