#include "recording/resource.hpp"

#include <zlib.h>

#include <algorithm>
#include <cassert>

#include "recording/bytes.hpp"

namespace camdir::recording {
namespace {

constexpr std::uint32_t magic = 0x43524443;  // "CDRC"
constexpr std::size_t header_size = 32;      // the CRC-32 is its last field
constexpr std::size_t max_expansion = 1032;

const Bytef* data_of(std::span<const std::byte> bytes) {
    return reinterpret_cast<const Bytef*>(bytes.data());
}

std::uint32_t checksum(std::span<const std::byte> bytes) {
    const uLong header = crc32_z(0, data_of(bytes), header_size - 4);
    const auto stored = bytes.subspan(header_size);
    return static_cast<std::uint32_t>(crc32_z(header, data_of(stored), stored.size()));
}

Bytes deflated(const Bytes& content) {
    uLongf size = compressBound(content.size());
    Bytes stored(size);
    const int status = compress2(reinterpret_cast<Bytef*>(stored.data()), &size, data_of(content),
                                 content.size(), Z_DEFAULT_COMPRESSION);
    assert(status == Z_OK);
    (void)status;
    stored.resize(size);
    return stored;
}

bool inflate_into(Bytes& content, std::span<const std::byte> stored) {
    Bytef none = 0;
    uLongf size = content.size();
    uLong used = stored.size();
    Bytef* to = content.empty() ? &none : reinterpret_cast<Bytef*>(content.data());
    return uncompress2(to, &size, data_of(stored), &used) == Z_OK && size == content.size() &&
           used == stored.size();
}

}  // namespace

Bytes encode(const Resource& resource) {
    assert(resource.content.size() <= max_content);
    const Bytes stored = deflated(resource.content);
    ByteSink sink;
    sink.fixed(magic, 4);
    sink.fixed(major_version, 1);
    sink.fixed(minor_version, 1);
    sink.fixed(static_cast<std::uint64_t>(resource.kind), 1);
    sink.fixed(0, 1);
    sink.fixed(resource.fragment, 4);
    sink.fixed(static_cast<std::uint64_t>(resource.begin_time), 8);
    sink.fixed(resource.content.size(), 4);
    sink.fixed(stored.size(), 4);
    sink.fixed(0, 4);
    sink.append(stored);
    const std::uint32_t sum = checksum(sink.bytes);
    for (std::size_t i = 0; i < 4; ++i)
        sink.bytes[header_size - 4 + i] = static_cast<std::byte>(sum >> (8 * i));
    return std::move(sink.bytes);
}

bool has_header(std::span<const std::byte> bytes, ResourceKind kind, std::uint32_t fragment) {
    if (bytes.size() < header_size) return false;
    ByteSource source(bytes);
    const bool is_resource = source.fixed(4) == magic && source.fixed(1) == major_version;
    source.fixed(1);
    const bool is_kind = source.fixed(1) == static_cast<std::uint64_t>(kind);
    source.fixed(1);
    const bool is_fragment = source.fixed(4) == fragment;
    source.fixed(8);
    source.fixed(4);
    return is_resource && is_kind && is_fragment && source.fixed(4) == bytes.size() - header_size;
}

Result<Resource> decode_resource(std::span<const std::byte> bytes, const std::string& name) {
    const auto wrong = [&](std::size_t at, const std::string& what) {
        return fail(name + ": byte " + std::to_string(at) + ": " + what);
    };
    if (bytes.size() < header_size)
        return wrong(bytes.size(), "ends, expected a header of " + std::to_string(header_size) + " bytes");
    ByteSource source(bytes);
    if (source.fixed(4) != magic) return wrong(0, "expected the magic CDRC of a recording");
    const std::uint64_t version = source.fixed(1);
    if (version != major_version)
        return wrong(4, "format version " + std::to_string(version) + ", expected " +
                            std::to_string(major_version) + ": read it with the release that wrote it");
    source.fixed(1);
    const std::uint64_t kind = source.fixed(1);
    if (kind < 1 || kind > 3) return wrong(6, "kind " + std::to_string(kind) + ", expected 1 to 3");
    source.fixed(1);
    Resource resource;
    resource.kind = static_cast<ResourceKind>(kind);
    resource.fragment = static_cast<std::uint32_t>(source.fixed(4));
    resource.begin_time = static_cast<std::int64_t>(source.fixed(8));
    const std::uint64_t inflated = source.fixed(4);
    const std::uint64_t stored = source.fixed(4);
    if (stored != bytes.size() - header_size)
        return wrong(24, std::to_string(bytes.size() - header_size) + " bytes follow the header, expected " +
                             std::to_string(stored));
    if (inflated > max_content || inflated > stored * max_expansion)
        return wrong(20, "content of " + std::to_string(inflated) + " bytes, expected at most " +
                             std::to_string(std::min<std::uint64_t>(max_content, stored * max_expansion)));
    if (source.fixed(4) != checksum(bytes)) return wrong(28, "the CRC-32 differs: the file is damaged");
    resource.content.resize(inflated);
    if (!inflate_into(resource.content, bytes.subspan(header_size)))
        return wrong(header_size, "expected " + std::to_string(inflated) + " deflated bytes (zlib)");
    return resource;
}

}  // namespace camdir::recording
