// The cameras that the directors publish for a match, recorded by an observer of the SDK.
#pragma once

#include <camera_director/camera_director.hpp>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace camdir::test {

class CameraTape {
  public:
    struct Entry {
        std::uint64_t epoch;
        int level_time;         // ms, of the poses
        std::int64_t received;  // CLOCK_MONOTONIC, ns
        camera_director::Camera camera;
    };

    CameraTape(std::uint32_t domain, const std::string& match);

    // All so far, oldest first.
    [[nodiscard]] std::vector<Entry> entries() const;
    // Camera frames that the observer missed.
    [[nodiscard]] std::uint64_t gaps() const { return observer_.counters().value().gaps; }

  private:
    void run(const std::stop_token& stop);

    camera_director::Context context_;
    camera_director::Observer observer_;
    mutable std::mutex mutex_;
    std::vector<Entry> entries_;
    std::jthread thread_;
};

}  // namespace camdir::test
