// A director that records what it serves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <map>

#include "hall.hpp"
#include "recording/reader.hpp"
#include "support/eventually.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {
namespace {

namespace fs = std::filesystem;
using camera_director::Context;
using camera_director::Observer;
using recording::Reader;

// The only recording in the folder, when it has this many fragments.
std::optional<Reader> recording_in(const fs::path& folder, std::uint32_t fragments) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        auto reader = Reader::open(entry.path());
        if (reader && reader->last_fragment() + 1 >= fragments) return std::move(*reader);
    }
    return std::nullopt;
}

TEST(RecordingTest, AKilledDirectorLeavesTheCamerasThatItPublished) {
    const TestDomain domain;
    const TemporaryFolder folder;
    Server server(domain.id(), {.recording = folder / "recordings"});
    ASSERT_TRUE(server.ready()) << server.log();
    const Context context = Context::open(connection(domain.id())).value();
    const Game game(context, "cup 1", "hall");
    Observer observer = Observer::open(context, "cup 1", "spectator").value();
    observer.request({.target = 1}).value();
    std::map<std::uint32_t, camera_director::Camera> received;  // by frame
    ASSERT_TRUE(sees(observer, [&](const auto& frame, auto cameras) {
        if (cameras.size() == 1) received.emplace(frame.frame_number, cameras[0]);
        return received.size() % 20 == 0 && recording_in(folder / "recordings", 2);
    })) << server.log();
    server.process().send_signal(SIGKILL);
    EXPECT_EQ(server.process().wait(), -SIGKILL);

    const auto reader = recording_in(folder / "recordings", 2);
    ASSERT_TRUE(reader);
    EXPECT_EQ(reader->start().match.match_id, "cup 1");
    std::size_t compared = 0;
    bool asked = false;
    const auto compare = [&](const recording::Record& record) {
        if (const auto* request = std::get_if<director::ObserverRequest>(&record.message))
            asked = asked || request->observer_id == "spectator";
        const auto* frame = std::get_if<director::CameraFrame>(&record.message);
        if (frame == nullptr || frame->cameras.size() != 1) return;
        const auto sent = received.find(frame->frame_number);
        if (sent == received.end()) return;
        for (int axis = 0; axis < 3; ++axis)
            ASSERT_EQ(frame->cameras[0].position[axis], sent->second.position[axis]);
        ++compared;
    };
    EXPECT_TRUE(reader->replay(0, compare).empty());
    EXPECT_TRUE(asked);
    EXPECT_GT(compared, 100U);
}

TEST(RecordingTest, AFolderThatCannotBeUsedCostsNoCameras) {
    const TestDomain domain;
    Server server(domain.id(), {.recording = "/dev/null/recordings"});
    ASSERT_TRUE(server.ready()) << server.log();
    const Context context = Context::open(connection(domain.id())).value();
    const Game game(context, "cup", "hall");
    const Game other(context, "final", "hall");
    Observer observer = Observer::open(context, "cup", "spectator").value();
    observer.request({.target = 1}).value();
    for (const std::string match : {"cup", "final"})
        EXPECT_TRUE(eventually([&] {
            return server.log().find("match " + match +
                                     ": no longer recorded: /dev/null/recordings: cannot create") !=
                   std::string::npos;
        })) << server.log();
    EXPECT_TRUE(sees_own_camera(observer));
}

}  // namespace
}  // namespace camdir::test
