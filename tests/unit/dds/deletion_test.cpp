// What deleted entities leave in the process.
#include "idl/deletion.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include "dds/match_endpoints.hpp"
#include "dds/participant.hpp"
#include "support/eventually.hpp"
#include "support/test_domain.hpp"

namespace camdir::dds {
namespace {

// Of Cyclone DDS, too; 0 where a sanitizer allocates.
std::size_t bytes_in_use() {
    return ::mallinfo2().uordblks;
}

class DeletionTest : public testing::Test {
  protected:
    void SetUp() override {
        config::Dds config;
        config.domain = domain_.id();
        auto participant = Participant::open(config);
        ASSERT_TRUE(participant) << participant.error().message;
        participant_.emplace(std::move(*participant));
    }

    void open_and_delete_match(int number) {
        auto match = MatchEndpoints::open(*participant_, "match " + std::to_string(number), {}, 7, counters_);
        ASSERT_TRUE(match) << match.error().message;
    }

    test::TestDomain domain_;
    std::optional<Participant> participant_;
    WireCounters counters_;
};

TEST_F(DeletionTest, MatchesThatHaveEndedLeaveNothing) {
    constexpr int warm_up = 30;
    constexpr int matches = 100;
    constexpr std::size_t allowed_per_match = 1000;  // dds_delete() leaves 456 of each of the nine endpoints
    for (int i = 0; i < warm_up; ++i)
        open_and_delete_match(i);
    const std::size_t before = bytes_in_use();
    for (int i = 0; i < matches; ++i)
        open_and_delete_match(warm_up + i);
    EXPECT_TRUE(test::eventually([&] { return bytes_in_use() <= before + matches * allowed_per_match; }))
        << (static_cast<double>(bytes_in_use()) - static_cast<double>(before)) / matches << " bytes a match";
}

TEST_F(DeletionTest, DeletesAnEntityAlone) {
    Entity subscriber(dds_create_subscriber(participant_->handle(), nullptr, nullptr));
    const dds_entity_t reader =
        dds_create_reader(subscriber.handle(), participant_->topic(Topic::pose_frame), nullptr, nullptr);
    ASSERT_GT(reader, 0);
    camdir_delete_entity(reader);
    EXPECT_LT(dds_get_mask(reader, nullptr), 0);
    camdir_delete_entity(reader);  // changes nothing
    EXPECT_EQ(dds_get_children(subscriber.handle(), nullptr, 0), 0);
}

}  // namespace
}  // namespace camdir::dds
