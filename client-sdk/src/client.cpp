// The C functions: validate arguments, look handles up, and turn failures into a status.
#include <camera_director/camera_director.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <mutex>

#include "checks.hpp"
#include "context.hpp"
#include "game_match.hpp"
#include "handle_table.hpp"
#include "observer.hpp"
#include "orientation.hpp"

namespace camdir::sdk {

namespace {

struct Handles {
    HandleTable<Context> contexts;
    HandleTable<GameMatch> matches;
    HandleTable<Observer> observers;
};

// Never destroyed: contexts may be closed while the process exits.
Handles& handles() {
    static auto* all = new Handles;
    return *all;
}

template <class T>
std::shared_ptr<T> require_open(std::shared_ptr<T> found, const char* what) {
    if (!found) {
        throw Failure{CDIR_INVALID_HANDLE, std::string(what) + " is closed or was never opened"};
    }
    return found;
}

std::shared_ptr<Context> find(cdir_context context) {
    return require_open(handles().contexts.find(context.id), "the context");
}
std::shared_ptr<GameMatch> find(cdir_match match) {
    return require_open(handles().matches.find(match.id), "the match");
}
std::shared_ptr<Observer> find(cdir_observer observer) {
    return require_open(handles().observers.find(observer.id), "the observer");
}

// For a new match or observer: its context may have been closed while it was opened.
template <class Remove>
void require_still_open(cdir_context context, const Remove& remove) {
    if (handles().contexts.find(context.id)) return;
    remove();
    (void)find(context);  // fails
}

void close_children(const Context& context) {
    (void)handles().matches.remove_if([&](const GameMatch& match) { return &match.context() == &context; });
    const auto observers =
        handles().observers.remove_if([&](const Observer& each) { return &each.context() == &context; });
    for (const auto& observer : observers) {
        observer->end_waits();
    }
}

// DDS threads that outlive main() would use libraries that are already unloaded.
void close_all() {
    (void)guarded([] {
        for (const auto& context : handles().contexts.remove_if([](const Context&) { return true; })) {
            close_children(*context);
        }
        return CDIR_OK;
    });
}

// Registered after the first participant was created, so that it runs before the clean-up of DDS's libraries.
void close_all_at_exit() {
    static std::once_flag once;
    std::call_once(once, [] { std::atexit(close_all); });
}

std::span<const cdir_player> player_span(const cdir_player* players, std::uint32_t count) {
    require(count <= CDIR_MAX_PLAYERS, "player_count is greater than CDIR_MAX_PLAYERS");
    require(count == 0 || players != nullptr, "players is null");
    return {players, count};
}

cdir_status store(std::optional<cdir_view> found, cdir_view* view) {
    if (!found) return CDIR_NO_DATA;
    *view = *found;
    return CDIR_OK;
}

}  // namespace

}  // namespace camdir::sdk

using namespace camdir::sdk;

uint32_t cdir_abi_version(void) noexcept {
    return CDIR_ABI_VERSION;
}

const char* cdir_status_name(cdir_status status) noexcept {
    switch (status) {
        case CDIR_OK:
            return "CDIR_OK";
        case CDIR_NO_DATA:
            return "CDIR_NO_DATA";
        case CDIR_TIMEOUT:
            return "CDIR_TIMEOUT";
        case CDIR_INTERRUPTED:
            return "CDIR_INTERRUPTED";
        case CDIR_TRUNCATED:
            return "CDIR_TRUNCATED";
        case CDIR_INVALID_ARGUMENT:
            return "CDIR_INVALID_ARGUMENT";
        case CDIR_INVALID_HANDLE:
            return "CDIR_INVALID_HANDLE";
        case CDIR_BUSY:
            return "CDIR_BUSY";
        case CDIR_CONFLICT:
            return "CDIR_CONFLICT";
        case CDIR_NETWORK:
            return "CDIR_NETWORK";
        case CDIR_OUT_OF_MEMORY:
            return "CDIR_OUT_OF_MEMORY";
        case CDIR_INTERNAL:
            return "CDIR_INTERNAL";
        default:
            return "unknown status";
    }
}

const char* cdir_last_error(void) noexcept {
    return last_error_text;
}

cdir_status cdir_context_open(const cdir_context_options* options, cdir_context* context) noexcept {
    return guarded([&] {
        check_struct("options", options);
        require(context != nullptr, "context is null");
        require(options->domain <= 230, "domain must be 0 to 230");
        require(options->cyclone_xml != nullptr || options->network_interface != nullptr,
                "network_interface is null");
        require(options->cyclone_xml != nullptr || options->directors != nullptr, "directors is null");
        context->id = handles().contexts.insert(std::make_shared<Context>(*options));
        close_all_at_exit();
        return CDIR_OK;
    });
}

