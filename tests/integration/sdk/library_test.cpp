// What the application gives the library: its memory, its log, and no thread to wait on.
#include <camera_director/camera_director.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <future>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/test_domain.hpp"

namespace camdir::test {
namespace {

using testing::Contains;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

cdir_context_options options_of(const TestDomain& domain) {
    cdir_context_options options = cdir_context_options_default();
    options.domain = domain.id();
    return options;
}

cdir_match_info cup_info() {
    cdir_match_info info = cdir_match_info_default();
    std::strcpy(info.match_id, "cup");
    std::strcpy(info.map_name, "oa_dm1");
    return info;
}

// Players 1 and 2 together.
cdir_shot_request request_of_a_group() {
    static constexpr std::uint32_t group[] = {1, 2};
    cdir_shot_request request = cdir_shot_request_default();
    request.target = CDIR_SHOW_GROUP;
    request.group = group;
    request.group_count = 2;
    return request;
}

// Leaves the library as it was.
class LibraryOptions : public testing::Test {
  protected:
    void TearDown() override {
        const cdir_library_options options = cdir_library_options_default();
        EXPECT_EQ(cdir_library_configure(&options), CDIR_OK);
    }

    TestDomain domain_;
    cdir_context_options options_ = options_of(domain_);
    cdir_context context_{};
};

// Knows each piece of memory that it has given.
class Heap {
  public:
    void set_in(cdir_library_options& options) {
        options.allocate = [](void* self, std::size_t size, std::size_t alignment) {
            return static_cast<Heap*>(self)->allocate(size, alignment);
        };
        options.free = [](void* self, void* memory, std::size_t size, std::size_t alignment) {
            static_cast<Heap*>(self)->free(memory, size, alignment);
        };
        options.allocator_data = this;
    }
    void exhaust() {
        const std::lock_guard lock(mutex_);
        exhausted_ = true;
    }
    // The next piece takes long; the future is ready when it has been asked for.
    [[nodiscard]] std::future<void> be_slow_once() {
        const std::lock_guard lock(mutex_);
        return slow_turn_.emplace().get_future();
    }
    [[nodiscard]] std::size_t used() const {
        const std::lock_guard lock(mutex_);
        std::size_t bytes = 0;
        for (const auto& [memory, size] : given_)
            bytes += size;
        return bytes;
    }
    [[nodiscard]] std::size_t pieces() const {
        const std::lock_guard lock(mutex_);
        return given_.size();
    }

