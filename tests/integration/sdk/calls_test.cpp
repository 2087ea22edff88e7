// Wrong arguments and calls in the wrong order return a status and a reason; none crashes.
#include <camera_director/camera_director.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "support/kept_memory.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {
namespace {

using testing::HasSubstr;

cdir_context_options shared_options() {
    cdir_context_options options = cdir_context_options_default();
    options.domain = shared_domain;
    return options;
}

cdir_match_info some_info() {
    cdir_match_info info = cdir_match_info_default();
    std::strcpy(info.match_id, testing::UnitTest::GetInstance()->current_test_info()->name());
    std::strcpy(info.map_name, "oa_dm1");
    return info;
}

// A context with a match and an observer of that match.
class Calls : public testing::Test {
  protected:
    void SetUp() override {
        const cdir_context_options options = shared_options();
        const cdir_match_info info = some_info();
        ASSERT_EQ(cdir_context_open(&options, &context_), CDIR_OK) << cdir_last_error();
        ASSERT_EQ(cdir_match_open(context_, &info, nullptr, 0, &match_), CDIR_OK) << cdir_last_error();
        ASSERT_EQ(cdir_observer_open(context_, info.match_id, "anna", nullptr, &observer_), CDIR_OK);
    }
    void TearDown() override { (void)cdir_context_close(context_); }

    // A correct call of every function that takes a handle.
    struct Call {
        const char* name;
        std::function<cdir_status()> make;
    };
    [[nodiscard]] std::vector<Call> calls() {
        return {
            {"match_update", [&] { return cdir_match_update(match_, &info_, nullptr, 0); }},
            {"match_restart", [&] { return cdir_match_restart(match_, &info_, nullptr, 0); }},
            {"match_epoch", [&] { return cdir_match_epoch(match_, &epoch_); }},
            {"match_publish_poses", [&] { return cdir_match_publish_poses(match_, &poses_); }},
            {"match_publish_event", [&] { return cdir_match_publish_event(match_, &event_); }},
            {"match_set_movers", [&] { return cdir_match_set_movers(match_, &mover_, 1); }},
            {"match_publish_movers", [&] { return cdir_match_publish_movers(match_, &movers_); }},
            {"match_director_count", [&] { return cdir_match_director_count(match_, &count_); }},
            {"observer_request", [&] { return cdir_observer_request(observer_, &request_); }},
            {"observer_wait", [&] { return cdir_observer_wait(observer_, 0); }},
            {"observer_poll", [&] { return cdir_observer_poll(observer_, nullptr); }},
            {"observer_next_frame", [&] { return cdir_observer_next_frame(observer_, &frame_, nullptr, 0); }},
            {"observer_shot_status", [&] { return cdir_observer_shot_status(observer_, &status_); }},
            {"observer_newest_camera",
             [&] { return cdir_observer_newest_camera(observer_, &camera_, &view_); }},
            {"observer_camera_at", [&] { return cdir_observer_camera_at(observer_, 0, &camera_, &view_); }},
            {"observer_display_time", [&] { return cdir_observer_display_time(observer_, &time_); }},
            {"observer_match_info",
             [&] { return cdir_observer_match_info(observer_, &received_, nullptr, 0, nullptr); }},
            {"observer_get_counters", [&] { return cdir_observer_get_counters(observer_, &counters_); }},
            {"observer_withdraw", [&] { return cdir_observer_withdraw(observer_); }},
            {"observer_interrupt", [&] { return cdir_observer_interrupt(observer_); }},
            {"observer_close", [&] { return cdir_observer_close(observer_); }},
            {"match_close", [&] { return cdir_match_close(match_); }},
        };
    }

