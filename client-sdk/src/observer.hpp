// An observer of a match: readers, request and waiting.
#pragma once

#include <camera_director.h>
#include <camera_director/camera_director.h>

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "context.hpp"
#include "memory.hpp"
#include "received_match.hpp"
#include "structs.hpp"
#include "wire_sample.hpp"

namespace camdir::sdk {

// When to write a request again that nobody answers. No clock: times are parameters, in ns.
class Reminder {
  public:
    static constexpr std::int64_t interval = 2'000'000'000;

    void asked(std::int64_t now) { since_ = now; }

    // `answered`: there is nothing to wait for now. Looks again with every call: the time in which there was
    // nothing does not count.
    [[nodiscard]] bool due(bool answered, std::int64_t now) {
        if (answered) since_ = now;
        return now - since_ >= interval;
    }

  private:
    std::int64_t since_ = 0;
};

// Thread-safe: calls are serialised, except that wait() does not delay others. All may throw a Failure.
class Observer {
  public:
    Observer(std::shared_ptr<const Context> context, const std::string& match_id,
             const std::string& observer_id, const cdir_observer_options& options);

    [[nodiscard]] const Context& context() const { return *context_; }

    void request(const cdir_shot_request& request);
    void withdraw();

    [[nodiscard]] cdir_status wait(std::int64_t timeout);
    void interrupt();
    // Ends all waits, also later ones, and returns when none is in progress.
    void end_waits();

    [[nodiscard]] std::uint32_t poll();
    // Stores as many cameras as fit. Returns false when no frame waits.
    [[nodiscard]] bool next_frame(cdir_camera_frame& frame, const StructArray<cdir_camera>& cameras);

    // Calls read(ReceivedMatch&) while no other thread takes samples.
    template <class Read>
    auto with_match(Read&& read) {
        const std::lock_guard lock(mutex_);
        return read(match_);
    }
    // See DisplayClock::at.
    [[nodiscard]] std::optional<std::int64_t> display_time();
    [[nodiscard]] std::uint32_t director_count() const;

  private:
    struct Request {
        explicit Request(const Allocator<std::uint32_t>& allocator) : group(allocator) {}

        std::uint32_t target = CDIR_NO_PLAYER;
        Vector<std::uint32_t> group;
        std::string profile, overrides;
        std::uint8_t team = 0;
    };

    [[nodiscard]] Request checked_request(const cdir_shot_request& request) const;
    [[nodiscard]] dds_return_t write_request();
    // Returns what dds_waitset_wait() does.
    [[nodiscard]] dds_return_t wait_for_news(std::int64_t timeout);
    void take_info_and_status();
    void ask_again();
    // True when a director has left or fallen silent since the last call.
    [[nodiscard]] bool lost_director() const;
    [[nodiscard]] bool take_frame();

    std::shared_ptr<const Context> context_;
    std::string match_id_;
    std::string observer_id_;
    Allocator<std::uint32_t> allocator_;  // in use when it was opened

    std::mutex mutex_;
    ReceivedMatch match_;
    Request request_{allocator_};   // the last one
    bool unanswered_loss_ = false;  // a director was lost, and the request not written again
    Reminder reminder_;
    WireSample<camera_director_ShownMatch> info_sample_{camera_director_ShownMatch_desc};
    std::uint32_t info_disposals_ = 0;  // of the last one
    WireSample<camera_director_ObserverStatusBucket> status_sample_{
        camera_director_ObserverStatusBucket_desc};
    WireSample<camera_director_CameraFrame> frame_sample_{camera_director_CameraFrame_desc};

    Entity publisher_;
    Entity request_writer_;
    Entity subscriber_;
    Entity info_reader_;
    Entity status_reader_;
    Entity frame_reader_;

    std::mutex wait_mutex_;
    std::condition_variable no_waiters_;
    int waiters_ = 0;
    bool interrupted_ = false;
    bool ending_ = false;
    Entity guard_;
    Entity info_condition_;
    Entity status_condition_;
    Entity frame_condition_;
    Entity waitset_;
};

}  // namespace camdir::sdk
