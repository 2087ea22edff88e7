#include "maps/loader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "base/file.hpp"
#include "support/eventually.hpp"
#include "support/q3_maps.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::maps {
namespace {

using testing::AnyOf;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

class LoaderTest : public testing::Test {
  protected:
    config::Map add_room(const std::string& name, double length = 512.0) {
        auto bsp = test::room_map(Box3d(Vec3d(0.0, 0.0, 0.0), Vec3d(length, 384.0, 256.0)));
        test::add_spawn_point(bsp, Vec3d(256.0, 192.0, 40.0));
        config::Map map;
        map.name = name;
        map.file = folder_ / (name + ".vfs");
        map.source = folder_ / (name + ".bsp");
        map.d0 = 64.0;
        EXPECT_TRUE(write_file(map.source, test::encode(bsp)));
        return map;
    }

    // Begins to bake a map, and stays at the begin until finish_bake(): as if another process baked it.
    void begin_bake(const config::Map& map) {
        auto claimed = PendingFile::begin(map.file);
        ASSERT_TRUE(claimed && *claimed);
        held_.emplace(std::move(**claimed));
        loader_.load({map});
        ASSERT_TRUE(test::eventually([&] {
            const std::scoped_lock lock(mutex_);
            return activity_.starts_with(map.name + " baking: waiting for another bake");
        }));
    }
    void finish_bake() { held_.reset(); }

    // What the last load() has to do.
    void wait_until_it_is_known() {
        EXPECT_TRUE(test::eventually([&] { return !loader_.is_examining(); }));
    }

    void wait_for_end_of(std::size_t maps) {
        EXPECT_TRUE(test::eventually([&] {
            const std::scoped_lock lock(mutex_);
            return ended_ >= maps;
        }));
        loader_.stop();
    }

    // Loads the maps to the end; what the sink received, without the activities.
    std::vector<std::string> load(const std::vector<config::Map>& maps) {
        events_.clear();
        std::size_t pending = 0;
        {
            const std::scoped_lock lock(mutex_);
            ended_ = 0;
        }
        loader_.load(maps);
        wait_until_it_is_known();
        for (const std::string& event : events())
            pending += event.starts_with("added ") ? 1 : 0;
        wait_for_end_of(pending);
        return events_;
    }

    void note(const std::string& event, bool ends = false) {
        const std::scoped_lock lock(mutex_);
        events_.push_back(event);
        if (ends) ++ended_;
    }

    LoaderSink sink() {
        LoaderSink sink;
        sink.added = [this](const config::Map& map) {
            EXPECT_TRUE(loader_.is_examining());
            note("added " + map.name);
        };
        sink.removed = [this](const std::string& map) { note("removed " + map); };
        sink.loading = [this](const std::string& map, const std::string& activity) {
            const std::scoped_lock lock(mutex_);
            if (activity == "baking") bakes_.push_back(map);
            if (activity == "waiting to be baked") {
                EXPECT_TRUE(loader_.is_examining());
                waiting_.push_back(map);
            }
            activity_ = map + " " + activity;
        };
        sink.ready = [this](const std::string& map, const freespace::Freespace& freespace, double seconds) {
            EXPECT_FALSE(freespace.triangles().empty());
            vertices_ = freespace.vertices().size();
            note((seconds > 0.0 ? "baked " : "opened ") + map, true);
        };
        sink.failed = [this](const std::string& map, const std::string& reason) {
            note("failed " + map + ": " + reason, true);
        };
        return sink;
    }

    std::vector<std::string> events() {
        const std::scoped_lock lock(mutex_);
        return events_;
    }

