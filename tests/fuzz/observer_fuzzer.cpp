#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>

#include "received_match.hpp"
#include "wire_input.hpp"

namespace camdir::sdk {
namespace {

constexpr std::int64_t frame_interval = 16'000'000;  // ns

bool is_usable(const cdir_camera& camera) {
    for (const float number : camera.position)
        if (!std::isfinite(number)) return false;
    for (const float number : camera.orientation)
        if (!std::isfinite(number)) return false;
    return std::isfinite(camera.vertical_fov);
}

class Viewer {
  public:
    Viewer() { match_.set_requested(true); }

    void take(const fuzz::WireRecord& record) {
        now_ += frame_interval;
        switch (record.topic % 4) {
            case 0:
                return accept<camera_director_ShownMatch>(camera_director_ShownMatch_desc, record.fields);
            case 1:
                return accept<camera_director_ObserverStatusBucket>(camera_director_ObserverStatusBucket_desc,
                                                                    record.fields);
            case 2: {
                const fuzz::ReceivedSample<camera_director_CameraFrame> frame(
                    camera_director_CameraFrame_desc, record.fields);
                if (frame && match_.accept(*frame, now_)) read_cameras(*frame);
                return;
            }
            default:
                return lose(record.topic / 4);
        }
    }

    void read() {
        const cdir_shot_status status = match_.shot_status();
        assert(std::memchr(status.reason, '\0', sizeof status.reason) != nullptr);
        if (match_.info()) {
            assert(match_.info()->players.size() <= CDIR_MAX_PLAYERS);
            assert(std::memchr(match_.info()->match.map_name, '\0', sizeof match_.info()->match.map_name) !=
                   nullptr);
        }
        const auto time = match_.clock().at(now_);
        if (!time) return;
        if (const auto view = match_.track().at(*time)) assert(is_usable(view->camera));
        if (const auto view = match_.track().newest()) assert(is_usable(view->camera));
    }

  private:
    template <class Sample>
    void accept(const dds_topic_descriptor_t& type, std::span<const std::uint8_t> fields) {
        const fuzz::ReceivedSample<Sample> sample(type, fields);
        if (sample) match_.accept(*sample);
    }

    static void read_cameras(const camera_director_CameraFrame& frame) {
        for (std::uint32_t i = 0; i < frame.camera_id._length; ++i)
            assert(is_usable(camera_at(frame, i)));
    }

    void lose(unsigned what) {
        if (what % 4 == 0) match_.match_ended();
        if (what % 4 == 1) match_.info_abandoned();
        if (what % 4 >= 2) match_.statuses_abandoned(static_cast<std::uint8_t>(what));
    }

    ReceivedMatch match_{"m", "o", 100'000'000};
    std::int64_t now_ = 0;
};

}  // namespace
}  // namespace camdir::sdk

// Whatever the bytes, as samples from directors: an observer drops them, or has cameras that a renderer can
// use.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    camdir::sdk::Viewer viewer;
    std::span<const std::uint8_t> bytes(data, size);
    while (const auto record = camdir::fuzz::next_record(bytes)) {
        viewer.take(*record);
        viewer.read();
    }
    return 0;
}
