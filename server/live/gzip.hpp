// Compression for the answers of HTTP.
#pragma once

#include <span>
#include <string>

namespace camdir::live {

// A gzip file (RFC 1952) of less than 4 GiB; the same bytes give the same.
[[nodiscard]] std::string gzip(std::span<const std::byte> content);

}  // namespace camdir::live
