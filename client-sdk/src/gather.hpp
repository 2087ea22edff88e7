// Arrays with a stride, as callers pass them in.
#pragma once

#include <camera_director/camera_director.h>

#include <cstddef>
#include <cstring>
#include <string>

#include "failure.hpp"

namespace camdir::sdk {

// Packs `count` elements of `width` numbers, which need not be aligned, into `to`. Throws a Failure with
// CDIR_INVALID_ARGUMENT when the array is null or its stride too short.
template <std::size_t width, class Number>
void gather_array(const std::string& name, const Number* from, std::size_t stride, std::size_t count,
                  Number* to) {
    constexpr std::size_t size = width * sizeof(Number);
    if (from == nullptr) throw Failure{CDIR_INVALID_ARGUMENT, name + " is null"};
    if (stride == 0) stride = size;
    if (stride < size) {
        throw Failure{CDIR_INVALID_ARGUMENT, name + "_stride is " + std::to_string(stride) +
                                                 ", neither 0 nor at least " + std::to_string(size)};
    }
    const auto* bytes = reinterpret_cast<const unsigned char*>(from);
    for (std::size_t i = 0; i < count; ++i)
        std::memcpy(to + i * width, bytes + i * stride, size);
}

}  // namespace camdir::sdk
