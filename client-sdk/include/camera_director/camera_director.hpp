// C++20 over camera_director.h, header-only: owning objects instead of handles, Result instead of negative
// statuses, std::optional instead of CDIR_NO_DATA. The C header documents each call, its units and limits.
// Compiles with and without exceptions and run-time type information.
//
//     auto context = camera_director::Context::open();
//     if (!context) return complain(context.error().what());
//     auto observer = camera_director::Observer::open(*context, "cup-7", "anna");
//     if (!observer) return complain(observer.error().what());
//     if (const auto asked = observer->request({.target = 3}); !asked) return complain(asked.error().what());
//
// A program that uses exceptions takes what it wants with value(), which throws the Error instead:
//
//     auto context = camera_director::Context::open().value();
//     auto observer = camera_director::Observer::open(context, "cup-7", "anna").value();
//     observer.request({.target = 3}).value();
//
// Any thread may use an object; moving and destroying it must not overlap with other uses. A context may be
// destroyed before its matches and observers: their calls then fail with CDIR_INVALID_HANDLE.
#pragma once

// MSVC's __cplusplus stays that of C++98 unless it is asked for another; GCC 10's C++20 has a number before
// 202002.
#if !(__cplusplus > 201703L || (defined(_MSVC_LANG) && _MSVC_LANG > 201703L))
#error "camera_director.hpp needs C++20: compile with -std=c++20 (MSVC: /std:c++20), or use camera_director.h"
#endif

#include <camera_director/camera_director.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace camera_director {

// Why a call failed. what() is the text of cdir_last_error().
class Error : public std::runtime_error {
  public:
    Error(cdir_status status, const char* text) : std::runtime_error(text), status_(status) {}
    [[nodiscard]] cdir_status status() const noexcept { return status_; }

  private:
    cdir_status status_;
};

// What a call has returned, or why it failed. As std::expected<T, Error>, which C++20 does not have.
template <class T>
class [[nodiscard]] Result {
  public:
    Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

    [[nodiscard]] explicit operator bool() const noexcept { return content_.index() == 0; }
    // Of a call that failed, and undefined otherwise.
    [[nodiscard]] const Error& error() const noexcept { return *std::get_if<1>(&content_); }
    // Of a call that did not fail, and undefined otherwise.
    [[nodiscard]] T& operator*() noexcept { return *std::get_if<0>(&content_); }
    [[nodiscard]] const T& operator*() const noexcept { return *std::get_if<0>(&content_); }
    [[nodiscard]] T* operator->() noexcept { return std::get_if<0>(&content_); }
    [[nodiscard]] const T* operator->() const noexcept { return std::get_if<0>(&content_); }

    // When the call failed, throws the Error; without exceptions, prints it and aborts.
    T& value() & {
        require_value();
        return **this;
    }
    const T& value() const& {
        require_value();
        return **this;
    }
    T value() && {
        require_value();
        return std::move(**this);
    }

  private:
    void require_value() const {
        if (*this) return;
#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
        throw error();
#else
        std::fprintf(stderr, "camera director: %s\n", error().what());
        std::abort();
#endif
    }

    std::variant<T, Error> content_;
};

// Of calls that return nothing.
struct Done {};
using Outcome = Result<Done>;

namespace detail {

inline Error last_error(cdir_status status) {
    return {status, cdir_last_error()};
}

inline Outcome outcome(cdir_status status) {
    if (status < 0) return last_error(status);
    return Done{};
}

// `made`, or none when the call had no data.
template <class T>
Result<std::optional<T>> optional_result(cdir_status status, T made) {
    if (status < 0) return last_error(status);
    if (status == CDIR_NO_DATA) return std::optional<T>();
    return std::optional<T>(std::move(made));
}

template <class T>
Result<T> result(cdir_status status, T made) {
    if (status < 0) return last_error(status);
    return made;
}

inline Error too_long(const char* field, std::size_t size) {
    const std::string text =
        std::string(field) + " must have at most " + std::to_string(size - 1) + " bytes, none of them zero";
    return {CDIR_INVALID_ARGUMENT, text.c_str()};
}

template <std::size_t size>
Outcome copy_text(char (&to)[size], std::string_view from, const char* field) {
    if (from.size() >= size || from.find('\0') != std::string_view::npos) return too_long(field, size);
    std::memcpy(to, from.data(), from.size());
    to[from.size()] = '\0';
    return Done{};
}

// Owns a handle and closes it.
template <class Handle, cdir_status (*close)(Handle) noexcept>
class Owner {
  public:
    explicit Owner(Handle handle) : handle_(handle) {}
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

  private:
    Handle handle_;
};

}  // namespace detail

using Camera = cdir_camera;
using CameraFrame = cdir_camera_frame;
using ShotStatus = cdir_shot_status;
using Counters = cdir_observer_counters;