    cdir_context context_{};
    cdir_match match_{};
    cdir_observer observer_{};
    cdir_match_info info_ = some_info();
    cdir_match_info received_ = cdir_match_info_default();
    cdir_pose_frame poses_ = cdir_pose_frame_default();
    cdir_mover mover_ = cdir_mover_default();
    cdir_mover_frame movers_ = cdir_mover_frame_default();
    cdir_match_event event_ = cdir_match_event_default();
    cdir_shot_request request_ = cdir_shot_request_default();
    cdir_camera_frame frame_ = cdir_camera_frame_default();
    cdir_shot_status status_ = cdir_shot_status_default();
    cdir_camera camera_ = cdir_camera_default();
    cdir_view view_ = cdir_view_default();
    cdir_observer_counters counters_ = cdir_observer_counters_default();
    std::uint32_t count_ = 0;
    std::uint64_t epoch_ = 0;
    std::int64_t time_ = 0;
};

TEST_F(Calls, AllSucceedWithWhatTheyExpect) {
    for (const Call& call : calls()) {
        EXPECT_GE(call.make(), 0) << call.name << ": " << cdir_last_error();
    }
}

TEST_F(Calls, ClosedHandlesAreRefused) {
    ASSERT_EQ(cdir_observer_close(observer_), CDIR_OK);
    ASSERT_EQ(cdir_match_close(match_), CDIR_OK);
    for (const Call& call : calls()) {
        EXPECT_EQ(call.make(), CDIR_INVALID_HANDLE) << call.name;
        EXPECT_THAT(cdir_last_error(), HasSubstr("closed")) << call.name;
    }
}

TEST_F(Calls, ClosingTheContextClosesAllOfIt) {
    ASSERT_EQ(cdir_context_close(context_), CDIR_OK);
    for (const Call& call : calls()) {
        EXPECT_EQ(call.make(), CDIR_INVALID_HANDLE) << call.name;
    }
    cdir_match match{};
    EXPECT_EQ(cdir_match_open(context_, &info_, nullptr, 0, &match), CDIR_INVALID_HANDLE);
    EXPECT_EQ(cdir_observer_open(context_, "a", "b", nullptr, &observer_), CDIR_INVALID_HANDLE);
    EXPECT_EQ(cdir_context_close(context_), CDIR_INVALID_HANDLE);
    EXPECT_EQ(match.id, 0U);
}

TEST_F(Calls, ClosedObserversLeaveNothingOfTheirEndpoints) {
    const auto watch = [&](int number) {
        cdir_observer observer{};
        const std::string match_id = "watched " + std::to_string(number);
        ASSERT_EQ(cdir_observer_open(context_, match_id.c_str(), "anna", nullptr, &observer), CDIR_OK);
        ASSERT_EQ(cdir_observer_request(observer, &request_), CDIR_OK);
        ASSERT_EQ(cdir_observer_close(observer), CDIR_OK);
    };
    int watched = 0;
    const auto kept = bytes_kept(50, [&] { watch(++watched); });
    EXPECT_LT(kept, 1000.0) << "bytes of each";  // dds_delete() keeps 456 of each of the four endpoints
}

TEST_F(Calls, HandlesThatWereNeverOpenedAreRefused) {
    for (const std::uint64_t id : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}, match_.id << 32U}) {
        match_.id = id;
        observer_.id = id;
        for (const Call& call : calls()) {
            EXPECT_EQ(call.make(), CDIR_INVALID_HANDLE) << call.name;
        }
    }
}

