#include "dds/ready_list.hpp"

#include <camera_director.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "config/config.hpp"
#include "dds/entity.hpp"
#include "dds/take_buffer.hpp"
#include "domain_test.hpp"
#include "support/eventually.hpp"

namespace camdir::dds {
namespace {

using Clock = ReadyList::Clock;

// A writer of MatchInfo and a reader that reports to a list.
class ReadyListTest : public DomainTest {
  protected:
    void SetUp() override {
        ASSERT_NO_FATAL_FAILURE(DomainTest::SetUp());
        const Qos qos = wire::topic_qos(Topic::match_info, DDS_MSECS(100));
        reader_ = Entity(dds_create_reader(participant_->handle(), participant_->topic(Topic::match_info),
                                           qos.get(), nullptr));
        writer_ = create_writer();
        ASSERT_GT(writer_.handle(), 0);
    }
    void TearDown() override { list_.unwatch(reader_.handle(), samples_, &writers_); }

    [[nodiscard]] Entity create_writer() const {
        const Qos qos = wire::topic_qos(Topic::match_info, DDS_MSECS(100));
        return Entity(dds_create_writer(participant_->handle(), participant_->topic(Topic::match_info),
                                        qos.get(), nullptr));
    }
    void write(std::uint64_t epoch) {
        camera_director_MatchInfo info{};
        info.match_id[0] = 'm';
        info.map_name = const_cast<char*>("map");
        info.epoch = epoch;
        ASSERT_EQ(dds_write(writer_.handle(), &info), DDS_RETCODE_OK);
    }
    // The epoch of the last sample; 0 when there was none.
    std::uint64_t take() {
        std::uint64_t epoch = 0;
        (void)buffer_.take(reader_.handle(), [&](const auto& sample, const auto& info) {
            if (info.valid_data) epoch = sample.epoch;
        });
        return epoch;
    }
    // Whether the list reports it by then.
    bool reports(const ReadyList::Source& source, Clock::duration patience = test::patience) {
        const auto until = Clock::now() + patience;
        do {
            if (std::ranges::count(list_.wait(until), &source) > 0) return true;
        } while (Clock::now() < until);
        return false;
    }

    ReadyList list_;
    ReadyList::Source samples_, writers_;
    Entity reader_, writer_;
    TakeBuffer<camera_director_MatchInfo> buffer_{topic_type(Topic::match_info), 4};
};

TEST_F(ReadyListTest, ReportsWhatCameBeforeAndWhatComesLater) {
    write(1);
    ASSERT_TRUE(list_.watch(reader_.handle(), samples_));
    EXPECT_TRUE(reports(samples_));
    EXPECT_EQ(take(), 1U);
    EXPECT_TRUE(list_.wait(Clock::now()).empty());
    for (std::uint64_t epoch = 2; epoch < 100; ++epoch) {
        write(epoch);
        ASSERT_TRUE(reports(samples_));
        ASSERT_EQ(take(), epoch);
    }
    EXPECT_TRUE(list_.wait(Clock::now()).empty()) << "each was reported once";
}

TEST_F(ReadyListTest, ReportsTheEndOfAnInstance) {
    ASSERT_TRUE(list_.watch(reader_.handle(), samples_));
    write(1);
    EXPECT_TRUE(reports(samples_));
    EXPECT_EQ(take(), 1U);
    writer_.reset();
    ASSERT_TRUE(reports(samples_));
    bool is_alive = true;
    (void)buffer_.take(reader_.handle(), [&](const auto& /*sample*/, const auto& info) {
        is_alive = info.instance_state == DDS_ALIVE_INSTANCE_STATE;
    });
    EXPECT_FALSE(is_alive);
}

TEST_F(ReadyListTest, ReportsThatWritersComeAndGo) {
    ASSERT_TRUE(list_.watch(reader_.handle(), samples_, &writers_));
    (void)list_.wait(Clock::now());
    Entity second = create_writer();
    EXPECT_TRUE(reports(writers_));
    second.reset();
    EXPECT_TRUE(reports(writers_));
}

TEST_F(ReadyListTest, AnUnwatchedReaderReportsNothing) {
    ASSERT_TRUE(list_.watch(reader_.handle(), samples_, &writers_));
    write(1);
    list_.unwatch(reader_.handle(), samples_, &writers_);
    write(2);
    EXPECT_TRUE(list_.wait(Clock::now()).empty());
    list_.unwatch(reader_.handle(), samples_, &writers_);
    ASSERT_TRUE(list_.watch(reader_.handle(), samples_)) << "again";
    EXPECT_TRUE(reports(samples_));
}

TEST_F(ReadyListTest, SourcesAreReadyOnceAndInTheirOrder) {
    ASSERT_TRUE(list_.watch(reader_.handle(), samples_, &writers_));
    (void)list_.wait(Clock::now());
    list_.report(writers_);
    list_.report(samples_);
    list_.report(writers_);
    EXPECT_EQ(list_.wait(Clock::now()), (std::vector<ReadyList::Source*>{&writers_, &samples_}));
    EXPECT_TRUE(list_.wait(Clock::now()).empty());
}

TEST_F(ReadyListTest, AWaitEndsInTimeAndWhenWoken) {
    EXPECT_TRUE(list_.wait(Clock::now() + std::chrono::milliseconds(1)).empty());
    list_.wake();
    EXPECT_TRUE(list_.wait(Clock::now() + std::chrono::hours(1)).empty()) << "woken before";
    std::thread waker([&] { list_.wake(); });
    EXPECT_TRUE(list_.wait(Clock::now() + std::chrono::hours(1)).empty());
    waker.join();
}

// Reports come from threads of DDS while the list is waited for.
TEST_F(ReadyListTest, NothingIsLostBetweenThreads) {
    ASSERT_TRUE(list_.watch(reader_.handle(), samples_, &writers_));
    constexpr int rounds = 5'000;
    std::atomic<int> done{0};
    std::thread reporter([&] {
        for (int i = 1; i <= rounds; ++i) {
            done = i;
            list_.report(i % 2 == 0 ? samples_ : writers_);
        }
    });
    int seen = 0;
    while (seen < rounds) {
        ASSERT_FALSE(list_.wait(Clock::now() + test::patience).empty());
        seen = done;
    }
    reporter.join();
}

}  // namespace
}  // namespace camdir::dds
