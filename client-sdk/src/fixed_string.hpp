// Copies strings into the fixed arrays of the C structs and the wire types.
#pragma once

#include <cstddef>
#include <cstring>

namespace camdir::sdk {

// Always zero-terminated; longer strings are cut.
template <std::size_t size>
void copy_string(char (&to)[size], const char* from) {
    const std::size_t length = strnlen(from, size - 1);
    std::memcpy(to, from, length);
    std::memset(to + length, 0, size - length);
}

}  // namespace camdir::sdk