TEST_F(Calls, NullPointersAreRefused) {
    const cdir_context_options options = shared_options();
    cdir_context context{};
    cdir_match match{};
    cdir_observer observer{};
    cdir_pose_frame poses = poses_;
    poses.player_count = 1;
    cdir_mover_frame movers = movers_;
    movers.mover_count = 1;
    cdir_shot_request request = request_;
    request.group_count = 1;
    cdir_context_options no_interface = options;
    no_interface.network_interface = nullptr;
    cdir_context_options no_directors = options;
    no_directors.directors = nullptr;
    const std::vector<Call> nulls = {
        {"context_open 1", [&] { return cdir_context_open(nullptr, &context); }},
        {"context_open 2", [&] { return cdir_context_open(&options, nullptr); }},
        {"context_open interface", [&] { return cdir_context_open(&no_interface, &context); }},
        {"context_open directors", [&] { return cdir_context_open(&no_directors, &context); }},
        {"match_open info", [&] { return cdir_match_open(context_, nullptr, nullptr, 0, &match); }},
        {"match_open players", [&] { return cdir_match_open(context_, &info_, nullptr, 1, &match); }},
        {"match_open match", [&] { return cdir_match_open(context_, &info_, nullptr, 0, nullptr); }},
        {"match_update info", [&] { return cdir_match_update(match_, nullptr, nullptr, 0); }},
        {"match_update players", [&] { return cdir_match_update(match_, &info_, nullptr, 1); }},
        {"match_restart info", [&] { return cdir_match_restart(match_, nullptr, nullptr, 0); }},
        {"match_restart players", [&] { return cdir_match_restart(match_, &info_, nullptr, 1); }},
        {"match_epoch", [&] { return cdir_match_epoch(match_, nullptr); }},
        {"publish_poses", [&] { return cdir_match_publish_poses(match_, nullptr); }},
        {"publish_poses arrays", [&] { return cdir_match_publish_poses(match_, &poses); }},
        {"set_movers", [&] { return cdir_match_set_movers(match_, nullptr, 1); }},
        {"publish_movers", [&] { return cdir_match_publish_movers(match_, nullptr); }},
        {"publish_movers arrays", [&] { return cdir_match_publish_movers(match_, &movers); }},
        {"publish_event", [&] { return cdir_match_publish_event(match_, nullptr); }},
        {"director_count", [&] { return cdir_match_director_count(match_, nullptr); }},
        {"observer_open match",
         [&] { return cdir_observer_open(context_, nullptr, "b", nullptr, &observer); }},
        {"observer_open id", [&] { return cdir_observer_open(context_, "a", nullptr, nullptr, &observer); }},
        {"observer_open handle", [&] { return cdir_observer_open(context_, "a", "b", nullptr, nullptr); }},
        {"request", [&] { return cdir_observer_request(observer_, nullptr); }},
        {"request group", [&] { return cdir_observer_request(observer_, &request); }},
        {"next_frame", [&] { return cdir_observer_next_frame(observer_, nullptr, nullptr, 0); }},
        {"next_frame cameras", [&] { return cdir_observer_next_frame(observer_, &frame_, nullptr, 1); }},
        {"shot_status", [&] { return cdir_observer_shot_status(observer_, nullptr); }},
        {"newest_camera", [&] { return cdir_observer_newest_camera(observer_, nullptr, &view_); }},
        {"newest_camera view", [&] { return cdir_observer_newest_camera(observer_, &camera_, nullptr); }},
        {"camera_at", [&] { return cdir_observer_camera_at(observer_, 0, nullptr, &view_); }},
        {"camera_at view", [&] { return cdir_observer_camera_at(observer_, 0, &camera_, nullptr); }},
        {"display_time", [&] { return cdir_observer_display_time(observer_, nullptr); }},
        {"match_info", [&] { return cdir_observer_match_info(observer_, nullptr, nullptr, 0, nullptr); }},
        {"match_info players",
         [&] { return cdir_observer_match_info(observer_, &received_, nullptr, 1, nullptr); }},
        {"get_counters", [&] { return cdir_observer_get_counters(observer_, nullptr); }},
    };
    for (const Call& call : nulls) {
        EXPECT_EQ(call.make(), CDIR_INVALID_ARGUMENT) << call.name;
        EXPECT_THAT(cdir_last_error(), HasSubstr("null")) << call.name;
    }
    EXPECT_EQ(context.id + match.id + observer.id, 0U) << "a failed call changed a handle";
}

TEST_F(Calls, StructsThatWereNotInitialisedAreRefused) {
    for (std::uint32_t* size :
         {&info_.struct_size, &poses_.struct_size, &event_.struct_size, &mover_.struct_size,
          &movers_.struct_size, &request_.struct_size, &frame_.struct_size, &status_.struct_size,
          &view_.struct_size, &received_.struct_size, &counters_.struct_size}) {
        *size = 0;
    }
    std::size_t refused = 0;
    for (const Call& call : calls()) {
        if (call.make() != CDIR_INVALID_ARGUMENT) continue;
        EXPECT_THAT(cdir_last_error(), HasSubstr("struct_size")) << call.name;
        ++refused;
    }
    EXPECT_EQ(refused, 13U);
}

