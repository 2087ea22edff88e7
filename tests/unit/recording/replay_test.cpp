// What is recorded of a match, given to a new director, makes the same cameras again.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "director/clock.hpp"
#include "recording/reader.hpp"
#include "recording/recorder.hpp"
#include "support/temporary_folder.hpp"
#include "unit/director/delayed_times.hpp"

namespace camdir::recording {
namespace {

using namespace director;
using Delayed = director::DelayedTimes;

class Recorded {
  public:
    Recorded() {
        RecorderOptions options;
        options.folder = folder_.path();
        options.max_bytes = options.max_match_bytes = 1ULL << 40;
        options.fragment_duration = ms;
        recorder_ = std::make_unique<Recorder>(options);
    }
    [[nodiscard]] Audiences audiences() const { return {recorder_.get()}; }

    // Ends the recording.
    [[nodiscard]] std::vector<Record> records() {
        recorder_.reset();
        std::vector<Record> records;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
            const auto reader = Reader::open(entry.path());
            EXPECT_TRUE(reader) << reader.error().message;
            EXPECT_TRUE(reader->replay(0, [&](const Record& record) { records.push_back(record); }).empty());
        }
        return records;
    }

  private:
    const test::TemporaryFolder folder_;
    std::unique_ptr<Recorder> recorder_;
};

// A ball that comes and goes between the players, and rests at times; a wall of an unknown model.
std::shared_ptr<const MatchMovers> movers_at(std::uint32_t number) {
    static const auto info = [] {
        MoverInfo described{1, {{7, {"*9", "func_door", {}, {}}}, {8, {}}}};
        described.movers[1].shape.balls.push_back({Vec3f::Zero(), 9.0F});
        return std::make_shared<const MoverInfo>(described);
    }();
    static std::map<std::uint32_t, std::shared_ptr<const MatchMovers>> known;
    if (number < 5) return nullptr;
    const std::uint32_t place = std::min(number % 40, 20U);  // the same at the end of each 40 frames
    auto& movers = known[place];
    if (!movers) {
        auto frame = std::make_shared<MoverFrame>(MoverFrame{1, 50 * ms * number, 77, {}});
        const float x = 30.0F + 2.0F * static_cast<float>(place);
        for (const std::uint32_t id : {7U, 8U})
            frame->poses.push_back({id, Vec3f(x, 50.0F, 0.0F), Quatf::Identity()});
        movers = std::make_shared<const MatchMovers>(MatchMovers{info, frame});
    }
    return movers;
}

// With a respawn that is only counted.
PoseFrame walk(std::uint32_t number) {
    PoseFrame frame = Stage::poses(number);
    frame.movers = movers_at(number);
    for (PlayerPose& pose : frame.poses)
        pose.discontinuities = pose.player_id == 2 && number > 40 ? 1U : 0U;
    return frame;
}

MatchEvent kill(std::uint32_t number) {
    return {1, walk(number).frame_time, 1, number % 3 + 1, number % 2 + 1, 1.0F, "rocket"};
}

// Of `number`, before its frame; nothing for most.
std::optional<ObserverRequest> asked_at(std::uint32_t number) {
    if (number % 12 != 3) return std::nullopt;
    ObserverRequest request = Stage::request("b", number % 24 == 3 ? no_player : 2);
    request.group = {1, 3};
    request.team = 1;
    request.overrides = R"({"distance": )" + std::to_string(40 + number) + "}";
    return request;
}

std::vector<CameraFrame> cameras_in(const std::vector<Record>& records) {
    std::vector<CameraFrame> cameras;
    for (const Record& record : records)
        if (const auto* frame = std::get_if<CameraFrame>(&record.message); frame && !frame->cameras.empty())
            cameras.push_back(*frame);
    return cameras;
}

// Every bit of them.
Bytes bits_of(const std::vector<CameraFrame>& frames) {
    RecordEncoder encoder(0);
    for (const CameraFrame& frame : frames)
        encoder.add(0, frame);
    return encoder.content();
}

void expect_same(const std::vector<CameraFrame>& a, const std::vector<CameraFrame>& b, std::size_t count) {
    EXPECT_EQ(a.size(), count);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        ASSERT_EQ(bits_of({a[i]}), bits_of({b[i]})) << "frame " << i;
}

// Puts the movers of records into the poses among them.
class WithMovers {
  public:
    [[nodiscard]] Message operator()(Message message) {
        if (const auto* info = std::get_if<MoverInfo>(&message)) info_ = std::make_shared<MoverInfo>(*info);
        if (const auto* frame = std::get_if<MoverFrame>(&message))
            movers_ =
                std::make_shared<const MatchMovers>(MatchMovers{info_, std::make_shared<MoverFrame>(*frame)});
        if (auto* poses = std::get_if<PoseFrame>(&message)) poses->movers = movers_;
        return message;
    }

