#include "pending_context.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <system_error>
#include <utility>

#include "failure.hpp"

namespace camdir::sdk {

namespace {

std::shared_future<std::shared_ptr<const Context>> begin(PendingContext::Join join) {
    try {
        return std::async(std::launch::async, std::move(join));
    } catch (const std::system_error& error) {
        throw Failure{CDIR_OUT_OF_MEMORY,
                      std::string("cannot start a thread: ") + error.what() +
                          ": the process, its user or its container has as many as it may"};
    }
}

}  // namespace

PendingContext::PendingContext(Join join) : context_(begin(std::move(join))) {}

cdir_status PendingContext::wait(std::int64_t timeout) const {
    // A longer one would overflow the clock.
    constexpr std::chrono::nanoseconds longest = std::chrono::hours(24 * 365);
    if (timeout < 0) {
        context_.wait();
    } else if (context_.wait_for(std::min(std::chrono::nanoseconds(timeout), longest)) !=
               std::future_status::ready) {
        return CDIR_TIMEOUT;
    }
    (void)context_.get();
    return CDIR_OK;
}

std::shared_ptr<const Context> PendingContext::get() const {
    if (context_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        throw Failure{CDIR_BUSY, "the context is still joining its domain: see cdir_context_wait()"};
    }
    return context_.get();
}

std::shared_ptr<const Context> PendingContext::result() const {
    try {
        return context_.get();
    } catch (...) {
        return nullptr;
    }
}

}  // namespace camdir::sdk
