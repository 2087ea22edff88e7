// Who wrote a sample: the writer, and the DDS participant that it belongs to.
#pragma once

#include <dds/dds.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace camdir::dds {

using WriterHandle = dds_instance_handle_t;  // of a matched writer; never used again for another
using SenderId = std::array<unsigned char, sizeof(dds_guid_t)>;  // the participant's GUID

using MatchedWriter = std::unique_ptr<dds_builtintopic_endpoint_t, decltype(&dds_builtintopic_free_endpoint)>;

// Null when the writer has left.
[[nodiscard]] MatchedWriter find_writer(dds_entity_t reader, WriterHandle writer);
[[nodiscard]] SenderId sender_of(const dds_builtintopic_endpoint_t& writer);
[[nodiscard]] bool writes_in(const dds_builtintopic_endpoint_t& writer, const std::string& partition);

// The writers that are matched now, ascending.
[[nodiscard]] std::vector<WriterHandle> matched_writers(dds_entity_t reader);

// Finds the senders of one reader's samples; remembers the last one, which has most often sent the next too.
class SenderLookup {
  public:
    // Null when the writer has left. Valid until the next call.
    [[nodiscard]] const SenderId* find(dds_entity_t reader, WriterHandle writer);

  private:
    WriterHandle writer_ = DDS_HANDLE_NIL;
    SenderId sender_{};
};

}  // namespace camdir::dds
