// What waits for one viewer: a bounded queue between the director's threads and the viewer's connection.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace camdir::live {

struct Message {
    enum class Kind {
        note,   // JSON text; must arrive
        frame,  // binary; the oldest is dropped where the viewer is too slow
    };
    Kind kind = Kind::note;
    std::string content;
};
using SharedMessage = std::shared_ptr<const Message>;

struct ViewerLimits {
    std::size_t frames = 120;  // that wait: two seconds at 60 Hz
    std::size_t notes = 512;   // that wait: one more, and the viewer is lost
};

// Thread-safe.
class Viewer {
  public:
    // `wake` is called, from any thread and with a lock held, when there is something to take after there was
    // nothing, and when the viewer is lost. It must return at once and call nothing of the viewer.
    explicit Viewer(std::function<void()> wake, const ViewerLimits& limits = {});

    // Returns how many frames this has dropped: 0 or 1.
    std::size_t put(SharedMessage message);
    // Nothing follows the notes and frames that wait: the match has ended.
    void finish();

    // The next message, null when none waits. Frames that were dropped before it are told by a note of their
    // own.
    [[nodiscard]] SharedMessage take();
    // Did not take its notes: its connection is to be closed.
    [[nodiscard]] bool lost() const;
    // Everything was taken after finish().
    [[nodiscard]] bool finished() const;

    // The connection is gone: `wake` is not called any more, nothing is kept.
    void leave();
    [[nodiscard]] bool left() const;

  private:
    void drop_oldest_frame();

    mutable std::mutex mutex_;
    std::function<void()> wake_;  // empty: left
    const ViewerLimits limits_;
    std::deque<SharedMessage> waiting_;
    std::size_t frames_ = 0;   // of them
    std::size_t dropped_ = 0;  // frames that the viewer has not been told of
    bool ends_ = false;
    bool lost_ = false;
};

}  // namespace camdir::live
