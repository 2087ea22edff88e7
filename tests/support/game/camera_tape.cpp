#include "support/game/camera_tape.hpp"

#include <array>
#include <chrono>

namespace camdir::test {

CameraTape::CameraTape(std::uint32_t domain, const std::string& match)
    : context_(camera_director::Context::open({.domain = domain}).value()),
      observer_(camera_director::Observer::open(context_, match, "tape").value()),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

std::vector<CameraTape::Entry> CameraTape::entries() const {
    const std::lock_guard lock(mutex_);
    return entries_;
}

void CameraTape::run(const std::stop_token& stop) {
    std::array<camera_director::Camera, CDIR_MAX_CAMERAS> cameras;
    while (!stop.stop_requested()) {
        static_cast<void>(observer_.wait(std::chrono::milliseconds(20)).value());
        while (const auto frame = observer_.next_frame(cameras).value()) {
            const std::int64_t now = std::chrono::steady_clock::now().time_since_epoch().count();
            const std::lock_guard lock(mutex_);
            for (std::uint32_t i = 0; i < frame->camera_count; ++i) {
                entries_.push_back(
                    {frame->epoch, static_cast<int>(frame->frame_time / 1'000'000), now, cameras[i]});
            }
        }
    }
}

}  // namespace camdir::test
