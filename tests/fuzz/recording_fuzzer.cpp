#include <cassert>
#include <cstdint>
#include <span>

#include "recording/fragment.hpp"
#include "recording/sync.hpp"

namespace {

using namespace camdir;

void check_records(const recording::Resource& resource) {
    const auto records = recording::decode_records(resource, "input");
    if (!records) return assert(!records.error().message.empty());
    std::int64_t time = resource.begin_time;
    recording::RecordEncoder encoder(time);
    recording::State state;
    for (const recording::Record& record : *records) {
        assert(record.time >= time);
        time = record.time;
        encoder.add(record.time, record.message);
        state.apply(record.message);
    }
    recording::Resource again{resource.kind, resource.fragment, resource.begin_time, encoder.content()};
    const auto repeated = recording::decode_records(again, "again");
    recording::RecordEncoder second(resource.begin_time);
    for (const recording::Record& record : *repeated)
        second.add(record.time, record.message);
    assert(second.content() == encoder.content());
}

}  // namespace

// The first byte says what the rest is. Whatever it is: an error, or records that come back when they are
// written again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const auto bytes = std::as_bytes(std::span(data + 1, size - 1));
    switch (data[0] % 4) {
        case 0:
            (void)recording::decode_sync(bytes, "input");
            break;
        case 1:
            (void)recording::decode_start(bytes, "input");
            break;
        case 2:
            if (const auto resource = recording::decode_resource(bytes, "input")) check_records(*resource);
            break;
        default:  // past the checksum
            check_records({recording::ResourceKind::delta, 0, 0, Bytes(bytes.begin(), bytes.end())});
    }
    return 0;
}
