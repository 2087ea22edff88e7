// A recording for viewers: all of it, or as if its match went on now.
#pragma once

#include <filesystem>
#include <string>

#include "recording/broadcast.hpp"
#include "recording/reader.hpp"

namespace camdir::recording {

class Playback {
  public:
    // Begins `from_s` (>= 0) after the recording's begin, at `speed` (> 0) times the recording's. What is
    // before can be fetched at once.
    [[nodiscard]] static Result<Playback> open(const std::filesystem::path& folder, double from_s,
                                               double speed);

    [[nodiscard]] const director::MatchInfo& match() const { return reader_.start().match; }
    // At most: the last fragment may end earlier.
    [[nodiscard]] Result<double> length_s() const;

    // With every fragment. Nothing follows.
    [[nodiscard]] Channel whole() const;
    // With every fragment that begins up to `elapsed_s` after the playback's begin, which never descends. It
    // is live until it has the last one.
    [[nodiscard]] Result<Channel> at(double elapsed_s);

  private:
    Playback(Reader reader, Channel channel, std::int64_t begin, double speed)
        : reader_(std::move(reader)), channel_(std::move(channel)), begin_(begin), speed_(speed) {}

    Reader reader_;
    Channel channel_;
    std::int64_t begin_;  // ns, of the recording's time
    double speed_;
};

}  // namespace camdir::recording
