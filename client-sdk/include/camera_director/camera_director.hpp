// C++20 over camera_director.h, header-only: owning objects instead of handles, exceptions instead of
// negative statuses, std::optional instead of CDIR_NO_DATA. The C header documents each call, its units and
// limits.
//
//     camera_director::Context context;
//     camera_director::Observer observer(context, "cup-7", "anna");
//     observer.request({.target = 3});
//     while (observer.wait(std::chrono::seconds(1)) == camera_director::Waited::arrived) {
//         observer.poll();
//         if (auto view = observer.newest_camera()) show(view->camera);
//     }
//
// Any thread may use an object; moving and destroying it must not overlap with other uses. A context may be
// destroyed before its matches and observers: their calls then throw an Error with CDIR_INVALID_HANDLE.
#pragma once

#include <camera_director/camera_director.h>

#include <chrono>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace camera_director {

// What every failed call throws. what() is the text of cdir_last_error().
class Error : public std::runtime_error {
  public:
    Error(cdir_status status, const char* text) : std::runtime_error(text), status_(status) {}
    [[nodiscard]] cdir_status status() const noexcept { return status_; }

  private:
    cdir_status status_;
};

namespace detail {

inline cdir_status check(cdir_status status) {
    if (status < 0) throw Error(status, cdir_last_error());
    return status;
}

template <std::size_t size>
void copy_text(char (&to)[size], std::string_view from, const char* field) {
    if (from.size() >= size || from.find('\0') != std::string_view::npos) {
        throw Error(CDIR_INVALID_ARGUMENT, (std::string(field) + " must have at most " +
                                            std::to_string(size - 1) + " bytes, none of them zero")
                                               .c_str());
    }
    std::memcpy(to, from.data(), from.size());
    to[from.size()] = '\0';
}

// Owns a handle and closes it.
template <class Handle, cdir_status (*close)(Handle) noexcept>
class Owner {
  public:
    Owner() = default;
    Owner(Owner&& other) noexcept : handle_(std::exchange(other.handle_, Handle{})) {}
    Owner& operator=(Owner&& other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }
    Owner(const Owner&) = delete;
    Owner& operator=(const Owner&) = delete;
    ~Owner() {
        if (handle_.id != 0) close(handle_);
    }

    [[nodiscard]] Handle get() const noexcept { return handle_; }
    [[nodiscard]] Handle* out() noexcept { return &handle_; }

  private:
    Handle handle_{};
};

}  // namespace detail

using Camera = cdir_camera;
using View = cdir_view;
using CameraFrame = cdir_camera_frame;
using ShotStatus = cdir_shot_status;
using Counters = cdir_observer_counters;

struct ContextOptions {
    std::uint32_t domain = cdir_context_options_default().domain;
    std::string network_interface = cdir_context_options_default().network_interface;
    std::string directors = cdir_context_options_default().directors;
    std::optional<std::string> cyclone_xml = {};
};

// A connection to the directors of one DDS domain.
class Context {
  public:
    explicit Context(const ContextOptions& options = {}) {
        cdir_context_options raw = cdir_context_options_default();
        raw.domain = options.domain;
        raw.network_interface = options.network_interface.c_str();
        raw.directors = options.directors.c_str();
        raw.cyclone_xml = options.cyclone_xml ? options.cyclone_xml->c_str() : nullptr;
        detail::check(cdir_context_open(&raw, owner_.out()));
    }

    [[nodiscard]] cdir_context handle() const noexcept { return owner_.get(); }

  private:
    detail::Owner<cdir_context, cdir_context_close> owner_;
};

struct Player {
    std::uint32_t id = 0;
    std::string name = {};
    std::string player_class = {};
    std::uint8_t team = 0;
};

struct MatchInfo {
    std::string match_id = {};
    std::string map_name = {};
    float metres_per_unit = cdir_match_info_default().metres_per_unit;
    float rate_hz = cdir_match_info_default().rate_hz;
    float spectator_delay_s = cdir_match_info_default().spectator_delay_s;
    std::uint64_t epoch = 0;
    std::uint64_t map_hash = 0;
    std::vector<Player> players = {};
};

// For n players: player_id and flags have n elements, eye 3n, orientation 4n, velocity 3n or none.
struct PoseFrame {
    std::int64_t frame_time = 0;
    std::int64_t source_time = 0;
    std::span<const std::uint32_t> player_id = {};
    std::span<const float> eye = {};
    std::span<const float> orientation = {};
    std::span<const float> velocity = {};
    std::span<const std::uint32_t> flags = {};
};

