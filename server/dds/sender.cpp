#include "dds/sender.hpp"

#include <algorithm>

namespace camdir::dds {

MatchedWriter find_writer(dds_entity_t reader, WriterHandle writer) {
    return {dds_get_matched_publication_data(reader, writer), dds_builtintopic_free_endpoint};
}

SenderId sender_of(const dds_builtintopic_endpoint_t& writer) {
    SenderId sender{};
    std::ranges::copy(writer.participant_key.v, sender.begin());
    return sender;
}

bool writes_in(const dds_builtintopic_endpoint_t& writer, const std::string& partition) {
    std::uint32_t count = 0;
    char** names = nullptr;
    if (!dds_qget_partition(writer.qos, &count, &names)) return false;
    const bool found = std::any_of(names, names + count, [&](const char* name) { return name == partition; });
    for (std::uint32_t i = 0; i < count; ++i)
        dds_free(names[i]);
    dds_free(names);
    return found;
}

std::vector<WriterHandle> matched_writers(dds_entity_t reader) {
    std::vector<WriterHandle> writers;
    while (true) {
        const dds_return_t count = dds_get_matched_publications(reader, writers.data(), writers.size());
        const std::size_t matched = count < 0 ? 0 : static_cast<std::size_t>(count);
        const bool complete = matched <= writers.size();
        writers.resize(matched);
        if (complete) break;
    }
    std::ranges::sort(writers);
    return writers;
}

const SenderId* SenderLookup::find(dds_entity_t reader, WriterHandle writer) {
    if (writer == writer_) return &sender_;
    const MatchedWriter found = find_writer(reader, writer);
    if (!found) return nullptr;
    writer_ = writer;
    sender_ = sender_of(*found);
    return &sender_;
}

}  // namespace camdir::dds
