#include "dds/admission_rate.hpp"

#include <gtest/gtest.h>

#include "support/kept_memory.hpp"

namespace camdir::dds {
namespace {

using namespace std::chrono_literals;

class AdmissionRateTest : public testing::Test {
  protected:
    // How many of a thousand matches that are tried at this time begin.
    int begun(const SenderId& sender, AdmissionRate::Time now) {
        int count = 0;
        for (; count < 1000 && rate_.allows(sender, now); ++count)
            rate_.take(sender, now);
        return count;
    }

    AdmissionRate rate_{16, 4.0};
    const AdmissionRate::Time start_{1h};
    const SenderId host_{1}, other_{2};
};

TEST_F(AdmissionRateTest, ABurstThenARateForEachParticipant) {
    EXPECT_EQ(begun(host_, start_), 16);
    EXPECT_EQ(begun(host_, start_ + 249ms), 0);
    EXPECT_EQ(begun(host_, start_ + 250ms), 1);
    EXPECT_EQ(begun(host_, start_ + 1s), 3);
    EXPECT_EQ(begun(other_, start_ + 1s), 16);
    EXPECT_EQ(begun(host_, start_ + 1h), 16) << "no more than the burst";
}

TEST_F(AdmissionRateTest, ToBeForgottenGivesNobodyMore) {
    EXPECT_EQ(begun(host_, start_), 16);
    rate_.take(other_, start_);
    rate_.forget_idle(start_ + 1s);
    EXPECT_EQ(begun(host_, start_ + 1s), 4) << "its bucket was not full";
    EXPECT_EQ(begun(other_, start_ + 1s), 16);
}

TEST_F(AdmissionRateTest, KeepsNothingOfThoseWhoseBucketsAreFull) {
    AdmissionRate::Time now = start_;
    unsigned passing = 0;
    const auto come_and_go = [&] {
        ++passing;
        rate_.take({static_cast<unsigned char>(passing), static_cast<unsigned char>(passing >> 8U)}, now);
        now += 1s;
        rate_.forget_idle(now);
    };
    EXPECT_LT(test::bytes_kept(1000, come_and_go), 8.0) << "bytes of each";
}

}  // namespace
}  // namespace camdir::dds
