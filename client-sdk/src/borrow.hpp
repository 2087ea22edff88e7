// Sequences of wire types over arrays that they do not own.
#pragma once

#include <cstddef>
#include <cstdint>

namespace camdir::sdk {

// Lets a sequence use an array for one write.
template <class Sequence, class Element>
void borrow(Sequence& sequence, const Element* elements, std::size_t count) {
    sequence._buffer = const_cast<Element*>(elements);
    sequence._length = sequence._maximum = static_cast<std::uint32_t>(count);
    sequence._release = false;
}

}  // namespace camdir::sdk
