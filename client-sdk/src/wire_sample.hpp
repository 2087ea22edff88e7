// Takes samples out of a reader, one at a time, into reused memory.
#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <optional>
#include <utility>

#include "entity.hpp"

namespace camdir::sdk {

// Of an instance that its writer has disposed, and of one whose writers are gone, only the key is set.
enum class Taken { nothing, data, disposed, abandoned };

// The sample's sequences keep their memory, so that taking does not allocate once they have grown.
template <class Wire>
class WireSample {
  public:
    explicit WireSample(const dds_topic_descriptor_t& type) : type_(type) {}
    WireSample(const WireSample&) = delete;
    WireSample& operator=(const WireSample&) = delete;
    ~WireSample() { dds_sample_free(&value_, &type_, DDS_FREE_CONTENTS); }

    [[nodiscard]] Taken take(const Entity& reader) {
        if (const auto end = std::exchange(pending_end_, std::nullopt)) return *end;
        void* buffer = &value_;
        dds_sample_info_t info{};
        while (true) {
            const dds_return_t count = dds_take(reader.get(), &buffer, &info, 1, 1);
            check_dds("cannot read", count);
            if (count == 0) return Taken::nothing;
            const auto end = end_of(info.instance_state);
            disposals_ = info.disposed_generation_count;
            if (info.valid_data) {
                pending_end_ = end;
                return Taken::data;
            }
            if (end) return *end;
        }
    }

    [[nodiscard]] const Wire& operator*() const { return value_; }
    [[nodiscard]] const Wire* operator->() const { return &value_; }
    // How often the instance had been disposed and written again before this sample.
    [[nodiscard]] std::uint32_t disposals() const { return disposals_; }

  private:
    static std::optional<Taken> end_of(dds_instance_state_t state) {
        if (state == DDS_IST_ALIVE) return std::nullopt;
        return state == DDS_IST_NOT_ALIVE_DISPOSED ? Taken::disposed : Taken::abandoned;
    }

    const dds_topic_descriptor_t& type_;
    Wire value_{};
    std::uint32_t disposals_ = 0;
    // When an instance has ended after its last sample, DDS reports both with that one sample.
    std::optional<Taken> pending_end_;
};

}  // namespace camdir::sdk