struct MatchEvent {
    std::uint32_t kind = CDIR_EVENT_KILL;
    std::int64_t frame_time = 0;
    std::uint32_t actor = CDIR_NO_PLAYER;
    std::uint32_t subject = CDIR_NO_PLAYER;
    float value = 0.0F;
    std::string detail = {};
};

namespace detail {

struct RawMatchInfo {
    explicit RawMatchInfo(const MatchInfo& from) : info(cdir_match_info_default()) {
        copy_text(info.match_id, from.match_id, "match_id");
        copy_text(info.map_name, from.map_name, "map_name");
        info.metres_per_unit = from.metres_per_unit;
        info.rate_hz = from.rate_hz;
        info.spectator_delay_s = from.spectator_delay_s;
        info.epoch = from.epoch;
        info.map_hash = from.map_hash;
        for (const Player& player : from.players) {
            cdir_player& raw = players.emplace_back();
            raw.id = player.id;
            raw.team = player.team;
            copy_text(raw.name, player.name, "a player's name");
            copy_text(raw.player_class, player.player_class, "a player's class");
        }
    }
    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(players.size()); }

    cdir_match_info info;
    std::vector<cdir_player> players;
};

}  // namespace detail

// A match, on the game server's side.
class Match {
  public:
    Match(const Context& context, const MatchInfo& info) {
        const detail::RawMatchInfo raw(info);
        detail::check(
            cdir_match_open(context.handle(), &raw.info, raw.players.data(), raw.count(), owner_.out()));
    }

    void update(const MatchInfo& info) {
        const detail::RawMatchInfo raw(info);
        detail::check(cdir_match_update(owner_.get(), &raw.info, raw.players.data(), raw.count()));
    }

    void restart(const MatchInfo& info) {
        const detail::RawMatchInfo raw(info);
        detail::check(cdir_match_restart(owner_.get(), &raw.info, raw.players.data(), raw.count()));
    }

    [[nodiscard]] std::uint64_t epoch() const {
        std::uint64_t epoch = 0;
        detail::check(cdir_match_epoch(owner_.get(), &epoch));
        return epoch;
    }

    void publish(const PoseFrame& frame) {
        const std::size_t n = frame.player_id.size();
        if (frame.eye.size() != 3 * n || frame.orientation.size() != 4 * n || frame.flags.size() != n ||
            (!frame.velocity.empty() && frame.velocity.size() != 3 * n)) {
            throw Error(CDIR_INVALID_ARGUMENT, "the arrays of a pose frame differ in length");
        }
        cdir_pose_frame raw = cdir_pose_frame_default();
        raw.player_count = static_cast<std::uint32_t>(n);
        raw.frame_time = frame.frame_time;
        raw.source_time = frame.source_time;
        raw.player_id = frame.player_id.data();
        raw.eye = frame.eye.data();
        raw.orientation = frame.orientation.data();
        raw.velocity = frame.velocity.empty() ? nullptr : frame.velocity.data();
        raw.flags = frame.flags.data();
        detail::check(cdir_match_publish_poses(owner_.get(), &raw));
    }

    void publish(const MatchEvent& event) {
        cdir_match_event raw = cdir_match_event_default();
        raw.kind = event.kind;
        raw.frame_time = event.frame_time;
        raw.actor = event.actor;
        raw.subject = event.subject;
        raw.value = event.value;
        detail::copy_text(raw.detail, event.detail, "an event's detail");
        detail::check(cdir_match_publish_event(owner_.get(), &raw));
    }

    [[nodiscard]] std::uint32_t director_count() const {
        std::uint32_t count = 0;
        detail::check(cdir_match_director_count(owner_.get(), &count));
        return count;
    }

  private:
    detail::Owner<cdir_match, cdir_match_close> owner_;
};

struct ShotRequest {
    std::uint32_t target = CDIR_CHOOSE_TARGET;
    std::vector<std::uint32_t> group = {};
    std::string profile = {};
    std::string overrides = {};
};

struct ObserverOptions {
    std::chrono::nanoseconds interpolation_delay{cdir_observer_options_default().interpolation_delay};
};

enum class Waited { arrived, timeout, interrupted };