TEST_F(Calls, WrongArgumentsAreRefusedAndNamed) {
    cdir_match match{};
    cdir_observer observer{};
    cdir_match_info info = info_;
    std::strcpy(info.match_id, "a/b");
    EXPECT_EQ(cdir_match_open(context_, &info, nullptr, 0, &match), CDIR_INVALID_ARGUMENT);
    EXPECT_THAT(cdir_last_error(), HasSubstr("match_id"));
    EXPECT_EQ(cdir_observer_open(context_, "a*", "b", nullptr, &observer), CDIR_INVALID_ARGUMENT);
    EXPECT_EQ(cdir_observer_open(context_, "a", std::string(64, 'x').c_str(), nullptr, &observer),
              CDIR_INVALID_ARGUMENT);
    EXPECT_THAT(cdir_last_error(), HasSubstr("observer_id"));
    cdir_observer_options options = cdir_observer_options_default();
    options.interpolation_delay = -1;
    EXPECT_EQ(cdir_observer_open(context_, "a", "b", &options, &observer), CDIR_INVALID_ARGUMENT);
    const std::vector<cdir_player> crowd(CDIR_MAX_PLAYERS + 1, cdir_player_default());
    EXPECT_EQ(cdir_match_update(match_, &info_, crowd.data(), CDIR_MAX_PLAYERS + 1), CDIR_INVALID_ARGUMENT);
    event_.reserved = 1;
    EXPECT_EQ(cdir_match_publish_event(match_, &event_), CDIR_INVALID_ARGUMENT);
    EXPECT_THAT(cdir_last_error(), HasSubstr("reserved"));
    request_.reserved[2] = 1;
    EXPECT_EQ(cdir_observer_request(observer_, &request_), CDIR_INVALID_ARGUMENT);
    request_.reserved[2] = 0;
    request_.target = 1;
    request_.team = 1;
    EXPECT_EQ(cdir_observer_request(observer_, &request_), CDIR_INVALID_ARGUMENT);
    EXPECT_THAT(cdir_last_error(), HasSubstr("CDIR_CHOOSE_TARGET"));
    cdir_player player = cdir_player_default();
    player.reserved[6] = 1;
    EXPECT_EQ(cdir_match_update(match_, &info_, &player, 1), CDIR_INVALID_ARGUMENT);
    options = cdir_observer_options_default();
    options.reserved = 1;
    EXPECT_EQ(cdir_observer_open(context_, "a", "b", &options, &observer), CDIR_INVALID_ARGUMENT);
    event_.reserved = 0;
    event_.kind = 0;
    EXPECT_EQ(cdir_match_publish_event(match_, &event_), CDIR_INVALID_ARGUMENT);
    event_ = cdir_match_event_default();
    std::memset(event_.detail, 'x', sizeof event_.detail);
    EXPECT_EQ(cdir_match_publish_event(match_, &event_), CDIR_INVALID_ARGUMENT);
    EXPECT_THAT(cdir_last_error(), HasSubstr("detail must have 0 to 31 bytes"));
    const std::string profile(32, 'x');
    request_ = cdir_shot_request_default();
    request_.profile = profile.c_str();
    EXPECT_EQ(cdir_observer_request(observer_, &request_), CDIR_INVALID_ARGUMENT);
    EXPECT_THAT(cdir_last_error(), HasSubstr("profile"));
    const std::string overrides(1024, ' ');
    request_ = cdir_shot_request_default();
    request_.overrides = overrides.c_str();
    EXPECT_EQ(cdir_observer_request(observer_, &request_), CDIR_INVALID_ARGUMENT);
    EXPECT_THAT(cdir_last_error(), HasSubstr("overrides"));
    poses_.reserved = 1;
    EXPECT_EQ(cdir_match_publish_poses(match_, &poses_), CDIR_INVALID_ARGUMENT);
    EXPECT_THAT(cdir_last_error(), HasSubstr("frame.reserved"));
    const std::vector<cdir_mover> fleet(CDIR_MAX_MOVERS + 1, cdir_mover_default());
    EXPECT_EQ(cdir_match_set_movers(match_, fleet.data(), CDIR_MAX_MOVERS + 1), CDIR_INVALID_ARGUMENT);
    EXPECT_THAT(cdir_last_error(), HasSubstr("CDIR_MAX_MOVERS"));
    EXPECT_EQ(cdir_match_set_movers(match_, fleet.data(), 2), CDIR_INVALID_ARGUMENT);
    EXPECT_THAT(cdir_last_error(), HasSubstr("mover 0: an earlier mover has the same id"));
    EXPECT_EQ(match.id + observer.id, 0U);
}

TEST_F(Calls, WithdrawingNothingIsAConflict) {
    EXPECT_EQ(cdir_observer_withdraw(observer_), CDIR_CONFLICT);
    EXPECT_EQ(cdir_observer_request(observer_, &request_), CDIR_OK);
    EXPECT_EQ(cdir_observer_withdraw(observer_), CDIR_OK);
    EXPECT_EQ(cdir_observer_withdraw(observer_), CDIR_CONFLICT);
}

TEST_F(Calls, ErrorMessagesBelongToTheirThread) {
    EXPECT_EQ(cdir_match_publish_poses(match_, nullptr), CDIR_INVALID_ARGUMENT);
    const std::string mine = cdir_last_error();
    std::thread([&] {
        EXPECT_STREQ(cdir_last_error(), "");
        EXPECT_EQ(cdir_observer_withdraw(observer_), CDIR_CONFLICT);
    }).join();
    EXPECT_EQ(cdir_last_error(), mine);
}

