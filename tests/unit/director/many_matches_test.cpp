// Many matches at once: the same cameras for any number of workers, and every frame is accounted for.
#include <gtest/gtest.h>

#include <future>
#include <random>
#include <thread>

#include "stage.hpp"
#include "support/eventually.hpp"
#include "support/freespace_meshes.hpp"

namespace camdir::director {
namespace {

std::string name_of(int match) {
    return "match-" + std::to_string(match);
}

// Two observers with a target and one without.
void fill(Stage& stage, int matches) {
    for (int match = 0; match < matches; ++match) {
        stage.director.receive(Stage::info(name_of(match)));
        stage.director.receive(Stage::request("a", 1, name_of(match)));
        stage.director.receive(Stage::request("b", 2, name_of(match)));
        stage.director.receive(Stage::request("c", no_player, name_of(match)));
    }
    stage.director.flush();
}

// So many shots of one match that its turns share them.
void crowd(Stage& stage, int match) {
    for (int i = 0; i < 12; ++i) {
        ObserverRequest wanted = Stage::request("crowd-" + std::to_string(i),
                                                1 + static_cast<std::uint32_t>(i) % 3, name_of(match));
        wanted.overrides = R"({"distance": )" + std::to_string(40 + i) + "}";
        stage.director.receive(wanted);
    }
    stage.director.flush();
}

void append(std::string& bytes, const CameraFrame& frame) {
    const auto add = [&](const auto& value) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    add(frame.epoch);
    add(frame.frame_number);
    add(frame.pose_number);
    for (const ShotCamera& camera : frame.cameras) {
        add(camera.camera_id);
        add(camera.target);
        for (const float number : {camera.position.x(), camera.position.y(), camera.position.z(),
                                   camera.orientation.x(), camera.orientation.y(), camera.orientation.z(),
                                   camera.orientation.w(), camera.vertical_fov, camera.clearance})
            add(number);
        add(camera.flags);
    }
    for (const auto& [camera_id, reason] : frame.reasons) {
        add(camera_id);
        add(reason.actor);
        add(reason.subject);
        bytes += reason.why;
    }
}

// The bytes of all cameras of a run; runs differ only in who computes them.
std::string cameras_with(std::int64_t workers, bool together) {
    constexpr int matches = 12;
    config::Config config = Stage::default_config();
    config.limits.workers = workers;
    Stage stage(config);
    std::mt19937 random(7);
    stage.maps.set_ready("square", test::make_freespace(test::random_contents(random, 12, 12, 40)));
    const freespace::Freespace space = *stage.maps.find("square")->freespace;
    fill(stage, matches);
    crowd(stage, 0);
    for (std::uint32_t number = 1; number <= 60; ++number) {
        std::vector<PoseArrival> arrivals;
        for (int match = 0; match < matches; ++match) {
            PoseFrame& frame = arrivals.emplace_back(name_of(match), Stage::poses(number)).frame;
            // Sometimes a player is elsewhere, so that cameras cut and search.
            if (random() % 20 == 0) frame.poses[random() % 3].eye = test::random_point(random, space);
            const auto killer = static_cast<std::uint32_t>(1 + random() % 3);
            stage.director.receive(name_of(match),
                                   MatchEvent{1, frame.frame_time, 1, killer, no_player, 0.0F});
        }
        if (together) {
            stage.director.receive(arrivals);
        } else {
            for (PoseArrival& arrival : arrivals)
                stage.director.receive({&arrival, 1});
        }
        stage.director.flush();
    }
    std::string cameras;
    for (int match = 0; match < matches; ++match) {
        const auto frames = stage.publisher.frames(name_of(match));
        EXPECT_EQ(frames.size(), 60U);
        EXPECT_EQ(frames.back().cameras.size(), match == 0 ? 15U : 3U);
        for (const CameraFrame& frame : frames)
            append(cameras, frame);
    }
    return cameras;
}

TEST(ManyMatches, WhoComputesTheCamerasChangesNothing) {
    const std::string one = cameras_with(1, false);
    for (const std::int64_t workers : {2, 3, 5, 8})
        EXPECT_TRUE(cameras_with(workers, workers % 2 == 0) == one) << workers << " workers";
}

TEST(ManyMatches, EveryFrameIsProcessedOrCounted) {
    constexpr int matches = 40;
    constexpr std::uint32_t frames = 50;
    config::Config config = Stage::default_config();
    config.limits.workers = 4;
    Stage stage(config);
    fill(stage, matches);
    // Four threads act as receptions of game servers, a fifth as observers that come and go; maps are
    // reloaded meanwhile.
    std::vector<std::thread> threads;
    for (int first = 0; first < 4; ++first)
        threads.emplace_back([&stage, first] {
            for (std::uint32_t number = 1; number <= frames; ++number) {
                std::vector<PoseArrival> arrivals;
                for (int match = first; match < matches; match += 4)
                    arrivals.push_back({name_of(match), Stage::poses(number)});
                stage.director.receive(arrivals);
            }
        });
    threads.emplace_back([&stage] {
        for (int round = 0; round < 50; ++round) {
            const std::string match = name_of(round % matches);
            stage.director.receive(Stage::request("guest", 3, match));
            stage.director.receive(match, MatchEvent{1, round, 1, 2, 3, 0.0F});
            (void)stage.director.statistics();
            if (round % 10 == 0) (void)stage.director.view(std::chrono::milliseconds(50));
            if (round % 10 == 5) stage.director.maps_changed();
            stage.director.request_ended(match, "guest");
        }
    });
    for (std::thread& thread : threads)
        thread.join();
    stage.director.flush();

    const Statistics statistics = stage.director.statistics();
    const std::uint64_t accounted = statistics[Counter::camera_frames] +
                                    statistics[Counter::drop_superseded] + statistics[Counter::drop_burst] +
                                    statistics[Counter::drop_paced];
    // On a slow machine a frame of each match may wait for its turn.
    EXPECT_LE(accounted, matches * frames);
    EXPECT_GE(accounted, matches * (frames - 1));
    EXPECT_EQ(statistics.shots, 3U * matches);
    for (int match = 0; match < matches; ++match) {
        const auto published = stage.publisher.frames(name_of(match));
        ASSERT_FALSE(published.empty());
        EXPECT_GT(published.back().pose_number + stage.director.statistics().frames_per_camera, frames)
            << "the newest pose always wins";
        for (std::uint32_t i = 0; i < published.size(); ++i) {
            ASSERT_EQ(published[i].frame_number, i);
            const std::uint32_t before = i == 0 ? 0 : published[i - 1].pose_number;
            ASSERT_GT(published[i].pose_number, before);
        }
    }
}

// Holds the cameras of one match until it is released.
class BlockedPublisher final : public MemoryPublisher {
  public:
    using MemoryPublisher::publish;
    void publish(const std::string& match_id, const CameraFrame& frame) override {
        if (match_id == name_of(0)) released_.wait();
        MemoryPublisher::publish(match_id, frame);
    }
    void release() { release_.set_value(); }

  private:
    std::promise<void> release_;
    std::shared_future<void> released_ = release_.get_future();
};

TEST(ManyMatches, AMatchThatTakesLongDelaysNoOther) {
    BlockedPublisher publisher;
    MapLibrary maps;
    maps.set_ready("square", Stage::square());
    Director director(Stage::default_config(), maps, publisher);
    for (int match = 0; match < 2; ++match) {
        director.receive(Stage::info(name_of(match)));
        director.receive(Stage::request("a", 1, name_of(match)));
    }
    std::uint32_t number = 0;
    EXPECT_TRUE(test::eventually([&] {
        ++number;
        std::vector<PoseArrival> arrivals = {{name_of(0), Stage::poses(number)},
                                             {name_of(1), Stage::poses(number)}};
        director.receive(arrivals);
        return publisher.frames(name_of(1)).size() >= 30;
    }));
    EXPECT_TRUE(publisher.frames(name_of(0)).empty());
    publisher.release();
    director.flush();
    EXPECT_FALSE(publisher.frames(name_of(0)).empty());
}

}  // namespace
}  // namespace camdir::director
