// Compressed recordings as text.
#pragma once

#include <zlib.h>

#include <filesystem>
#include <string>

namespace camdir::test {

[[nodiscard]] inline std::string unpacked(const std::filesystem::path& path) {
    std::string text;
    char part[4096];
    gzFile file = gzopen(path.c_str(), "rb");
    for (int length = gzread(file, part, sizeof part); length > 0; length = gzread(file, part, sizeof part))
        text.append(part, static_cast<std::size_t>(length));
    gzclose(file);
    return text;
}

}  // namespace camdir::test