TEST(Contexts, OneDomainHasOneNetworkConfiguration) {
    cdir_context_options options = shared_options();
    cdir_context first{};
    cdir_context second{};
    ASSERT_EQ(cdir_context_open(&options, &first), CDIR_OK) << cdir_last_error();
    options.directors = "127.0.0.2";
    EXPECT_EQ(cdir_context_open(&options, &second), CDIR_CONFLICT);
    EXPECT_THAT(cdir_last_error(), HasSubstr("other network settings"));
    options = shared_options();
    EXPECT_EQ(cdir_context_open(&options, &second), CDIR_OK);
    EXPECT_EQ(cdir_context_close(first), CDIR_OK);
    const cdir_match_info info = some_info();
    cdir_match match{};
    EXPECT_EQ(cdir_match_open(second, &info, nullptr, 0, &match), CDIR_OK) << "the second keeps the domain";
    EXPECT_EQ(cdir_context_close(second), CDIR_OK);
    options.directors = "127.0.0.2";
    EXPECT_EQ(cdir_context_open(&options, &first), CDIR_OK) << "no context has the domain open";
    EXPECT_EQ(cdir_context_close(first), CDIR_OK);
}

TEST(Contexts, OptionsThatDdsRefusesAreANetworkError) {
    cdir_context context{};
    cdir_context_options options = shared_options();
    options.network_interface = "nosuchinterface0";
    EXPECT_EQ(cdir_context_open(&options, &context), CDIR_NETWORK);
    options = shared_options();
    options.cyclone_xml = "<CycloneDDS><Domain><NoSuchElement/></Domain></CycloneDDS>";
    EXPECT_EQ(cdir_context_open(&options, &context), CDIR_NETWORK);
    options = shared_options();
    options.domain = 233;
    EXPECT_EQ(cdir_context_open(&options, &context), CDIR_INVALID_ARGUMENT);
    options = shared_options();
    options.directors = "127.0.0.1,";
    EXPECT_EQ(cdir_context_open(&options, &context), CDIR_INVALID_ARGUMENT);
    EXPECT_EQ(context.id, 0U);
    options = shared_options();
    EXPECT_EQ(cdir_context_open(&options, &context), CDIR_OK) << "failures leave nothing behind";
    EXPECT_EQ(cdir_context_close(context), CDIR_OK);
}

// Cyclone DDS would abort the process.
TEST(Contexts, TooManyFileDescriptorsAreRefused) {
    rlimit limit{};
    ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &limit), 0);
    if (limit.rlim_max < 1100) GTEST_SKIP() << "needs 1100 file descriptors (ulimit -H -n)";
    const rlimit raised{std::max<rlim_t>(limit.rlim_cur, 1100), limit.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &raised), 0);
    std::vector<int> descriptors;
    while (descriptors.empty() || descriptors.back() < 1023) {
        descriptors.push_back(dup(STDIN_FILENO));
        ASSERT_GE(descriptors.back(), 0);
    }
    cdir_context context{};
    const cdir_context_options options = shared_options();
    EXPECT_EQ(cdir_context_open(&options, &context), CDIR_CONFLICT);
    EXPECT_THAT(cdir_last_error(), HasSubstr("file descriptors"));
    for (const int descriptor : descriptors) {
        close(descriptor);
    }
    EXPECT_EQ(cdir_context_open(&options, &context), CDIR_OK);
    EXPECT_EQ(cdir_context_close(context), CDIR_OK);
}

TEST(Library, StatusesAndStatesHaveNamesAndTheVersionIsTheHeaders) {
    EXPECT_EQ(cdir_abi_version(), CDIR_ABI_VERSION);
    EXPECT_STREQ(cdir_status_name(CDIR_OK), "CDIR_OK");
    EXPECT_STREQ(cdir_status_name(CDIR_INTERNAL), "CDIR_INTERNAL");
    EXPECT_STREQ(cdir_status_name(12345), "unknown status");
    EXPECT_STREQ(cdir_shot_state_name(CDIR_SHOT_REFUSED), "refused");
    EXPECT_STREQ(cdir_shot_state_name(CDIR_SHOT_UNANSWERED), "unanswered");
    EXPECT_STREQ(cdir_shot_state_name(12345), "unknown state");
}

}  // namespace
}  // namespace camdir::test
