// What a context's handle stands for: a Context, or the attempt to open it.
#pragma once

#include <camera_director/camera_director.h>

#include <cstdint>
#include <functional>
#include <future>
#include <memory>

namespace camdir::sdk {

class Context;

// Thread-safe. Its end waits for the attempt's.
class PendingContext {
  public:
    using Join = std::function<std::shared_ptr<const Context>()>;

    // Calls `join`, which may throw a Failure, on a thread of its own.
    explicit PendingContext(Join join);

    // Waits for up to `timeout` ns, without limit when it is negative. Returns CDIR_OK when the context is
    // open, CDIR_TIMEOUT when that is undecided. Throws what `join` has thrown.
    [[nodiscard]] cdir_status wait(std::int64_t timeout) const;
    // Throws a Failure with CDIR_BUSY as long as it is undecided, or what `join` has thrown.
    [[nodiscard]] std::shared_ptr<const Context> get() const;
    // Waits without limit; null when it could not be opened.
    [[nodiscard]] std::shared_ptr<const Context> result() const;

  private:
    std::shared_future<std::shared_ptr<const Context>> context_;
};

}  // namespace camdir::sdk
