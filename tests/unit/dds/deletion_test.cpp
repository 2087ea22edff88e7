// What deleted entities leave in the process.
#include "idl/deletion.h"

#include <gtest/gtest.h>

#include "dds/match_endpoints.hpp"
#include "domain_test.hpp"
#include "support/kept_memory.hpp"

namespace camdir::dds {
namespace {

class DeletionTest : public DomainTest {
  protected:
    void open_and_delete_match(int number) {
        auto match = MatchEndpoints::open(*participant_, "match " + std::to_string(number), {}, 7, counters_);
        ASSERT_TRUE(match) << match.error().message;
    }

    WireCounters counters_;
};

TEST_F(DeletionTest, MatchesThatHaveEndedLeaveNothing) {
    int opened = 0;
    const auto kept = test::bytes_kept(50, [&] { open_and_delete_match(++opened); });
    EXPECT_LT(kept, 1000.0) << "bytes of each";  // dds_delete() keeps 456 of each endpoint
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