struct ContextOptions {
    std::uint32_t domain = cdir_context_options_default().domain;
    std::string network_interface = cdir_context_options_default().network_interface;
    std::string directors = cdir_context_options_default().directors;
    std::optional<std::string> cyclone_xml = {};
    std::optional<std::string> security = {};
};

// Timeout: it is not open yet.
enum class Joined { open, timeout };

// A connection to the directors of one DDS domain.
class Context {
  public:
    [[nodiscard]] static Result<Context> open(const ContextOptions& options = {}) {
        return open_by(cdir_context_open, options);
    }
    // Returns before the context is open: see wait().
    [[nodiscard]] static Result<Context> open_async(const ContextOptions& options = {}) {
        return open_by(cdir_context_open_async, options);
    }

    // A negative timeout waits without limit.
    [[nodiscard]] Result<Joined> wait(std::chrono::nanoseconds timeout) const {
        const cdir_status status = cdir_context_wait(owner_.get(), timeout.count());
        return detail::result(status, status == CDIR_OK ? Joined::open : Joined::timeout);
    }

    [[nodiscard]] cdir_context handle() const noexcept { return owner_.get(); }

  private:
    explicit Context(cdir_context handle) : owner_(handle) {}

    template <class Open>
    static Result<Context> open_by(Open* open, const ContextOptions& options) {
        cdir_context_options raw = cdir_context_options_default();
        raw.domain = options.domain;
        raw.network_interface = options.network_interface.c_str();
        raw.directors = options.directors.c_str();
        raw.cyclone_xml = options.cyclone_xml ? options.cyclone_xml->c_str() : nullptr;
        raw.security = options.security ? options.security->c_str() : nullptr;
        cdir_context handle{};
        if (const cdir_status status = open(&raw, &handle); status < 0) return detail::last_error(status);
        return Context(handle);
    }

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

// Of its hulls' half spaces 4 numbers each, hull after hull; hull_sizes: how many half spaces each has. Of
// its balls 4 numbers each.
struct Mover {
    std::uint32_t id = 0;
    std::string model = {};
    std::string kind = {};
    std::vector<float> half_spaces = {};
    std::vector<std::uint32_t> hull_sizes = {};
    std::vector<float> balls = {};
};

// For n movers: mover_id has n elements, position 3n, orientation 4n.
struct MoverFrame {
    std::int64_t frame_time = 0;
    std::int64_t source_time = 0;
    std::span<const std::uint32_t> mover_id = {};
    std::span<const float> position = {};
    std::span<const float> orientation = {};
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
    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(players.size()); }

    cdir_match_info info = cdir_match_info_default();
    std::vector<cdir_player> players = {};
};

inline Outcome add_player(RawMatchInfo& raw, const Player& player) {
    cdir_player& added = raw.players.emplace_back(cdir_player_default());
    added.id = player.id;
    added.team = player.team;
    Outcome copied = copy_text(added.name, player.name, "a player's name");
    if (copied) copied = copy_text(added.player_class, player.player_class, "a player's class");
    return copied;
}

inline Result<RawMatchInfo> raw_info(const MatchInfo& from) {
    RawMatchInfo raw;
    raw.info.metres_per_unit = from.metres_per_unit;
    raw.info.rate_hz = from.rate_hz;
    raw.info.spectator_delay_s = from.spectator_delay_s;
    raw.info.epoch = from.epoch;
    raw.info.map_hash = from.map_hash;
    Outcome copied = copy_text(raw.info.match_id, from.match_id, "match_id");
    if (copied) copied = copy_text(raw.info.map_name, from.map_name, "map_name");
    for (std::size_t i = 0; copied && i < from.players.size(); ++i)
        copied = add_player(raw, from.players[i]);
    if (!copied) return copied.error();
    return raw;
}

// It points into `from`.
inline Result<cdir_mover> raw_mover(const Mover& from) {
    std::size_t half_spaces = 0;
    for (const std::uint32_t size : from.hull_sizes)
        half_spaces += size;
    if (from.half_spaces.size() != 4 * half_spaces || from.balls.size() % 4 != 0)
        return Error(CDIR_INVALID_ARGUMENT, "the arrays of a mover differ in length");
    cdir_mover raw = cdir_mover_default();
    raw.id = from.id;
    raw.half_spaces = from.half_spaces.data();
    raw.hull_sizes = from.hull_sizes.data();
    raw.balls = from.balls.data();
    raw.hull_count = static_cast<std::uint32_t>(from.hull_sizes.size());
    raw.ball_count = static_cast<std::uint32_t>(from.balls.size() / 4);
    Outcome copied = copy_text(raw.model, from.model, "a mover's model");
    if (copied) copied = copy_text(raw.kind, from.kind, "a mover's kind");
    if (!copied) return copied.error();
    return raw;
}

}  // namespace detail

