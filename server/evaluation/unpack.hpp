// The content of a file that may be compressed with gzip.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "base/error.hpp"

namespace camdir::evaluation {

// Hands out the content of `bytes` (plain, or gzip with any number of members) piece by piece, without
// holding more than one of 64 kB. Fails on a damaged or cut off compressed stream and on content beyond 1 MiB
// plus 200 times its compressed size or beyond 1 GiB.
class Unpacker {
  public:
    // `bytes` must outlive the unpacker.
    explicit Unpacker(std::span<const std::byte> bytes);
    Unpacker(const Unpacker&) = delete;
    Unpacker& operator=(const Unpacker&) = delete;
    ~Unpacker();

    // Empty at the end. Valid until the next call; not to be called again after an error.
    [[nodiscard]] Result<std::span<const std::byte>> next();

  private:
    class Inflater;

    std::span<const std::byte> plain_;
    std::unique_ptr<Inflater> inflater_;  // of compressed bytes
};

}  // namespace camdir::evaluation