  private:
    std::shared_ptr<const MoverInfo> info_;
    std::shared_ptr<const MatchMovers> movers_;
};

void give(Director& director, const Message& message) {
    if (const auto* info = std::get_if<MatchInfo>(&message)) director.receive(*info);
    if (const auto* frame = std::get_if<PoseFrame>(&message)) receive(director, "m", *frame);
    if (const auto* event = std::get_if<MatchEvent>(&message)) director.receive("m", *event);
    if (const auto* request = std::get_if<ObserverRequest>(&message)) director.receive(*request);
    if (const auto* gone = std::get_if<Withdrawal>(&message)) director.request_ended("m", gone->observer_id);
    director.flush();
}

TEST(Replay, MakesTheCamerasOfALiveMatch) {
    Recorded recorded;
    Stage stage(Stage::default_config(), recorded.audiences());
    stage.ask(Stage::request("automatic", no_player));
    stage.start();
    stage.ask(Stage::request("a"));
    for (std::uint32_t number = 0; number < 120; ++number) {
        if (number % 7 == 0) give(stage.director, kill(number));
        if (const auto request = asked_at(number)) stage.ask(*request);
        if (number == 70) give(stage.director, Withdrawal{"a"});
        stage.send(walk(number));
    }
    const auto records = recorded.records();
    expect_same(cameras_in(records), stage.publisher.frames(), 120);
    Stage again;
    WithMovers with_movers;
    for (const Record& record : records)
        give(again.director, with_movers(record.message));
    expect_same(again.publisher.frames(), stage.publisher.frames(), 120);
}

TEST(Replay, HasTheMoversBeforeTheFirstPosesAmongThem) {
    Recorded recorded;
    Stage stage(Stage::default_config(), recorded.audiences());
    stage.start();
    for (std::uint32_t number = 0; number < 45; ++number)
        stage.send(walk(number));
    std::size_t infos = 0, frames = 0, before_poses = 0;
    for (const Record& record : recorded.records()) {
        infos += std::holds_alternative<MoverInfo>(record.message) ? 1 : 0;
        frames += std::holds_alternative<MoverFrame>(record.message) ? 1 : 0;
        const auto* poses = std::get_if<PoseFrame>(&record.message);
        if (poses != nullptr && poses->frame_number == 5) before_poses = infos + frames;
    }
    EXPECT_EQ(before_poses, 2U);
    EXPECT_EQ(infos, 1U);
    EXPECT_EQ(frames, 16U + 5U) << "those in which something has moved";
}

TEST(Replay, TellsThatAMatchHasNoMoversAnyMore) {
    Recorded recorded;
    Stage stage(Stage::default_config(), recorded.audiences());
    stage.start();
    for (std::uint32_t number = 0; number < 45; ++number) {
        PoseFrame frame = walk(number);
        if (number >= 30 && number < 40) frame.movers = nullptr;
        stage.send(frame);
    }
    std::vector<std::size_t> described;
    std::size_t again = 0;
    for (const Record& record : recorded.records()) {
        if (const auto* info = std::get_if<MoverInfo>(&record.message))
            described.push_back(info->movers.size());
        again += described.size() == 3 && std::holds_alternative<MoverFrame>(record.message) ? 1 : 0;
    }
    EXPECT_EQ(described, (std::vector<std::size_t>{2, 0, 2}));
    EXPECT_EQ(again, 5U) << "where they were when they came again, and each motion after it";
}

TEST(Replay, MakesTheCamerasOfADelayedMatch) {
    Recorded recorded;
    // The first frame is due now, and later ones come faster than the clock: a match that rests after long
    // turns misses none.
    Delayed match(recorded.audiences(), now_ns() - delay_ns);
    match.tell(Stage::request("automatic", no_player));
    for (std::uint32_t number = 0; number < 120; ++number) {
        if (number % 7 == 0) match.put(kill(number), received(number));
        match.put_frame(walk(number));
    }
    for (std::uint32_t number = 0; number < 120; ++number) {
        if (const auto request = asked_at(number)) match.tell(*request);
        match.at(due(number) - lead_ns);
        match.at(due(number));
    }
    const auto records = recorded.records();
    expect_same(cameras_in(records), match.publisher.frames(), 120);

    Delayed again({}, now_ns() - delay_ns);  // has the description and the request of "a"
    WithMovers with_movers;
    std::uint32_t next = 0;
    for (const Record& record : records) {
        const Message message = with_movers(record.message);
        if (const auto* event = std::get_if<MatchEvent>(&message)) again.put(*event, received(next));
        if (const auto* frame = std::get_if<PoseFrame>(&message)) {
            again.put_frame(*frame);
            next = frame->frame_number + 1;
        }
    }
    for (const Record& record : records) {
        if (const auto* request = std::get_if<ObserverRequest>(&record.message)) again.tell(*request);
        if (const auto* frame = std::get_if<PoseFrame>(&record.message)) again.at(due(frame->frame_number));
    }
    expect_same(again.publisher.frames(), match.publisher.frames(), 120);
}

}  // namespace
}  // namespace camdir::recording
