#include "witness.hpp"

#include <algorithm>
#include <chrono>

namespace camdir::soak {
namespace {

double seconds_of(auto time) {
    return std::chrono::duration<double>(time.time_since_epoch()).count();
}
double now() {
    return seconds_of(std::chrono::steady_clock::now());
}

void add(Seen& sum, const Seen& more) {
    sum.frames += more.frames;
    sum.lost += more.lost;
    sum.stale += more.stale;
    sum.cuts += more.cuts;
    sum.unanswered += more.unanswered;
    sum.epochs += more.epochs;
    sum.gap_s = std::max(sum.gap_s, more.gap_s);
    sum.silent_s = std::max(sum.silent_s, more.silent_s);
}

}  // namespace

void ViewRecord::add(const camera_director::CameraFrame& frame, const camera_director::Camera* own,
                     double latency, double now) {
    if (own == nullptr) {
        seen_.unanswered += last_ ? 1 : 0;
        return;
    }
    ++seen_.frames;
    latencies_.add(latency);
    if (last_ && frame.epoch == last_->frame.epoch) {
        const auto step = static_cast<std::int32_t>(frame.pose_number - last_->frame.pose_number);
        if (step <= 0) {
            ++seen_.stale;
            return;
        }
        seen_.lost += static_cast<std::uint64_t>(step - 1);
        seen_.cuts += (own->flags & CDIR_CAMERA_CUT) != 0 ? 1 : 0;
    } else if (last_) {
        ++seen_.epochs;
    }
    if (last_) seen_.gap_s = std::max(seen_.gap_s, now - last_->time);
    last_ = {frame, now};
}

Seen ViewRecord::take(double now) {
    if (last_) seen_.silent_s = now - last_->time;
    return std::exchange(seen_, {});
}

void ViewRecord::take_latencies(Latencies& to) {
    to.add(latencies_);
    latencies_ = {};
}

std::optional<std::uint64_t> ViewRecord::director() const {
    if (!last_) return std::nullopt;
    return last_->frame.director_id;
}

struct Witness::Place {
    camera_director::Observer observer;
    std::mutex mutex;  // guards the record
    ViewRecord record;
    std::jthread reading;
};

Witness::Witness(const Options& options)
    : delay_s_(options.delay_s),
      context_(camera_director::Context::open({.domain = options.domain, .directors = options.directors})
                   .value()) {
    for (std::uint32_t match = 0; match < options.matches; ++match) {
        for (std::uint32_t i = 0; i < options.observers; ++i) {
            auto observer =
                camera_director::Observer::open(context_, options.match_prefix + '-' + std::to_string(match),
                                                "viewer-" + std::to_string(i))
                    .value();
            observer.request({.target = i % options.players}).value();
            places_.push_back(std::make_unique<Place>(std::move(observer)));
        }
    }
    for (const auto& place : places_)
        place->reading = std::jthread([this, &place = *place](const auto& stop) { read(place, stop); });
}

Witness::~Witness() {
    for (const auto& place : places_)
        place->reading.request_stop();
}

bool Witness::all_are_served() {
    return std::ranges::all_of(places_, [](const auto& place) {
        const std::lock_guard lock(place->mutex);
        return place->record.is_served();
    });
}

Seen Witness::take() {
    Seen sum;
    Latencies latencies;
    for (const auto& place : places_) {
        const std::lock_guard lock(place->mutex);
        add(sum, place->record.take(now()));
        place->record.take_latencies(latencies);
    }
    sum.p50_s = latencies.percentile(0.5);
    sum.p99_s = latencies.percentile(0.99);
    return sum;
}

std::optional<std::uint64_t> Witness::director() {
    const std::lock_guard lock(places_.front()->mutex);
    return places_.front()->record.director();
}

void Witness::read(Place& place, const std::stop_token& stop) {
    std::vector<camera_director::Camera> cameras(CDIR_MAX_CAMERAS);
    while (!stop.stop_requested()) {
        if (place.observer.wait(std::chrono::milliseconds(100)).value() != camera_director::Waited::arrived)
            continue;
        const double arrived = seconds_of(std::chrono::system_clock::now());
        const std::lock_guard lock(place.mutex);
        while (const auto frame = place.observer.next_frame(cameras).value()) {
            const auto status = place.observer.shot_status().value();
            const auto end = cameras.begin() + frame->camera_count;
            const auto own = std::find_if(cameras.begin(), end, [&](const auto& camera) {
                return camera.camera_id == status.camera_id;
            });
            const bool answered = status.state == CDIR_SHOT_ACCEPTED && own != end;
            const double latency = arrived - 1e-9 * static_cast<double>(frame->source_time) - delay_s_;
            place.record.add(*frame, answered ? &*own : nullptr, latency, now());
        }
    }
}

}  // namespace camdir::soak
