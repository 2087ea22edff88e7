// The endpoints of one match without a gateway: what a take-over writes, and their removal.
#include "dds/match_endpoints.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "dds/endpoint_removal.hpp"
#include "domain_test.hpp"
#include "support/eventually.hpp"
#include "support/raw_peer.hpp"

namespace camdir::dds {
namespace {

using test::eventually;

director::CameraFrame frame_of_pose(std::uint32_t number) {
    director::CameraFrame frame;
    frame.epoch = 1;
    frame.frame_number = frame.pose_number = number;
    frame.cameras.emplace_back();
    return frame;
}

director::ObserverStatus status_of(const std::string& observer_id) {
    director::ObserverStatus status;
    status.match_id = "cup";
    status.observer_id = observer_id;
    return status;
}

std::vector<dds_entity_t> children_of(dds_entity_t entity) {
    std::array<dds_entity_t, 64> children{};
    const dds_return_t count = dds_get_children(entity, children.data(), children.size());
    return {children.begin(), children.begin() + std::max(count, 0)};
}

bool is_camera_writer(dds_entity_t entity) {
    std::array<char, 64> name{};
    dds_get_name(dds_get_topic(entity), name.data(), name.size());
    return std::string_view(name.data()).ends_with(topic_name(Topic::camera_frame));
}

// Of a director that stands by until leads() is called.
class MatchEndpointsTest : public DomainTest {
  protected:
    void SetUp() override {
        ASSERT_NO_FATAL_FAILURE(DomainTest::SetUp());
        auto match = MatchEndpoints::open(*participant_, "cup", {.lease = max_lease}, 7, counters_);
        ASSERT_TRUE(match) << match.error().message;
        match_ = std::move(*match);
    }
    void TearDown() override {
        match_.reset();
        participant_.reset();
    }

    bool leads() {
        return eventually([&] {
            match_->decide();
            return match_->is_leading();
        });
    }

    // Readers that receive the cameras that the director writes.
    std::uint32_t viewers() {
        dds_publication_matched_status_t status{};
        for (const dds_entity_t publisher : children_of(participant_->handle()))
            for (const dds_entity_t writer : children_of(publisher))
                if (is_camera_writer(writer) && dds_get_publication_matched_status(writer, &status) >= 0)
                    return status.current_count;
        return 0;
    }
    void owe_status_of(const std::string& observer_id) { EXPECT_TRUE(match_->write(status_of(observer_id))); }
    void catch_up() {
        while (match_->catch_up()) {
        }
    }

