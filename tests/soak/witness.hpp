// The observers of the real matches, and what they see.
#pragma once

#include <atomic>
#include <camera_director/camera_director.hpp>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "latencies.hpp"
#include "timeline.hpp"

namespace camdir::soak {

// What one observer sees. Times are in s of any steady clock. One thread at a time.
class ViewRecord {
  public:
    // `own`: null when the observer has no camera in the frame. `latency`: of the frame, s.
    void add(const camera_director::CameraFrame& frame, const camera_director::Camera* own, double latency,
             double now);
    // What was seen since the last call, without latencies.
    [[nodiscard]] Seen take(double now);
    // The same time's latencies are added.
    void take_latencies(Latencies& to);

    [[nodiscard]] bool is_served() const { return last_.has_value(); }
    [[nodiscard]] std::optional<std::uint64_t> director() const;

  private:
    struct View {
        camera_director::CameraFrame frame;
        double time;
    };
    std::optional<View> last_;  // with the observer's camera
    Seen seen_;
    Latencies latencies_;
};

// Thread-safe.
class Witness {
  public:
    struct Options {
        std::uint32_t domain = 0;
        std::string directors;     // addresses
        std::string match_prefix;  // matches are PREFIX-0, PREFIX-1, ...
        std::uint32_t matches = 1, observers = 1, players = 1;
        double delay_s = 0.0;
    };

    // The observers of match m are "viewer-0", "viewer-1", ..., each of a player.
    explicit Witness(const Options& options);
    ~Witness();
    Witness(const Witness&) = delete;
    Witness& operator=(const Witness&) = delete;

    [[nodiscard]] bool all_are_served();
    // What was seen since the last call.
    [[nodiscard]] Seen take();
    // Who published the newest camera of the first match.
    [[nodiscard]] std::optional<std::uint64_t> director();

  private:
    struct Place;
    void read(Place& place, const std::stop_token& stop);

    double delay_s_;
    camera_director::Context context_;
    std::vector<std::unique_ptr<Place>> places_;
};

}  // namespace camdir::soak
