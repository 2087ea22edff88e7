// The bytes of a map: a file, or a member of a zip archive (pk3).
#pragma once

#include <cstddef>
#include <string>

#include "base/error.hpp"
#include "base/file.hpp"

namespace camdir::scene {

// A member larger than this when unpacked is refused, so that a small archive cannot fill the memory.
inline constexpr std::size_t max_member_bytes = std::size_t{256} << 20;

struct Source {
    std::string map_name;   // file name without folder and extension
    std::string extension;  // .bsp, in lower case
    Bytes bytes;
};

// `source` is a file, or `archive.pk3:member`. A file whose name has a colon takes precedence over a member.
// Errors name the file, the member and the reason.
[[nodiscard]] Result<Source> read_source(const std::string& source);

// The source at a path relative to this one: in the same folder, or in the same archive.
[[nodiscard]] std::string beside(const std::string& source, const std::string& relative);

}  // namespace camdir::scene
