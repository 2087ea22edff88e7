#include "dds/endpoint_removal.hpp"

namespace camdir::dds {

EndpointRemoval::EndpointRemoval(std::size_t capacity) : capacity_(capacity) {
    for (TurnTimer& turn : turns_)
        threads_.emplace_back([this, &turn](const std::stop_token& stop) { run(stop, turn); });
}

EndpointRemoval::~EndpointRemoval() = default;

bool EndpointRemoval::has_room() const {
    const std::lock_guard lock(mutex_);
    return pending_.size() < capacity_;
}

bool EndpointRemoval::removes(const std::string& match_id) const {
    const std::lock_guard lock(mutex_);
    return pending_.contains(match_id);
}

void EndpointRemoval::add(MatchTable::Endpoints endpoints) {
    {
        const std::lock_guard lock(mutex_);
        pending_.insert(endpoints->match_id());
        waiting_.push_back(std::move(endpoints));
    }
    changed_.notify_one();
}

void EndpointRemoval::run(const std::stop_token& stop, TurnTimer& turn) {
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, stop, [&] { return !waiting_.empty(); })) {
        MatchTable::Endpoints endpoints = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        const std::string match_id = endpoints->match_id();
        turn.begin();
        endpoints.reset();
        turn.end();
        lock.lock();
        pending_.erase(pending_.find(match_id));
    }
}

}  // namespace camdir::dds
