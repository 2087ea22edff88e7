#include "dds/drop_log.hpp"

#include <spdlog/spdlog.h>

namespace camdir::dds {

void DropLog::drop(Topic topic, Defect defect, const std::string& match_id) {
    const auto reason = static_cast<std::size_t>(defect);
    ++counters_.of(topic).dropped[reason];
    if (const auto count = limits_[static_cast<std::size_t>(topic)][reason].due()) {
        spdlog::warn("{} of match '{}' dropped: {} ({} since the last such line)", topic_name(topic),
                     match_id, defect_names[reason], *count);
    }
}

}  // namespace camdir::dds