    test::TemporaryFolder folder_;
    std::mutex mutex_;
    std::vector<std::string> events_;
    std::vector<std::string> bakes_;    // in the order of their begin
    std::vector<std::string> waiting_;  // in the order in which they were found to need a bake
    std::string activity_;              // the last one
    std::size_t ended_ = 0;
    std::size_t vertices_ = 0;  // of the map that was ready last
    Loader loader_{sink()};
    std::optional<PendingFile> held_;
};

TEST_F(LoaderTest, BakesOnceAndThenLoadsOnlyWhatChanged) {
    const config::Map a = add_room("a");
    EXPECT_THAT(load({a}), ElementsAre("added a", "baked a"));
    EXPECT_THAT(load({a}), IsEmpty());
    config::Map finer = a;
    finer.d0 = 48.0;
    EXPECT_THAT(load({finer}), ElementsAre("added a", "baked a"));
    std::filesystem::last_write_time(
        a.file, std::filesystem::file_time_type::clock::now() + std::chrono::seconds(10));
    EXPECT_THAT(load({finer}), ElementsAre("added a", "opened a"));
    EXPECT_THAT(load({}), ElementsAre("removed a"));
    EXPECT_THAT(load({finer}), ElementsAre("added a", "opened a"));
}

TEST_F(LoaderTest, BakesALoadedMapAgainWhoseSourceWasReplaced) {
    const config::Map a = add_room("a");
    ASSERT_THAT(load({a}), ElementsAre("added a", "baked a"));
    EXPECT_EQ(add_room("a", 768.0), a);
    loader_.load({a});
    wait_for_end_of(2);
    EXPECT_THAT(events_, ElementsAre("added a", "baked a", "added a", "baked a"));
    EXPECT_GT(freespace::Freespace::open(a.file)->bounds().max().x(), 512.0F);
}

TEST_F(LoaderTest, IsExaminingUntilItIsKnownWhoseSourceWasReplaced) {
    const config::Map a = add_room("a");
    const config::Map b = add_room("b");
    load({a, b});
    EXPECT_FALSE(loader_.is_examining());
    std::size_t ended = 2;
    for (const double length : {768.0, 640.0, 896.0}) {
        EXPECT_EQ(add_room("b", length), b);
        const std::size_t before = events().size();
        loader_.load({a, b});
        wait_until_it_is_known();
        ASSERT_GT(events().size(), before);
        EXPECT_EQ(events()[before], "added b");
        wait_for_end_of(++ended);
    }
}

TEST_F(LoaderTest, AMapWhoseBakeWasStoppedIsLoadedAnewAsItWasBefore) {
    const config::Map a = add_room("a");
    ASSERT_THAT(load({a}), ElementsAre("added a", "baked a"));
    config::Map finer = a;
    finer.d0 = 4.0;
    loader_.load({finer});
    wait_until_it_is_known();
    loader_.stop();
    EXPECT_THAT(load({a}), ElementsAre("added a", AnyOf("opened a", "baked a")));
}

TEST_F(LoaderTest, AFileThatWasReplacedWhileItWasLoadedIsLoadedAgain) {
    config::Map a = add_room("a");
    const config::Map b = add_room("b", 768.0);
    ASSERT_THAT(load({a, b}), ElementsAre("added a", "added b", "baked a", "baked b"));
    const auto size_of_b = std::filesystem::file_size(b.file);
    ASSERT_NE(std::filesystem::file_size(a.file), size_of_b);
    const auto bytes_of_a = read_file(a.file).value();
    const auto bytes_of_b = read_file(b.file).value();
    a.source.clear();
    for (int round = 0; round < 60; ++round) {  // at other moments of the loading
        ASSERT_TRUE(write_file(a.file, bytes_of_a));
        std::thread other([&] {
            std::this_thread::sleep_for(round * std::chrono::microseconds(100));
            EXPECT_TRUE(write_file(a.file, bytes_of_b));
        });
        load({a});
        other.join();
        load({a});
        ASSERT_EQ(vertices_, freespace::Freespace::open(b.file)->vertices().size());
    }
}

TEST_F(LoaderTest, OpensFilesBeforeItBakes) {
    const config::Map a = add_room("a");
    const config::Map b = add_room("b");
    ASSERT_THAT(load({b}), ElementsAre("added b", "baked b"));
    EXPECT_THAT(load({}), ElementsAre("removed b"));
    EXPECT_THAT(load({a, b}), ElementsAre("added a", "added b", "opened b", "baked a"));
}

TEST_F(LoaderTest, AMapThatFailsDoesNotStopTheOthers) {
    config::Map missing;
    missing.name = "missing";
    missing.file = folder_ / "missing.vfs";
    EXPECT_THAT(
        load({missing, add_room("a")}),
        ElementsAre("added missing", "added a", StartsWith("failed missing: " + missing.file), "baked a"));
}

TEST_F(LoaderTest, ABakeGoesOnWhereItsMapIsListedAsBefore) {
    const config::Map a = add_room("a");
    const config::Map b = add_room("b");
    begin_bake(a);
    loader_.load({a, b});
    EXPECT_TRUE(test::eventually([&] {
        const std::scoped_lock lock(mutex_);
        return waiting_ == std::vector<std::string>{"a", "b"};
    }));
    EXPECT_THAT(events(), ElementsAre("added a", "added b"));
    finish_bake();
    wait_for_end_of(2);
    EXPECT_THAT(events_, ElementsAre("added a", "added b", "baked a", "baked b"));
    EXPECT_THAT(bakes_, ElementsAre("a", "b"));
}

TEST_F(LoaderTest, FilesAreOpenedBesideABakeThatGoesOn) {
    const config::Map a = add_room("a");
    const config::Map b = add_room("b");
    ASSERT_THAT(load({b}), ElementsAre("added b", "baked b"));
    load({});
    events_.clear();
    ended_ = 0;
    begin_bake(a);
    loader_.load({a, b});
    wait_for_end_of(1);
    EXPECT_THAT(events_, ElementsAre("added a", "added b", "opened b"));
}

TEST_F(LoaderTest, ABakeBeginsAnewWhereItsSourceWasReplaced) {
    const config::Map a = add_room("a");
    begin_bake(a);
    EXPECT_EQ(add_room("a", 768.0), a);
    loader_.load({a});
    EXPECT_TRUE(test::eventually([&] {
        const std::scoped_lock lock(mutex_);
        return bakes_.size() == 2;
    }));
    finish_bake();
    wait_for_end_of(1);
    EXPECT_THAT(events_, ElementsAre("added a", "baked a"));
    EXPECT_GT(freespace::Freespace::open(a.file)->bounds().max().x(), 512.0F);
}

TEST_F(LoaderTest, ABakeGoesOnWhereItsSourceIsGone) {  // it may have read it before
    const config::Map a = add_room("a");
    config::Map missing;
    missing.name = "missing";
    missing.file = folder_ / "missing.vfs";
    begin_bake(a);
    std::filesystem::remove(a.source);
    loader_.load({a, missing});
    wait_for_end_of(1);
    EXPECT_THAT(events_,
                ElementsAre("added a", "added missing", StartsWith("failed missing: " + missing.file)));
    EXPECT_THAT(bakes_, ElementsAre("a"));
}

TEST_F(LoaderTest, AResultThatIsPutInPlaceIsOpenedInsteadOfBeingBaked) {
    const config::Map a = add_room("a");
    ASSERT_THAT(load({a}), ElementsAre("added a", "baked a"));
    const auto bytes = read_file(a.file).value();
    std::filesystem::remove(a.file);
    load({});
    events_.clear();
    ended_ = 0;
    begin_bake(a);
    ASSERT_TRUE(write_file(folder_ / "a.other", bytes));
    std::filesystem::rename(folder_ / "a.other", a.file);
    loader_.load({a});
    wait_for_end_of(1);
    EXPECT_THAT(events_, ElementsAre("added a", "opened a"));
}

TEST_F(LoaderTest, ABakeEndsWhereItsMapIsListedOtherwise) {
    config::Map a = add_room("a");
    begin_bake(a);
    a.d0 = 48.0;
    loader_.load({a});
    EXPECT_TRUE(test::eventually([&] { return events().size() == 2; }));
    finish_bake();
    wait_for_end_of(1);
    EXPECT_THAT(events_, ElementsAre("added a", "added a", "baked a"));
    EXPECT_EQ(freespace::Freespace::open(a.file)->metadata().d0, 48.0F);
}

TEST_F(LoaderTest, ABakeThatWasStoppedBeginsAnewWhereItsMapIsListedAgain) {
    const config::Map a = add_room("a");
    begin_bake(a);
    loader_.load({});
    wait_until_it_is_known();
    loader_.load({a});
    EXPECT_TRUE(test::eventually([&] { return events().size() == 3; }));
    finish_bake();
    wait_for_end_of(1);
    EXPECT_THAT(events_, ElementsAre("added a", "removed a", "added a", "baked a"));
}

}  // namespace
}  // namespace camdir::maps