// A match, on the game server's side.
class Match {
  public:
    [[nodiscard]] static Result<Match> open(const Context& context, const MatchInfo& info) {
        const auto raw = detail::raw_info(info);
        if (!raw) return raw.error();
        cdir_match handle{};
        const cdir_status status =
            cdir_match_open(context.handle(), &raw->info, raw->players.data(), raw->count(), &handle);
        if (status < 0) return detail::last_error(status);
        return Match(handle);
    }

    Outcome update(const MatchInfo& info) {
        const auto raw = detail::raw_info(info);
        if (!raw) return raw.error();
        return detail::outcome(
            cdir_match_update(owner_.get(), &raw->info, raw->players.data(), raw->count()));
    }

    Outcome restart(const MatchInfo& info) {
        const auto raw = detail::raw_info(info);
        if (!raw) return raw.error();
        return detail::outcome(
            cdir_match_restart(owner_.get(), &raw->info, raw->players.data(), raw->count()));
    }

    [[nodiscard]] Result<std::uint64_t> epoch() const {
        std::uint64_t epoch = 0;
        const cdir_status status = cdir_match_epoch(owner_.get(), &epoch);
        return detail::result(status, epoch);
    }

    Outcome publish(const PoseFrame& frame) {
        const std::size_t n = frame.player_id.size();
        if (frame.eye.size() != 3 * n || frame.orientation.size() != 4 * n || frame.flags.size() != n ||
            (!frame.velocity.empty() && frame.velocity.size() != 3 * n)) {
            return Error(CDIR_INVALID_ARGUMENT, "the arrays of a pose frame differ in length");
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
        return publish(raw);
    }

    // For arrays with strides.
    Outcome publish(const cdir_pose_frame& frame) {
        return detail::outcome(cdir_match_publish_poses(owner_.get(), &frame));
    }

    Outcome set_movers(std::span<const Mover> movers) {
        std::vector<cdir_mover> raw;
        for (const Mover& mover : movers) {
            const auto made = detail::raw_mover(mover);
            if (!made) return made.error();
            raw.push_back(*made);
        }
        return detail::outcome(
            cdir_match_set_movers(owner_.get(), raw.data(), static_cast<std::uint32_t>(raw.size())));
    }

    Outcome publish(const MoverFrame& frame) {
        const std::size_t n = frame.mover_id.size();
        if (frame.position.size() != 3 * n || frame.orientation.size() != 4 * n)
            return Error(CDIR_INVALID_ARGUMENT, "the arrays of a mover frame differ in length");
        cdir_mover_frame raw = cdir_mover_frame_default();
        raw.mover_count = static_cast<std::uint32_t>(n);
        raw.frame_time = frame.frame_time;
        raw.source_time = frame.source_time;
        raw.mover_id = frame.mover_id.data();
        raw.position = frame.position.data();
        raw.orientation = frame.orientation.data();
        return publish(raw);
    }

    // For arrays with strides.
    Outcome publish(const cdir_mover_frame& frame) {
        return detail::outcome(cdir_match_publish_movers(owner_.get(), &frame));
    }

    Outcome publish(const MatchEvent& event) {
        cdir_match_event raw = cdir_match_event_default();
        raw.kind = event.kind;
        raw.frame_time = event.frame_time;
        raw.actor = event.actor;
        raw.subject = event.subject;
        raw.value = event.value;
        if (auto copied = detail::copy_text(raw.detail, event.detail, "an event's detail"); !copied)
            return copied;
        return detail::outcome(cdir_match_publish_event(owner_.get(), &raw));
    }

    [[nodiscard]] Result<std::uint32_t> director_count() const {
        std::uint32_t count = 0;
        const cdir_status status = cdir_match_director_count(owner_.get(), &count);
        return detail::result(status, count);
    }

  private:
    explicit Match(cdir_match handle) : owner_(handle) {}

    detail::Owner<cdir_match, cdir_match_close> owner_;
};

struct ShotRequest {
    std::uint32_t target = CDIR_CHOOSE_TARGET;
    std::vector<std::uint32_t> group = {};
    std::string profile = {};
    std::string overrides = {};
    std::uint8_t team = cdir_shot_request_default().team;
};

struct ObserverOptions {
    std::chrono::nanoseconds interpolation_delay{cdir_observer_options_default().interpolation_delay};
};

// The shot's camera at one time; see cdir_view.
struct View {
    Camera camera = cdir_camera_default();
    std::uint32_t segment = 0;
    std::int64_t frame_time = 0;
    std::int64_t late = 0;
};

enum class Waited { arrived, timeout, interrupted };

// An observer of one match, on the spectator's side.
class Observer {
  public:
    [[nodiscard]] static Result<Observer> open(const Context& context, const std::string& match_id,
                                               const std::string& observer_id,
                                               const ObserverOptions& options = {}) {
        cdir_observer_options raw = cdir_observer_options_default();
        raw.interpolation_delay = options.interpolation_delay.count();
        cdir_observer handle{};
        const cdir_status status =
            cdir_observer_open(context.handle(), match_id.c_str(), observer_id.c_str(), &raw, &handle);
        if (status < 0) return detail::last_error(status);
        return Observer(handle);
    }

