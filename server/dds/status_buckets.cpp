#include "dds/status_buckets.hpp"

#include <xxhash.h>

namespace camdir::dds {

StatusBuckets::Number StatusBuckets::number_of(std::string_view observer_id) {
    return static_cast<Number>(XXH3_64bits(observer_id.data(), observer_id.size()));
}

bool StatusBuckets::put(const director::ObserverStatus& status) {
    Bucket& bucket = buckets_[number_of(status.observer_id)];
    if (bucket.size() >= max_statuses && !bucket.contains(status.observer_id)) return false;
    bucket[status.observer_id] = status;
    return true;
}

bool StatusBuckets::erase(const std::string& observer_id) {
    const auto bucket = buckets_.find(number_of(observer_id));
    return bucket != buckets_.end() && bucket->second.erase(observer_id) > 0;
}

}  // namespace camdir::dds
