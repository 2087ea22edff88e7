// What an observer knows of a match from the samples that it has taken. No DDS calls, no clock.
#pragma once

#include <camera_director.h>
#include <camera_director/camera_director.h>

#include <cstdint>
#include <optional>
#include <string>

#include "camera_track.hpp"
#include "display_clock.hpp"
#include "memory.hpp"

namespace camdir::sdk {

// accept() drops and counts samples that are malformed or of an earlier epoch. A newer epoch discards the
// cameras and the director's answer of the earlier one. Once a director has described the match, a
// description alone begins an epoch: an answer for a later one waits, and frames are dropped. Until then, an
// answer for an earlier one waits for its description. Within an
// epoch, frames of what has been shown are dropped and counted, too; those whose time goes back
// by more than a second discard the cameras before them. One thread at a time.
class ReceivedMatch {
  public:
    ReceivedMatch(std::string match_id, std::string observer_id, std::int64_t interpolation_delay);

    void accept(const camera_director_ShownMatch& info);
    void match_ended();
    // The description's writer is silent or dead. It holds until another epoch begins, by whatever sample.
    void info_abandoned() { described_ = false; }
    // Returns false when the observer's answer was among them before, and is no longer: it counts as
    // abandoned.
    bool accept(const camera_director_ObserverStatusBucket& answers);
    // The answers in this bucket are of a writer that is silent or dead. Returns false when the observer's
    // was among them: until the next answer, its camera stays the shot's, whoever writes the next frame.
    bool statuses_abandoned(std::uint8_t bucket);
    // `now`: see DisplayClock. Returns false when the frame was dropped.
    bool accept(const camera_director_CameraFrame& frame, std::int64_t now);

    void set_requested(bool requested);
    [[nodiscard]] bool requested() const { return requested_; }

    struct Info {
        cdir_match_info match;
        Vector<cdir_player> players;
    };
    [[nodiscard]] const std::optional<Info>& info() const { return info_; }
    [[nodiscard]] cdir_shot_status shot_status() const;
    [[nodiscard]] CameraTrack& track() { return track_; }
    [[nodiscard]] DisplayClock& clock() { return clock_; }
    [[nodiscard]] const cdir_observer_counters& counters() const { return counters_; }

  private:
    // Of descriptions and of other samples. They return false when the sample must be dropped.
    [[nodiscard]] bool enter_epoch(std::uint64_t epoch);
    [[nodiscard]] bool is_of_epoch(std::uint64_t epoch);
    void begin_epoch(std::uint64_t epoch);
    void accept(const camera_director_ObserverStatus& status);
    void take_early_status();
    [[nodiscard]] bool is_repeated(const camera_director_CameraFrame& frame) const;
    [[nodiscard]] bool is_of_past(const camera_director_CameraFrame& frame) const;
    void forget_future(const camera_director_CameraFrame& frame);
    [[nodiscard]] bool follows_last(const camera_director_CameraFrame& frame);
    [[nodiscard]] std::optional<cdir_camera> camera_of_shot(const camera_director_CameraFrame& frame) const;

    struct FrameId {
        std::uint64_t director_id;
        std::uint32_t frame_number, pose_number;
        std::int64_t frame_time;
    };

    std::string match_id_;
    std::string observer_id_;
    Allocator<cdir_player> allocator_;  // in use when it was made
    bool requested_ = false;
    bool answered_ = false;   // by a director that lives
    bool described_ = false;  // likewise
    std::uint64_t epoch_ = 0;
    std::optional<Info> info_;
    std::optional<cdir_shot_status> status_;
    std::optional<std::uint8_t> bucket_;                          // in which the observer's answer is
    std::optional<camera_director_ObserverStatus> early_status_;  // of an epoch that is to come
    std::optional<FrameId> last_frame_;                           // of this epoch
    CameraTrack track_;
    DisplayClock clock_;
    cdir_observer_counters counters_ = cdir_observer_counters_default();
};

// The i-th camera of a valid frame.
[[nodiscard]] cdir_camera camera_at(const camera_director_CameraFrame& frame, std::uint32_t index);

}  // namespace camdir::sdk