// An observer of one match, on the spectator's side.
class Observer {
  public:
    Observer(const Context& context, const std::string& match_id, const std::string& observer_id,
             const ObserverOptions& options = {}) {
        cdir_observer_options raw = cdir_observer_options_default();
        raw.interpolation_delay = options.interpolation_delay.count();
        detail::check(
            cdir_observer_open(context.handle(), match_id.c_str(), observer_id.c_str(), &raw, owner_.out()));
    }

    void request(const ShotRequest& request) {
        cdir_shot_request raw = cdir_shot_request_default();
        raw.target = request.target;
        raw.group = request.group.data();
        raw.group_count = static_cast<std::uint32_t>(request.group.size());
        raw.profile = request.profile.c_str();
        raw.overrides = request.overrides.c_str();
        detail::check(cdir_observer_request(owner_.get(), &raw));
    }

    void withdraw() { detail::check(cdir_observer_withdraw(owner_.get())); }

    // A negative timeout waits without limit.
    [[nodiscard]] Waited wait(std::chrono::nanoseconds timeout) {
        const cdir_status status = detail::check(cdir_observer_wait(owner_.get(), timeout.count()));
        if (status == CDIR_OK) return Waited::arrived;
        return status == CDIR_TIMEOUT ? Waited::timeout : Waited::interrupted;
    }

    void interrupt() { detail::check(cdir_observer_interrupt(owner_.get())); }

    // Returns the number of camera frames taken.
    std::uint32_t poll() {
        std::uint32_t count = 0;
        detail::check(cdir_observer_poll(owner_.get(), &count));
        return count;
    }

    // Stores up to cameras.size() of the frame's camera_count cameras. None when no frame waits.
    [[nodiscard]] std::optional<CameraFrame> next_frame(std::span<Camera> cameras) {
        CameraFrame frame = cdir_camera_frame_default();
        const cdir_status status = detail::check(cdir_observer_next_frame(
            owner_.get(), &frame, cameras.data(), static_cast<std::uint32_t>(cameras.size())));
        return status == CDIR_NO_DATA ? std::nullopt : std::optional(frame);
    }

    [[nodiscard]] ShotStatus shot_status() const {
        ShotStatus status = cdir_shot_status_default();
        detail::check(cdir_observer_shot_status(owner_.get(), &status));
        return status;
    }

    [[nodiscard]] std::optional<View> newest_camera() const {
        View view = cdir_view_default();
        const cdir_status status = detail::check(cdir_observer_newest_camera(owner_.get(), &view));
        return status == CDIR_NO_DATA ? std::nullopt : std::optional(view);
    }

    [[nodiscard]] std::optional<View> camera_at(std::int64_t frame_time) const {
        View view = cdir_view_default();
        const cdir_status status = detail::check(cdir_observer_camera_at(owner_.get(), frame_time, &view));
        return status == CDIR_NO_DATA ? std::nullopt : std::optional(view);
    }

    [[nodiscard]] std::optional<std::int64_t> display_time() const {
        std::int64_t time = 0;
        const cdir_status status = detail::check(cdir_observer_display_time(owner_.get(), &time));
        return status == CDIR_NO_DATA ? std::nullopt : std::optional(time);
    }

    [[nodiscard]] std::optional<MatchInfo> match_info() const {
        cdir_match_info raw = cdir_match_info_default();
        std::vector<cdir_player> players(CDIR_MAX_PLAYERS);
        std::uint32_t count = 0;
        const cdir_status status = detail::check(
            cdir_observer_match_info(owner_.get(), &raw, players.data(), CDIR_MAX_PLAYERS, &count));
        if (status == CDIR_NO_DATA) return std::nullopt;
        MatchInfo info{raw.match_id,          raw.map_name, raw.metres_per_unit, raw.rate_hz,
                       raw.spectator_delay_s, raw.epoch,    raw.map_hash,        {}};
        for (const cdir_player& player : std::span(players).first(count)) {
            info.players.push_back({player.id, player.name, player.player_class, player.team});
        }
        return info;
    }

    [[nodiscard]] Counters counters() const {
        Counters counters = cdir_observer_counters_default();
        detail::check(cdir_observer_get_counters(owner_.get(), &counters));
        return counters;
    }

  private:
    detail::Owner<cdir_observer, cdir_observer_close> owner_;
};

}  // namespace camera_director