    WireCounters counters_;
    std::unique_ptr<MatchEndpoints> match_;
};

TEST_F(MatchEndpointsTest, ATakeOverAnswersAFewShowsItsCamerasAndThenAnswersTheRestBucketByBucket) {
    for (std::uint32_t i = 0; i < 3; ++i)
        EXPECT_FALSE(match_->write(frame_of_pose(i)));
    std::set<StatusBuckets::Number> buckets;
    for (int i = 0; buckets.size() < 6; ++i)
        if (buckets.insert(StatusBuckets::number_of(std::to_string(i))).second)
            owe_status_of(std::to_string(i));
    for (int i = 0;; ++i) {
        const std::string other = "gone" + std::to_string(i);
        if (buckets.contains(StatusBuckets::number_of(other))) continue;
        owe_status_of(other);
        match_->withdraw(other);
        break;
    }
    EXPECT_FALSE(match_->owes());
    ASSERT_TRUE(leads());
    EXPECT_TRUE(match_->owes());
    EXPECT_EQ(counters_.camera_frames_written, 0U);

    EXPECT_TRUE(match_->catch_up());
    EXPECT_EQ(counters_.camera_frames_written, 3U);
    EXPECT_EQ(counters_.statuses_written, 4U);
    EXPECT_TRUE(match_->catch_up());
    EXPECT_EQ(counters_.statuses_written, 5U);
    EXPECT_TRUE(match_->owes());
    EXPECT_FALSE(match_->catch_up());
    EXPECT_EQ(counters_.statuses_written, 6U) << "and nothing of an empty bucket";
    EXPECT_FALSE(match_->owes());
}

TEST_F(MatchEndpointsTest, ATakeOverShowsAFewOfItsCamerasAtATime) {
    for (std::uint32_t i = 0; i < 10; ++i)
        EXPECT_FALSE(match_->write(frame_of_pose(i)));
    ASSERT_TRUE(leads());
    EXPECT_TRUE(match_->catch_up());
    EXPECT_LT(counters_.camera_frames_written, 10U);
    catch_up();
    EXPECT_EQ(counters_.camera_frames_written, 10U);
}

TEST_F(MatchEndpointsTest, NoFrameOvertakesThoseThatATakeOverOwes) {
    const std::uint32_t before = viewers();
    test::RawPeer raw(domain_.id(), "cup");
    ASSERT_TRUE(eventually([&] { return raw.directors() == 1 && viewers() > before; }));
    for (std::uint32_t i = 0; i < 3; ++i)
        EXPECT_FALSE(match_->write(frame_of_pose(i)));
    ASSERT_TRUE(leads());
    EXPECT_TRUE(match_->write(frame_of_pose(3)));
    EXPECT_EQ(counters_.camera_frames_written, 3U) << "the caller counts its own";
    std::vector<std::uint32_t> poses;
    EXPECT_TRUE(eventually([&] {
        for (const auto& frame : raw.take_cameras())
            poses.push_back(frame.pose_number);
        return poses.size() == 4;
    }));
    EXPECT_EQ(poses, (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

TEST_F(MatchEndpointsTest, AnswersFollowTheNextFrameAndABucketThatChangesOftenIsWrittenOnce) {
    ASSERT_TRUE(leads());
    catch_up();
    for (int i = 0; i < 10; ++i) {
        owe_status_of("anna");
        match_->withdraw("anna");
        owe_status_of("anna");
    }
    EXPECT_TRUE(match_->owes());
    EXPECT_EQ(counters_.statuses_written, 0U);
    EXPECT_TRUE(match_->write(frame_of_pose(0)));
    EXPECT_EQ(counters_.statuses_written, 1U);
    EXPECT_FALSE(match_->owes());
}

TEST_F(MatchEndpointsTest, AFrameIsFollowedByAFewBucketsAndInTheEndByAll) {
    ASSERT_TRUE(leads());
    catch_up();
    std::set<StatusBuckets::Number> buckets;
    for (int i = 0; buckets.size() < 20; ++i) {
        buckets.insert(StatusBuckets::number_of(std::to_string(i)));
        owe_status_of(std::to_string(i));
    }
    for (std::uint32_t i = 0; match_->owes() && i < 20; ++i) {
        const std::uint64_t before = counters_.statuses_written;
        EXPECT_TRUE(match_->write(frame_of_pose(i)));
        EXPECT_LE(counters_.statuses_written, before + 4);
    }
    EXPECT_EQ(counters_.statuses_written, 20U);
}

TEST_F(MatchEndpointsTest, BucketsThatChangeWithEachFrameKeepNoOtherWaiting) {
    test::RawPeer raw(domain_.id(), "cup");
    ASSERT_TRUE(eventually([&] { return raw.directors() == 1; }));
    std::map<StatusBuckets::Number, std::string> observers;
    for (int i = 0; observers.size() < 5; ++i)
        observers.emplace(StatusBuckets::number_of(std::to_string(i)), std::to_string(i));
    const std::string patient = observers.rbegin()->second;
    ASSERT_TRUE(leads());
    catch_up();
    owe_status_of(patient);
    for (std::uint32_t i = 0; i < 3; ++i) {
        for (const auto& [bucket, observer] : observers)
            if (observer != patient) owe_status_of(observer);
        EXPECT_TRUE(match_->write(frame_of_pose(i)));
    }
    EXPECT_TRUE(eventually([&] { return raw.statuses().contains(patient); }));
}

TEST_F(MatchEndpointsTest, WhatDdsRefusesIsOwedUntilItIsWritten) {
    ASSERT_TRUE(leads());
    catch_up();
    owe_status_of("anna");
    match_->release_ownership();  // deletes the writer
    EXPECT_FALSE(match_->catch_up()) << "not again at once";
    EXPECT_EQ(counters_.write_failures, 1U);
    EXPECT_TRUE(match_->owes());
    std::ignore = match_->write(frame_of_pose(0));
    EXPECT_EQ(counters_.write_failures, 1U) << "no frame waits for what fails";
    EXPECT_FALSE(match_->catch_up());
    EXPECT_EQ(counters_.write_failures, 2U);
}

TEST_F(MatchEndpointsTest, OnlyWhatIsThereIsWithdrawn) {
    ASSERT_TRUE(leads());
    catch_up();
    match_->withdraw("anna");
    EXPECT_FALSE(match_->owes());
    owe_status_of("anna");
    catch_up();
    match_->withdraw("anna");
    EXPECT_TRUE(match_->owes());
    catch_up();
    EXPECT_EQ(counters_.statuses_written, 2U);
}

TEST_F(MatchEndpointsTest, StandingByIsSpreadAndReadersForgetWhatWasWritten) {
    test::RawPeer raw(domain_.id(), "cup");
    ASSERT_TRUE(eventually([&] { return raw.directors() == 1; }));
    std::set<StatusBuckets::Number> buckets;
    for (const char* observer : {"anna", "berta", "clara"}) {
        owe_status_of(observer);
        buckets.insert(StatusBuckets::number_of(observer));
    }
    ASSERT_TRUE(leads());
    catch_up();
    ASSERT_TRUE(eventually([&] { return raw.statuses().size() == 3; }));
    match_->see({.director_id = 9, .term = 5, .lease = max_lease, .leads = true, .has_cameras = true});
    EXPECT_FALSE(match_->is_leading());
    EXPECT_EQ(raw.statuses().size(), 3U);
    EXPECT_LT(raw.camera_strength(), 5 * 65536) << "as what it wrote is still there";
    std::size_t steps = 1;
    while (match_->catch_up())
        ++steps;
    EXPECT_EQ(steps, 1 + buckets.size()) << "its cameras, and each of its buckets";
    EXPECT_FALSE(match_->owes());
    EXPECT_TRUE(eventually([&] { return raw.statuses().empty() && raw.camera_strength() == 6 * 65536; }));
}

TEST_F(MatchEndpointsTest, AMatchIsRemovedUntilItsEndpointsAreDeleted) {
    std::atomic<bool> may_delete{false};
    MatchTable::Endpoints endpoints(match_.release(), [&](MatchEndpoints* match) {
        may_delete.wait(false);
        delete match;
    });
    EndpointRemoval removal(2);
    removal.add(std::move(endpoints));
    EXPECT_TRUE(removal.removes("cup"));
    EXPECT_FALSE(removal.removes("final"));
    EXPECT_TRUE(removal.has_room());
    may_delete = true;
    may_delete.notify_all();
    EXPECT_TRUE(eventually([&] { return !removal.removes("cup"); }));
}

}  // namespace
}  // namespace camdir::dds
