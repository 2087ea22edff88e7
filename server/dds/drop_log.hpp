// Counts dropped samples by reason and logs each reason at most once a second.
#pragma once

#include <array>
#include <string>

#include "dds/counters.hpp"
#include "dds/log_limit.hpp"

namespace camdir::dds {

// Thread-safe.
class DropLog {
  public:
    explicit DropLog(Counters& counters) : counters_(counters) {}

    void drop(Topic topic, Defect defect, const std::string& match_id);

  private:
    Counters& counters_;
    std::array<std::array<LogLimit, defect_names.size()>, topic_count> limits_{};
};

}  // namespace camdir::dds
