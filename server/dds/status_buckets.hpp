// The answers to a match's observers, in the buckets in which they are written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "director/messages.hpp"

namespace camdir::dds {

// Cyclone DDS keeps every instance that was ever written: not one for each observer, but 256 for all that
// will ever ask. One thread at a time.
class StatusBuckets {
  public:
    using Number = std::uint8_t;
    using Bucket = std::map<std::string, director::ObserverStatus>;  // by observer id

    static constexpr std::size_t max_statuses = 1024;  // of a bucket

    [[nodiscard]] static Number number_of(std::string_view observer_id);

    // Returns false where there is no room for it.
    [[nodiscard]] bool put(const director::ObserverStatus& status);
    // Returns false where there was none.
    [[nodiscard]] bool erase(const std::string& observer_id);
    [[nodiscard]] const Bucket& bucket(Number number) { return buckets_[number]; }
    // All that have been used, by number. Some may be empty now.
    [[nodiscard]] const std::map<Number, Bucket>& used() const { return buckets_; }

  private:
    std::map<Number, Bucket> buckets_;
};

}  // namespace camdir::dds
