// The C functions with handles: validate arguments, look handles up, and turn failures into a status.
#include <camera_director/camera_director.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <mutex>
#include <thread>

#include "checks.hpp"
#include "context.hpp"
#include "game_match.hpp"
#include "handle_table.hpp"
#include "memory.hpp"
#include "network.hpp"
#include "observer.hpp"
#include "pending_context.hpp"
#include "structs.hpp"

namespace camdir::sdk {

namespace {

struct Handles {
    HandleTable<PendingContext> contexts;
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

std::shared_ptr<PendingContext> find(cdir_context context) {
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

// Until the calls in progress have let go of what is closed, but for `owners` who do not: so it ends with
// whoever closes it, unless a thread was killed in a call, or sends for longer than a second.
template <class T>
void wait_for_calls(const std::shared_ptr<T>& closed, long owners = 1) {
    constexpr std::chrono::seconds longest(1);
    const auto end = std::chrono::steady_clock::now() + longest;
    while (closed.use_count() > owners && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::microseconds(100));
}

void close_children(const Context& context) {
    for (const auto& match :
         handles().matches.remove_if([&](const GameMatch& each) { return &each.context() == &context; }))
        wait_for_calls(match);
    for (const auto& observer :
         handles().observers.remove_if([&](const Observer& each) { return &each.context() == &context; })) {
        observer->end_waits();
        wait_for_calls(observer);
    }
}

void close_context(const std::shared_ptr<PendingContext>& closed) {
    if (const auto context = closed->result()) {
        close_children(*context);
        wait_for_calls(context, 2);  // its future is the other
    }
    wait_for_calls(closed);
}

// DDS threads that outlive main() would use libraries that are already unloaded.
void close_all() {
    (void)guarded([] {
        for (const auto& context : handles().contexts.remove_if([](const PendingContext&) { return true; }))
            close_context(context);
        return CDIR_OK;
    });
}

// Registered after the first participant was created, so that it runs before the clean-up of DDS's libraries.
void close_all_at_exit() {
    static std::once_flag once;
    std::call_once(once, [] { std::atexit(close_all); });
}
// Before that there may be an attempt to wait for.
void end_attempts_at_exit() {
    static std::once_flag once;
    std::call_once(once, [] { std::atexit(close_all); });
}

std::shared_ptr<PendingContext> begin_open(const cdir_context_options* options) {
    const cdir_context_options read = read_struct("options", options);
    require(read.domain <= 230, "domain must be 0 to 230");
    require(read.cyclone_xml != nullptr || read.network_interface != nullptr, "network_interface is null");
    require(read.cyclone_xml != nullptr || read.directors != nullptr, "directors is null");
    (void)network_configuration(read);  // fails when it is malformed
    if (read.security != nullptr) check_identity(read.security);
    end_attempts_at_exit();
    return make_object<PendingContext>(
        [owned = OwnedOptions(read), allocator = Allocator<Context>()]() -> std::shared_ptr<const Context> {
            const auto context = make_object_in<Context>(allocator, owned.get());
            close_all_at_exit();
            return context;
        });
}

std::vector<cdir_player> read_players(const cdir_player* players, std::uint32_t count) {
    require(count <= CDIR_MAX_PLAYERS, "player_count is greater than CDIR_MAX_PLAYERS");
    return read_array("players", players, count);
}

cdir_status store(const std::optional<View>& found, cdir_camera* camera, cdir_view* view) {
    if (!found) return CDIR_NO_DATA;
    write_struct(camera, found->camera);
    cdir_view where = default_of<cdir_view>();
    where.segment = found->segment;
    where.frame_time = found->frame_time;
    where.late = found->late;
    write_struct(view, where);
    return CDIR_OK;
}

}  // namespace

}  // namespace camdir::sdk

using namespace camdir::sdk;

cdir_status cdir_context_open(const cdir_context_options* options, cdir_context* context) noexcept {
    return guarded([&] {
        require(context != nullptr, "context is null");
        const auto pending = begin_open(options);
        (void)pending->wait(-1);
        context->id = handles().contexts.insert(pending);
        return CDIR_OK;
    });
}

cdir_status cdir_context_open_async(const cdir_context_options* options, cdir_context* context) noexcept {
    return guarded([&] {
        require(context != nullptr, "context is null");
        context->id = handles().contexts.insert(begin_open(options));
        return CDIR_OK;
    });
}

cdir_status cdir_context_wait(cdir_context context, int64_t timeout) noexcept {
    return guarded([&] { return find(context)->wait(timeout); });
}

cdir_status cdir_context_close(cdir_context context) noexcept {
    return guarded([&] {
        const auto closed = require_open(handles().contexts.remove(context.id), "the context");
        close_context(closed);
        return CDIR_OK;
    });
}

cdir_status cdir_match_open(cdir_context context, const cdir_match_info* info, const cdir_player* players,
                            uint32_t player_count, cdir_match* match) noexcept {
    return guarded([&] {
        const cdir_match_info read = read_struct("info", info);
        require(match != nullptr, "match is null");
        const std::uint64_t id = handles().matches.insert(
            make_object<GameMatch>(find(context)->get(), read, read_players(players, player_count)));
        require_still_open(context, [&] { (void)handles().matches.remove(id); });
        match->id = id;
        return CDIR_OK;
    });
}

cdir_status cdir_match_update(cdir_match match, const cdir_match_info* info, const cdir_player* players,
                              uint32_t player_count) noexcept {
    return guarded([&] {
        const cdir_match_info read = read_struct("info", info);
        find(match)->update(read, read_players(players, player_count));
        return CDIR_OK;
    });
}

cdir_status cdir_match_restart(cdir_match match, const cdir_match_info* info, const cdir_player* players,
                               uint32_t player_count) noexcept {
    return guarded([&] {
        const cdir_match_info read = read_struct("info", info);
        find(match)->restart(read, read_players(players, player_count));
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

cdir_status cdir_match_publish_poses(cdir_match match, const cdir_pose_frame* frame) noexcept {
    return guarded([&] {
        find(match)->publish(read_struct("frame", frame));
        return CDIR_OK;
    });
}

cdir_status cdir_match_publish_event(cdir_match match, const cdir_match_event* event) noexcept {
    return guarded([&] {
        find(match)->publish(read_struct("event", event));
        return CDIR_OK;
    });
}

cdir_status cdir_match_set_movers(cdir_match match, const cdir_mover* movers, uint32_t mover_count) noexcept {
    return guarded([&] {
        require(mover_count <= CDIR_MAX_MOVERS, "mover_count is greater than CDIR_MAX_MOVERS");
        find(match)->set_movers(read_array("movers", movers, mover_count));
        return CDIR_OK;
    });
}

cdir_status cdir_match_publish_movers(cdir_match match, const cdir_mover_frame* frame) noexcept {
    return guarded([&] {
        find(match)->publish(read_struct("frame", frame));
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
        wait_for_calls(require_open(handles().matches.remove(match.id), "the match"));
        return CDIR_OK;
    });
}

cdir_status cdir_observer_open(cdir_context context, const char* match_id, const char* observer_id,
                               const cdir_observer_options* options, cdir_observer* observer) noexcept {
    return guarded([&] {
        const cdir_observer_options chosen =
            options == nullptr ? default_of<cdir_observer_options>() : read_struct("options", options);
        require(chosen.interpolation_delay >= 0 && chosen.interpolation_delay <= 10'000'000'000,
                "interpolation_delay must be 0 to 10 s");
        require(chosen.reserved == 0, "options.reserved is not 0");
        require(observer != nullptr, "observer is null");
        const std::uint64_t id = handles().observers.insert(make_object<Observer>(
            find(context)->get(), checked_match_id(match_id), checked_observer_id(observer_id), chosen));
        require_still_open(context, [&] { (void)handles().observers.remove(id); });
        observer->id = id;
        return CDIR_OK;
    });
}

cdir_status cdir_observer_request(cdir_observer observer, const cdir_shot_request* request) noexcept {
    return guarded([&] {
        find(observer)->request(read_struct("request", request));
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
        const StructArray<cdir_camera> array("cameras", cameras, capacity);
        cdir_camera_frame taken = default_of<cdir_camera_frame>();
        if (!find(observer)->next_frame(taken, array)) return CDIR_NO_DATA;
        write_struct(frame, taken);
        return taken.camera_count > capacity ? CDIR_TRUNCATED : CDIR_OK;
    });
}

cdir_status cdir_observer_shot_status(cdir_observer observer, cdir_shot_status* status) noexcept {
    return guarded([&] {
        check_struct("status", status);
        write_struct(status, find(observer)->with_match(
                                 [](const ReceivedMatch& match) { return match.shot_status(); }));
        return CDIR_OK;
    });
}

cdir_status cdir_observer_newest_camera(cdir_observer observer, cdir_camera* camera,
                                        cdir_view* view) noexcept {
    return guarded([&] {
        check_struct("camera", camera);
        check_struct("view", view);
        return store(find(observer)->with_match([](ReceivedMatch& match) { return match.track().newest(); }),
                     camera, view);
    });
}

cdir_status cdir_observer_camera_at(cdir_observer observer, int64_t frame_time, cdir_camera* camera,
                                    cdir_view* view) noexcept {
    return guarded([&] {
        check_struct("camera", camera);
        check_struct("view", view);
        check_frame_time(frame_time);
        return store(
            find(observer)->with_match([=](ReceivedMatch& match) { return match.track().at(frame_time); }),
            camera, view);
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
        const StructArray<cdir_player> array("players", players, capacity);
        return find(observer)->with_match([&](const ReceivedMatch& match) {
            if (!match.info()) return CDIR_NO_DATA;
            const auto& known = match.info()->players;
            const auto count = static_cast<std::uint32_t>(known.size());
            write_struct(info, match.info()->match);
            for (std::uint32_t i = 0; i < std::min(capacity, count); ++i)
                array.write(i, known[i]);
            if (player_count != nullptr) *player_count = count;
            return count > capacity ? CDIR_TRUNCATED : CDIR_OK;
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
        write_struct(counters, counted);
        return CDIR_OK;
    });
}

cdir_status cdir_observer_close(cdir_observer observer) noexcept {
    return guarded([&] {
        const auto closed = require_open(handles().observers.remove(observer.id), "the observer");
        closed->end_waits();
        wait_for_calls(closed);
        return CDIR_OK;
    });
}
