// Takes samples out of a reader into reused memory.
#pragma once

#include <dds/dds.h>

#include <cstddef>
#include <vector>

namespace camdir::dds {

// Sample is the C type that idlc generated for the topic. The sequences in the samples keep their memory, so
// that taking does not allocate once they have grown. One thread at a time.
template <class Sample>
class TakeBuffer {
  public:
    TakeBuffer(const dds_topic_descriptor_t& type, std::size_t capacity)
        : type_(type), samples_(capacity), infos_(capacity), pointers_(capacity) {
        for (std::size_t i = 0; i < capacity; ++i)
            pointers_[i] = &samples_[i];
    }
    TakeBuffer(const TakeBuffer&) = delete;
    TakeBuffer& operator=(const TakeBuffer&) = delete;
    ~TakeBuffer() {
        for (Sample& sample : samples_)
            dds_sample_free(&sample, &type_, DDS_FREE_CONTENTS);
    }

    // Takes at most `capacity` samples and calls visit(const Sample&, const dds_sample_info_t&) for each, in
    // order. Returns whether more may be left.
    template <class Visit>
    [[nodiscard]] bool take(dds_entity_t reader, Visit visit) {
        const dds_return_t count = dds_take(reader, pointers_.data(), infos_.data(), samples_.size(),
                                            static_cast<std::uint32_t>(samples_.size()));
        for (dds_return_t i = 0; i < count; ++i)
            visit(samples_[i], infos_[i]);
        return count == static_cast<dds_return_t>(samples_.size());
    }

  private:
    const dds_topic_descriptor_t& type_;
    std::vector<Sample> samples_;  // all zero at first, as DDS requires
    std::vector<dds_sample_info_t> infos_;
    std::vector<void*> pointers_;
};

}  // namespace camdir::dds