cdir_status cdir_context_close(cdir_context context) noexcept {
    return guarded([&] {
        const auto closed = require_open(handles().contexts.remove(context.id), "the context");
        close_children(*closed);
        return CDIR_OK;
    });
}

cdir_status cdir_match_open(cdir_context context, const cdir_match_info* info, const cdir_player* players,
                            uint32_t player_count, cdir_match* match) noexcept {
    return guarded([&] {
        check_struct("info", info);
        require(match != nullptr, "match is null");
        const auto span = player_span(players, player_count);
        const std::uint64_t id =
            handles().matches.insert(std::make_shared<GameMatch>(find(context), *info, span));
        require_still_open(context, [&] { (void)handles().matches.remove(id); });
        match->id = id;
        return CDIR_OK;
    });
}

cdir_status cdir_match_update(cdir_match match, const cdir_match_info* info, const cdir_player* players,
                              uint32_t player_count) noexcept {
    return guarded([&] {
        check_struct("info", info);
        find(match)->update(*info, player_span(players, player_count));
        return CDIR_OK;
    });
}

cdir_status cdir_match_restart(cdir_match match, const cdir_match_info* info, const cdir_player* players,
                               uint32_t player_count) noexcept {
    return guarded([&] {
        check_struct("info", info);
        find(match)->restart(*info, player_span(players, player_count));
        return CDIR_OK;
    });
}

cdir_status cdir_match_epoch(cdir_match match, uint64_t* epoch) noexcept {
    return guarded([&] {
        require(epoch != nullptr, "epoch is null");
        *epoch = find(match)->epoch();
        return CDIR_OK;
    });
}

cdir_status cdir_orientation_from_angles(const float* angles, float* orientation) noexcept {
    return guarded([&] {
        require(angles != nullptr, "angles is null");
        require(orientation != nullptr, "orientation is null");
        require(std::all_of(angles, angles + 3, [](float angle) { return std::isfinite(angle); }),
                "an angle is not finite");
        store_orientation(angles, orientation);
        return CDIR_OK;
    });
}

cdir_status cdir_match_publish_poses(cdir_match match, const cdir_pose_frame* frame) noexcept {
    return guarded([&] {
        check_struct("frame", frame);
        find(match)->publish(*frame);
        return CDIR_OK;
    });
}

cdir_status cdir_match_publish_event(cdir_match match, const cdir_match_event* event) noexcept {
    return guarded([&] {
        check_struct("event", event);
        find(match)->publish(*event);
        return CDIR_OK;
    });
}

cdir_status cdir_match_director_count(cdir_match match, uint32_t* count) noexcept {
    return guarded([&] {
        require(count != nullptr, "count is null");
        *count = find(match)->director_count();
        return CDIR_OK;
    });
}

cdir_status cdir_match_close(cdir_match match) noexcept {
    return guarded([&] {
        (void)require_open(handles().matches.remove(match.id), "the match");
        return CDIR_OK;
    });
}

cdir_status cdir_observer_open(cdir_context context, const char* match_id, const char* observer_id,
                               const cdir_observer_options* options, cdir_observer* observer) noexcept {
    return guarded([&] {
        const cdir_observer_options defaults = cdir_observer_options_default();
        const cdir_observer_options& chosen = options == nullptr ? defaults : *options;
        check_struct("options", &chosen);
        require(chosen.interpolation_delay >= 0 && chosen.interpolation_delay <= 10'000'000'000,
                "interpolation_delay must be 0 to 10 s");
        require(chosen.reserved == 0, "options.reserved is not 0");
        require(observer != nullptr, "observer is null");
        const std::uint64_t id = handles().observers.insert(std::make_shared<Observer>(
            find(context), checked_match_id(match_id), checked_observer_id(observer_id), chosen));
        require_still_open(context, [&] { (void)handles().observers.remove(id); });
        observer->id = id;
        return CDIR_OK;
    });
}

cdir_status cdir_observer_request(cdir_observer observer, const cdir_shot_request* request) noexcept {
    return guarded([&] {
        check_struct("request", request);
        find(observer)->request(*request);
        return CDIR_OK;
    });
}

cdir_status cdir_observer_withdraw(cdir_observer observer) noexcept {
    return guarded([&] {
        find(observer)->withdraw();
        return CDIR_OK;
    });
}

