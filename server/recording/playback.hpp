// A recording for viewers: all of it, or as if its match went on now.
#pragma once

#include <filesystem>

#include "recording/broadcast.hpp"
#include "recording/reader.hpp"

namespace camdir::recording {

class Playback {
  public:
    [[nodiscard]] static Result<Playback> open(const std::filesystem::path& folder);

    [[nodiscard]] const director::MatchInfo& match() const { return reader_.start().match; }
    // About so long.
    [[nodiscard]] double length_s() const;

    // With every fragment, also those that cannot be read. Nothing follows.
    [[nodiscard]] Channel whole() const;

    // The match goes on `from_s` (>= 0) after the recording's begin, at `speed` (> 0) times the recording's.
    // What is before can be fetched at once. Fails where no fragment can be read.
    [[nodiscard]] Result<void> go_on(double from_s, double speed);
    // With every fragment that begins up to `elapsed_s` after that, which never descends. It is live until it
    // has the last one.
    [[nodiscard]] Channel at(double elapsed_s);

  private:
    Playback(Reader reader, Channel channel) : reader_(std::move(reader)), channel_(std::move(channel)) {}
    [[nodiscard]] Result<void> find_readable();
    [[nodiscard]] std::int64_t begin_of(std::uint32_t fragment);

    Reader reader_;
    Channel channel_;
    std::uint32_t known_ = 0;       // the last fragment whose begin was read
    std::int64_t known_begin_ = 0;  // ns, of the recording's time
    std::int64_t begin_ = 0;        // ns, of the recording's time: where it goes on
    double speed_ = 1.0;
};

}  // namespace camdir::recording