  private:
    void* allocate(std::size_t size, std::size_t alignment) {
        if (auto asked = take_slow_turn()) {
            asked->set_value();
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        const std::lock_guard lock(mutex_);
        if (exhausted_) return nullptr;
        void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
        given_[memory] = size;
        return memory;
    }
    void free(void* memory, std::size_t size, std::size_t /*alignment*/) {
        const std::lock_guard lock(mutex_);
        const auto found = given_.find(memory);
        ASSERT_NE(found, given_.end()) << "memory of another allocator";
        EXPECT_EQ(found->second, size);
        given_.erase(found);
        std::free(memory);
    }

    std::optional<std::promise<void>> take_slow_turn() {
        const std::lock_guard lock(mutex_);
        return std::exchange(slow_turn_, std::nullopt);
    }

    mutable std::mutex mutex_;
    bool exhausted_ = false;
    std::optional<std::promise<void>> slow_turn_;
    std::map<void*, std::size_t> given_;
};

TEST_F(LibraryOptions, WhatIsOpenLivesInTheApplicationsMemory) {
    Heap heap;
    cdir_library_options library = cdir_library_options_default();
    heap.set_in(library);
    ASSERT_EQ(cdir_library_configure(&library), CDIR_OK) << cdir_last_error();
    ASSERT_EQ(cdir_context_open(&options_, &context_), CDIR_OK) << cdir_last_error();
    const cdir_match_info info = cup_info();
    cdir_match match{};
    cdir_observer observer{};
    ASSERT_EQ(cdir_match_open(context_, &info, nullptr, 0, &match), CDIR_OK);
    const std::size_t with_match = heap.used();
    EXPECT_GT(with_match, 10'000U) << "a match's poses";
    ASSERT_EQ(cdir_observer_open(context_, "cup", "anna", nullptr, &observer), CDIR_OK);
    EXPECT_GT(heap.used(), with_match);

    // Publishing takes no memory that it does not give back, once its players are known.
    const std::uint32_t id = 1, flags = CDIR_POSE_ALIVE;
    const float eye[3] = {}, orientation[4] = {0, 0, 0, 1};
    cdir_pose_frame frame = cdir_pose_frame_default();
    frame.player_count = 1;
    frame.player_id = &id;
    frame.flags = &flags;
    frame.eye = eye;
    frame.orientation = orientation;
    ASSERT_EQ(cdir_match_publish_poses(match, &frame), CDIR_OK) << cdir_last_error();
    const std::size_t published = heap.used();
    for (int i = 0; i < 10; ++i)
        ASSERT_EQ(cdir_match_publish_poses(match, &frame), CDIR_OK);
    EXPECT_EQ(heap.used(), published);

    library = cdir_library_options_default();
    ASSERT_EQ(cdir_library_configure(&library), CDIR_OK) << "what is open keeps its allocator";
    const std::size_t pieces = heap.pieces();
    const cdir_shot_request request = request_of_a_group();
    ASSERT_EQ(cdir_observer_request(observer, &request), CDIR_OK) << cdir_last_error();
    EXPECT_EQ(heap.pieces(), pieces + 1);
    ASSERT_EQ(cdir_context_close(context_), CDIR_OK);
    EXPECT_EQ(heap.pieces(), 0U);
}

TEST_F(LibraryOptions, MemoryThatRunsOutIsAnErrorThatLeavesNothingBehind) {
    Heap heap;
    cdir_library_options library = cdir_library_options_default();
    heap.set_in(library);
    ASSERT_EQ(cdir_library_configure(&library), CDIR_OK);
    ASSERT_EQ(cdir_context_open(&options_, &context_), CDIR_OK) << cdir_last_error();
    heap.exhaust();
    const cdir_match_info info = cup_info();
    cdir_match match{};
    cdir_observer observer{};
    cdir_context other{};
    EXPECT_EQ(cdir_match_open(context_, &info, nullptr, 0, &match), CDIR_OUT_OF_MEMORY);
    EXPECT_EQ(cdir_observer_open(context_, "cup", "anna", nullptr, &observer), CDIR_OUT_OF_MEMORY);
    EXPECT_EQ(cdir_context_open(&options_, &other), CDIR_OUT_OF_MEMORY);
    EXPECT_STREQ(cdir_last_error(), "out of memory");
    EXPECT_EQ(match.id + observer.id + other.id, 0U);
    ASSERT_EQ(cdir_context_close(context_), CDIR_OK);
    EXPECT_EQ(heap.pieces(), 0U);
}

TEST_F(LibraryOptions, MessagesGoToTheApplicationsLog) {
    std::vector<std::string> lines;
    cdir_library_options library = cdir_library_options_default();
    library.log = [](void* data, std::uint32_t level, const char* text) {
        if (level == CDIR_LOG_ERROR) static_cast<std::vector<std::string>*>(data)->emplace_back(text);
    };
    library.log_data = &lines;
    ASSERT_EQ(cdir_library_configure(&library), CDIR_OK);
    options_.cyclone_xml = "<CycloneDDS><Domain><NoSuchElement/></Domain></CycloneDDS>";
    EXPECT_EQ(cdir_context_open(&options_, &context_), CDIR_NETWORK);
    EXPECT_THAT(lines, Contains(HasSubstr("NoSuchElement")));
    EXPECT_THAT(lines, Not(Contains(EndsWith("\n"))));

    const std::size_t count = lines.size();
    library = cdir_library_options_default();
    ASSERT_EQ(cdir_library_configure(&library), CDIR_OK);
    EXPECT_EQ(cdir_context_open(&options_, &context_), CDIR_NETWORK);
    EXPECT_EQ(lines.size(), count) << "the log was taken back";
}

TEST_F(LibraryOptions, HalfAnAllocatorIsRefused) {
    cdir_library_options library = cdir_library_options_default();
    library.allocate = [](void*, std::size_t, std::size_t) -> void* { return nullptr; };
    EXPECT_EQ(cdir_library_configure(&library), CDIR_INVALID_ARGUMENT);
    EXPECT_STREQ(cdir_last_error(), "allocate or free is null");
    EXPECT_EQ(cdir_library_configure(nullptr), CDIR_INVALID_ARGUMENT);
}

TEST_F(LibraryOptions, AContextOpensInTheBackground) {
    {
        const std::string directors = "127.0.0.1";  // is not needed any more when the call returns
        options_.directors = directors.c_str();
        ASSERT_EQ(cdir_context_open_async(&options_, &context_), CDIR_OK) << cdir_last_error();
    }
    ASSERT_EQ(cdir_context_wait(context_, -1), CDIR_OK) << cdir_last_error();
    EXPECT_EQ(cdir_context_wait(context_, 0), CDIR_OK);
    const cdir_match_info info = cup_info();
    cdir_match match{};
    EXPECT_EQ(cdir_match_open(context_, &info, nullptr, 0, &match), CDIR_OK) << cdir_last_error();
    EXPECT_EQ(cdir_context_close(context_), CDIR_OK);
    EXPECT_EQ(cdir_context_wait(context_, -1), CDIR_INVALID_HANDLE);
    EXPECT_EQ(cdir_match_close(match), CDIR_INVALID_HANDLE);
}

TEST_F(LibraryOptions, AContextThatCannotBeOpenedSaysSoWhereItIsUsed) {
    options_.network_interface = "nosuchinterface0";
    ASSERT_EQ(cdir_context_open_async(&options_, &context_), CDIR_OK) << cdir_last_error();
    EXPECT_EQ(cdir_context_wait(context_, -1), CDIR_NETWORK);
    EXPECT_THAT(cdir_last_error(), HasSubstr("nosuchinterface0"));
    cdir_observer observer{};
    EXPECT_EQ(cdir_observer_open(context_, "cup", "anna", nullptr, &observer), CDIR_NETWORK);
    EXPECT_THAT(cdir_last_error(), HasSubstr("nosuchinterface0"));
    EXPECT_EQ(cdir_context_close(context_), CDIR_OK);

    cdir_context none{};
    options_.directors = "127.0.0.1,";
    EXPECT_EQ(cdir_context_open_async(&options_, &none), CDIR_INVALID_ARGUMENT) << "malformed";
    EXPECT_EQ(none.id, 0U);
}

TEST_F(LibraryOptions, WhatIsClosedIsGoneAlthoughACallWasInProgress) {
    Heap heap;
    cdir_library_options library = cdir_library_options_default();
    heap.set_in(library);
    ASSERT_EQ(cdir_library_configure(&library), CDIR_OK);
    ASSERT_EQ(cdir_context_open(&options_, &context_), CDIR_OK) << cdir_last_error();
    cdir_observer observer{};
    ASSERT_EQ(cdir_observer_open(context_, "cup", "anna", nullptr, &observer), CDIR_OK);
    auto begun = heap.be_slow_once();
    const std::jthread asks([observer] {
        const cdir_shot_request request = request_of_a_group();
        EXPECT_EQ(cdir_observer_request(observer, &request), CDIR_OK) << cdir_last_error();
    });
    begun.wait();
    ASSERT_EQ(cdir_context_close(context_), CDIR_OK);
    EXPECT_EQ(heap.pieces(), 0U);
    options_.directors = "127.0.0.1:7777";  // refused where the domain is still open with other settings
    ASSERT_EQ(cdir_context_open(&options_, &context_), CDIR_OK) << cdir_last_error();
    ASSERT_EQ(cdir_context_close(context_), CDIR_OK);
}

TEST_F(LibraryOptions, AContextMayBeClosedWhileItOpens) {
    for (int i = 0; i < 20; ++i) {
        ASSERT_EQ(cdir_context_open_async(&options_, &context_), CDIR_OK) << cdir_last_error();
        ASSERT_EQ(cdir_context_close(context_), CDIR_OK);
    }
}

}  // namespace
}  // namespace camdir::test
