// Tests in a DDS domain of their own, with the participant of a director.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "config/config.hpp"
#include "dds/participant.hpp"
#include "support/test_domain.hpp"

namespace camdir::dds {

class DomainTest : public testing::Test {
  protected:
    void SetUp() override {
        config::Dds config;
        config.domain = domain_.id();
        auto participant = Participant::open(config);
        ASSERT_TRUE(participant) << participant.error().message;
        participant_.emplace(std::move(*participant));
    }

    test::TestDomain domain_;
    std::optional<Participant> participant_;
};

}  // namespace camdir::dds
