#include "dds/ready_list.hpp"

#include <algorithm>
#include <memory>

#include "dds/entity.hpp"

namespace camdir::dds {
namespace {

struct ListenerDeleter {
    void operator()(dds_listener_t* listener) const { dds_delete_listener(listener); }
};
using Listener = std::unique_ptr<dds_listener_t, ListenerDeleter>;

}  // namespace

Result<void> ReadyList::watch(dds_entity_t reader, Source& samples, Source* writers) {
    const auto on_samples = [](dds_entity_t /*reader*/, void* source) {
        Source& ready = *static_cast<Source*>(source);
        ready.list_.load()->report(ready);
    };
    const auto on_writers = [](dds_entity_t /*reader*/, dds_subscription_matched_status_t /*status*/,
                               void* source) {
        Source& ready = *static_cast<Source*>(source);
        ready.list_.load()->report(ready);
    };
    const Listener listener(dds_create_listener(nullptr));
    add(samples);
    dds_lset_data_available_arg(listener.get(), on_samples, &samples, true);
    if (writers != nullptr) {
        add(*writers);
        dds_lset_subscription_matched_arg(listener.get(), on_writers, writers, true);
    }
    const dds_return_t set = dds_set_listener(reader, listener.get());
    if (set < 0) return dds_failure("setting a reader's listener", set);
    report(samples);  // what came before
    return {};
}

void ReadyList::unwatch(dds_entity_t reader, Source& samples, Source* writers) {
    dds_set_listener(reader, nullptr);  // waits for calls that go on
    remove(samples);
    if (writers != nullptr) remove(*writers);
}

void ReadyList::add(Source& source) {
    const std::lock_guard lock(mutex_);
    source.list_ = this;
    ready_.reserve(++sources_);
}

void ReadyList::remove(Source& source) {
    const std::lock_guard lock(mutex_);
    if (source.list_ == nullptr) return;
    source.list_ = nullptr;
    source.is_ready_ = false;
    --sources_;
    std::erase(ready_, &source);
}

void ReadyList::report(Source& source) {
    const std::lock_guard lock(mutex_);
    if (source.is_ready_) return;
    source.is_ready_ = true;
    ready_.push_back(&source);
    reported_.notify_one();
}

void ReadyList::wake() {
    const std::lock_guard lock(mutex_);
    is_woken_ = true;
    reported_.notify_one();
}

const std::vector<ReadyList::Source*>& ReadyList::wait(Clock::time_point until) {
    taken_.clear();
    std::unique_lock lock(mutex_);
    taken_.reserve(sources_);
    reported_.wait_until(lock, until, [this] { return is_woken_ || !ready_.empty(); });
    is_woken_ = false;
    std::swap(taken_, ready_);
    for (Source* source : taken_)
        source->is_ready_ = false;
    return taken_;
}

}  // namespace camdir::dds