cdir_status cdir_observer_wait(cdir_observer observer, int64_t timeout) noexcept {
    return guarded([&] { return find(observer)->wait(timeout); });
}

cdir_status cdir_observer_interrupt(cdir_observer observer) noexcept {
    return guarded([&] {
        find(observer)->interrupt();
        return CDIR_OK;
    });
}

cdir_status cdir_observer_poll(cdir_observer observer, uint32_t* frame_count) noexcept {
    return guarded([&] {
        const std::uint32_t count = find(observer)->poll();
        if (frame_count != nullptr) *frame_count = count;
        return CDIR_OK;
    });
}

cdir_status cdir_observer_next_frame(cdir_observer observer, cdir_camera_frame* frame, cdir_camera* cameras,
                                     uint32_t capacity) noexcept {
    return guarded([&] {
        check_struct("frame", frame);
        require(capacity == 0 || cameras != nullptr, "cameras is null");
        if (!find(observer)->next_frame(*frame, {cameras, capacity})) return CDIR_NO_DATA;
        return frame->camera_count > capacity ? CDIR_TRUNCATED : CDIR_OK;
    });
}

cdir_status cdir_observer_shot_status(cdir_observer observer, cdir_shot_status* status) noexcept {
    return guarded([&] {
        check_struct("status", status);
        *status = find(observer)->with_match([](const ReceivedMatch& match) { return match.shot_status(); });
        return CDIR_OK;
    });
}

const char* cdir_shot_state_name(uint32_t state) noexcept {
    switch (state) {
        case CDIR_SHOT_REFUSED:
            return "refused";
        case CDIR_SHOT_ACCEPTED:
            return "accepted";
        case CDIR_SHOT_WAITING_FOR_MAP:
            return "waiting for the map";
        case CDIR_SHOT_WAITING_FOR_PLAYER:
            return "waiting for a player";
        case CDIR_SHOT_NOT_REQUESTED:
            return "not requested";
        case CDIR_SHOT_UNANSWERED:
            return "unanswered";
        default:
            return "unknown state";
    }
}

cdir_status cdir_observer_newest_camera(cdir_observer observer, cdir_view* view) noexcept {
    return guarded([&] {
        check_struct("view", view);
        return store(find(observer)->with_match([](ReceivedMatch& match) { return match.track().newest(); }),
                     view);
    });
}

cdir_status cdir_observer_camera_at(cdir_observer observer, int64_t frame_time, cdir_view* view) noexcept {
    return guarded([&] {
        check_struct("view", view);
        check_frame_time(frame_time);
        return store(
            find(observer)->with_match([=](ReceivedMatch& match) { return match.track().at(frame_time); }),
            view);
    });
}

cdir_status cdir_observer_display_time(cdir_observer observer, int64_t* frame_time) noexcept {
    return guarded([&] {
        require(frame_time != nullptr, "frame_time is null");
        const auto time = find(observer)->display_time();
        if (!time) return CDIR_NO_DATA;
        *frame_time = *time;
        return CDIR_OK;
    });
}

cdir_status cdir_observer_match_info(cdir_observer observer, cdir_match_info* info, cdir_player* players,
                                     uint32_t capacity, uint32_t* player_count) noexcept {
    return guarded([&] {
        check_struct("info", info);
        require(capacity == 0 || players != nullptr, "players is null");
        return find(observer)->with_match([&](const ReceivedMatch& match) {
            if (!match.info()) return CDIR_NO_DATA;
            const auto& known = match.info()->players;
            *info = match.info()->match;
            std::copy_n(known.begin(), std::min<std::size_t>(capacity, known.size()), players);
            if (player_count != nullptr) *player_count = static_cast<std::uint32_t>(known.size());
            return known.size() > capacity ? CDIR_TRUNCATED : CDIR_OK;
        });
    });
}

cdir_status cdir_observer_get_counters(cdir_observer observer, cdir_observer_counters* counters) noexcept {
    return guarded([&] {
        check_struct("counters", counters);
        const auto found = find(observer);
        cdir_observer_counters counted =
            found->with_match([](const ReceivedMatch& match) { return match.counters(); });
        counted.directors = found->director_count();
        *counters = counted;
        return CDIR_OK;
    });
}

cdir_status cdir_observer_close(cdir_observer observer) noexcept {
    return guarded([&] {
        require_open(handles().observers.remove(observer.id), "the observer")->end_waits();
        return CDIR_OK;
    });
}
