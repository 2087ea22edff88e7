#include "dds/qos.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <utility>

namespace camdir::dds {
namespace {

using std::chrono::milliseconds;

std::pair<dds_liveliness_kind_t, dds_duration_t> liveliness_of(const Qos& qos) {
    std::pair<dds_liveliness_kind_t, dds_duration_t> liveliness{};
    EXPECT_TRUE(dds_qget_liveliness(qos.get(), &liveliness.first, &liveliness.second));
    return liveliness;
}

TEST(DirectorsQos, WritersEndWithTheLeaseAndAnswersNotWithinASecond) {
    for (const auto& [lease, of_answers] :
         {std::pair(milliseconds(200), DDS_SECS(1)), std::pair(milliseconds(5000), DDS_SECS(5))}) {
        const Qos cameras = writer_qos(Topic::camera_frame, lease);
        EXPECT_EQ(liveliness_of(cameras),
                  std::pair(DDS_LIVELINESS_MANUAL_BY_TOPIC, DDS_MSECS(lease.count())));
        for (const Topic topic : {Topic::observer_status, Topic::shown_match})
            EXPECT_EQ(liveliness_of(writer_qos(topic, lease)),
                      std::pair(DDS_LIVELINESS_MANUAL_BY_TOPIC, dds_duration_t{of_answers}));
    }
}

TEST(DirectorsQos, NoReaderRefusesASample) {
    for (std::size_t topic = 0; topic < topic_count; ++topic) {
        const Qos qos = reader_qos(static_cast<Topic>(topic));
        dds_history_kind_t kind = DDS_HISTORY_KEEP_ALL;
        EXPECT_TRUE(dds_qget_history(qos.get(), &kind, nullptr));
        EXPECT_EQ(kind, DDS_HISTORY_KEEP_LAST) << topic_name(static_cast<Topic>(topic));
        std::int32_t samples = 0, instances = 0, of_instance = 0;
        if (!dds_qget_resource_limits(qos.get(), &samples, &instances, &of_instance)) continue;
        for (const std::int32_t limit : {samples, instances, of_instance})
            EXPECT_EQ(limit, DDS_LENGTH_UNLIMITED) << topic_name(static_cast<Topic>(topic));
    }
}

TEST(DirectorsQos, ReadersAcceptAnyLease) {
    for (std::size_t topic = 0; topic < topic_count; ++topic)
        EXPECT_EQ(liveliness_of(reader_qos(static_cast<Topic>(topic))).second, DDS_INFINITY);
}

}  // namespace
}  // namespace camdir::dds
