#include "live/viewer.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace camdir::live {
namespace {

SharedMessage frame(int number) {
    return std::make_shared<Message>(Message{Message::Kind::frame, std::to_string(number)});
}

SharedMessage note(const std::string& content) {
    return std::make_shared<Message>(Message{Message::Kind::note, content});
}

std::vector<std::string> contents_taken(Viewer& viewer) {
    std::vector<std::string> taken;
    while (const SharedMessage message = viewer.take())
        taken.push_back(message->content);
    return taken;
}

TEST(Viewer, TakesWhatWasPutInOrder) {
    Viewer viewer([] {});
    viewer.put(note("a"));
    viewer.put(frame(1));
    viewer.put(note("b"));
    EXPECT_EQ(contents_taken(viewer), (std::vector<std::string>{"a", "1", "b"}));
    EXPECT_EQ(viewer.take(), nullptr);
}

TEST(Viewer, IsWokenWhenThereIsSomethingAgain) {
    int woken = 0;
    Viewer viewer([&] { ++woken; });
    viewer.put(frame(1));
    viewer.put(frame(2));
    EXPECT_EQ(woken, 1);
    EXPECT_EQ(contents_taken(viewer).size(), 2U);
    viewer.put(frame(3));
    EXPECT_EQ(woken, 2);
}

TEST(Viewer, ThatIsSlowLosesTheOldestFramesAndIsTold) {
    Viewer viewer([] {}, {3, 10});
    viewer.put(note("match"));
    std::size_t dropped = 0;
    for (int i = 0; i < 8; ++i)
        dropped += viewer.put(frame(i));
    EXPECT_EQ(dropped, 5U);
    auto taken = contents_taken(viewer);
    ASSERT_EQ(taken.size(), 5U);
    EXPECT_EQ(nlohmann::json::parse(taken.front()), (nlohmann::json{{"kind", "dropped"}, {"frames", 5}}));
    taken.erase(taken.begin());
    EXPECT_EQ(taken, (std::vector<std::string>{"match", "5", "6", "7"}));
    viewer.put(frame(9));
    EXPECT_EQ(contents_taken(viewer), std::vector<std::string>{"9"}) << "told once";
}

TEST(Viewer, ThatTakesNoNotesIsLost) {
    int woken = 0;
    Viewer viewer([&] { ++woken; }, {3, 2});
    viewer.put(note("a"));
    viewer.put(note("b"));
    EXPECT_FALSE(viewer.lost());
    viewer.put(note("c"));
    EXPECT_TRUE(viewer.lost());
    EXPECT_EQ(woken, 2) << "its connection is to be closed";
    viewer.put(note("d"));
    EXPECT_EQ(viewer.take(), nullptr) << "nothing is kept for it";
}

TEST(Viewer, TakesTheRestOfAMatchThatHasEnded) {
    Viewer viewer([] {});
    viewer.put(note("end"));
    viewer.finish();
    EXPECT_FALSE(viewer.finished());
    EXPECT_EQ(contents_taken(viewer).size(), 1U);
    EXPECT_TRUE(viewer.finished());
}

TEST(Viewer, ThatHasLeftIsNotWoken) {
    int woken = 0;
    Viewer viewer([&] { ++woken; });
    viewer.leave();
    viewer.put(note("a"));
    viewer.finish();
    EXPECT_EQ(woken, 0);
    EXPECT_TRUE(viewer.left());
    EXPECT_EQ(viewer.take(), nullptr);
}

}  // namespace
}  // namespace camdir::live
