// Takes samples out of a reader, one at a time, into reused memory.
#pragma once

#include <dds/dds.h>

#include <utility>

#include "entity.hpp"

namespace camdir::sdk {

enum class Taken { nothing, data, ended };  // ended: the instance has no writer; only its key is set

// The sample's sequences keep their memory, so that taking does not allocate once they have grown.
template <class Wire>
class WireSample {
  public:
    explicit WireSample(const dds_topic_descriptor_t& type) : type_(type) {}
    WireSample(const WireSample&) = delete;
    WireSample& operator=(const WireSample&) = delete;
    ~WireSample() { dds_sample_free(&value_, &type_, DDS_FREE_CONTENTS); }

    [[nodiscard]] Taken take(const Entity& reader) {
        if (std::exchange(end_pending_, false)) return Taken::ended;
        void* buffer = &value_;
        dds_sample_info_t info{};
        while (true) {
            const dds_return_t count = dds_take(reader.get(), &buffer, &info, 1, 1);
            check_dds("cannot read", count);
            if (count == 0) return Taken::nothing;
            const bool alive = info.instance_state == DDS_IST_ALIVE;
            if (info.valid_data) {
                end_pending_ = !alive;
                return Taken::data;
            }
            if (!alive) return Taken::ended;
        }
    }

    [[nodiscard]] const Wire& operator*() const { return value_; }
    [[nodiscard]] const Wire* operator->() const { return &value_; }

  private:
    const dds_topic_descriptor_t& type_;
    Wire value_{};
    // When an instance has ended after its last sample, DDS reports both with that one sample.
    bool end_pending_ = false;
};

}  // namespace camdir::sdk