    Outcome request(const ShotRequest& request) {
        cdir_shot_request raw = cdir_shot_request_default();
        raw.target = request.target;
        raw.group = request.group.data();
        raw.group_count = static_cast<std::uint32_t>(request.group.size());
        raw.profile = request.profile.c_str();
        raw.overrides = request.overrides.c_str();
        raw.team = request.team;
        return detail::outcome(cdir_observer_request(owner_.get(), &raw));
    }

    Outcome withdraw() { return detail::outcome(cdir_observer_withdraw(owner_.get())); }

    // A negative timeout waits without limit.
    [[nodiscard]] Result<Waited> wait(std::chrono::nanoseconds timeout) {
        const cdir_status status = cdir_observer_wait(owner_.get(), timeout.count());
        return detail::result(status, status == CDIR_OK        ? Waited::arrived
                                      : status == CDIR_TIMEOUT ? Waited::timeout
                                                               : Waited::interrupted);
    }

    Outcome interrupt() { return detail::outcome(cdir_observer_interrupt(owner_.get())); }

    // Returns the number of camera frames taken.
    Result<std::uint32_t> poll() {
        std::uint32_t count = 0;
        const cdir_status status = cdir_observer_poll(owner_.get(), &count);
        return detail::result(status, count);
    }

    // Stores up to cameras.size() of the frame's camera_count cameras. None when no frame waits.
    [[nodiscard]] Result<std::optional<CameraFrame>> next_frame(std::span<Camera> cameras) {
        CameraFrame frame = cdir_camera_frame_default();
        if (!cameras.empty()) cameras.front().struct_size = sizeof(Camera);
        const cdir_status status = cdir_observer_next_frame(owner_.get(), &frame, cameras.data(),
                                                            static_cast<std::uint32_t>(cameras.size()));
        return detail::optional_result(status, frame);
    }

    [[nodiscard]] Result<ShotStatus> shot_status() const {
        ShotStatus answer = cdir_shot_status_default();
        const cdir_status status = cdir_observer_shot_status(owner_.get(), &answer);
        return detail::result(status, answer);
    }

    [[nodiscard]] Result<std::optional<View>> newest_camera() const {
        View view;
        cdir_view where = cdir_view_default();
        return view_of(cdir_observer_newest_camera(owner_.get(), &view.camera, &where), view, where);
    }

    [[nodiscard]] Result<std::optional<View>> camera_at(std::int64_t frame_time) const {
        View view;
        cdir_view where = cdir_view_default();
        return view_of(cdir_observer_camera_at(owner_.get(), frame_time, &view.camera, &where), view, where);
    }

    [[nodiscard]] Result<std::optional<std::int64_t>> display_time() const {
        std::int64_t time = 0;
        const cdir_status status = cdir_observer_display_time(owner_.get(), &time);
        return detail::optional_result(status, time);
    }

    [[nodiscard]] Result<std::optional<MatchInfo>> match_info() const {
        cdir_match_info raw = cdir_match_info_default();
        std::vector<cdir_player> players(CDIR_MAX_PLAYERS, cdir_player_default());
        std::uint32_t count = 0;
        const cdir_status status =
            cdir_observer_match_info(owner_.get(), &raw, players.data(), CDIR_MAX_PLAYERS, &count);
        MatchInfo info{raw.match_id,          raw.map_name, raw.metres_per_unit, raw.rate_hz,
                       raw.spectator_delay_s, raw.epoch,    raw.map_hash,        {}};
        for (const cdir_player& player : std::span(players).first(count)) {
            info.players.push_back({player.id, player.name, player.player_class, player.team});
        }
        return detail::optional_result(status, std::move(info));
    }

    [[nodiscard]] Result<Counters> counters() const {
        Counters counters = cdir_observer_counters_default();
        const cdir_status status = cdir_observer_get_counters(owner_.get(), &counters);
        return detail::result(status, counters);
    }

  private:
    explicit Observer(cdir_observer handle) : owner_(handle) {}

    static Result<std::optional<View>> view_of(cdir_status status, View& view, const cdir_view& where) {
        view.segment = where.segment;
        view.frame_time = where.frame_time;
        view.late = where.late;
        return detail::optional_result(status, view);
    }

    detail::Owner<cdir_observer, cdir_observer_close> owner_;
};

}  // namespace camera_director
