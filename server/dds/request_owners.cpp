#include "dds/request_owners.hpp"

#include <algorithm>
#include <utility>

namespace camdir::dds {

RequestOwners::Standing RequestOwners::put(const director::ObserverRequest& request, WriterHandle writer,
                                           const SenderId& sender) {
    const auto known = owners_.find(request.observer_id);
    const bool is_new = known == owners_.end();
    if (!is_new && known->second.writer == writer) return Standing::owner;
    const bool waits = !is_new && known->second.waiting && known->second.waiting->sender == sender;
    const auto count = counts_.find(sender);
    if (!waits && count != counts_.end() && count->second >= max_of_sender_) return Standing::refused;
    ++counts_[sender];
    if (is_new) {
        owners_.emplace(request.observer_id, Owner{.writer = writer, .sender = sender});
        return Standing::owner;
    }
    known->second.contested = true;
    drop_waiting(known->second);
    known->second.waiting = Waiting{writer, sender, request};
    return Standing::stranger;
}

std::optional<RequestOwners::Outcome> RequestOwners::dispose(const std::string& observer_id,
                                                             WriterHandle writer, bool certain) {
    const auto known = owners_.find(observer_id);
    if (known == owners_.end()) return std::nullopt;
    Owner& owner = known->second;
    if (owner.writer == writer && (certain || !owner.contested)) return end(known);
    owner.contested = true;
    if (certain && owner.waiting && owner.waiting->writer == writer) drop_waiting(owner);
    return std::nullopt;
}

std::optional<RequestOwners::Outcome> RequestOwners::lose(const std::string& observer_id) {
    const auto known = owners_.find(observer_id);
    if (known == owners_.end()) return std::nullopt;
    drop_waiting(known->second);
    return end(known);
}

std::vector<RequestOwners::Outcome> RequestOwners::retain(std::span<const WriterHandle> matched) {
    const auto gone = [&](WriterHandle writer) { return !std::ranges::binary_search(matched, writer); };
    std::vector<Outcome> outcomes;
    for (auto next = owners_.begin(); next != owners_.end();) {
        const auto known = next++;
        Owner& owner = known->second;
        if (owner.waiting && gone(owner.waiting->writer)) drop_waiting(owner);
        if (gone(owner.writer)) outcomes.push_back(end(known));
    }
    return outcomes;
}

std::vector<std::string> RequestOwners::observers() const {
    std::vector<std::string> observers;
    for (const auto& [observer_id, owner] : owners_)
        observers.push_back(observer_id);
    return observers;
}

RequestOwners::Outcome RequestOwners::end(Owners::iterator known) {
    Owner& owner = known->second;
    Outcome outcome{known->first, std::nullopt};
    release(owner.sender);
    if (std::optional<Waiting> waiting = std::exchange(owner.waiting, std::nullopt)) {
        owner.writer = waiting->writer;
        owner.sender = waiting->sender;
        outcome.next = std::move(waiting->request);
    } else {
        owners_.erase(known);
    }
    return outcome;
}

void RequestOwners::drop_waiting(Owner& owner) {
    if (owner.waiting) release(owner.waiting->sender);
    owner.waiting.reset();
}

void RequestOwners::release(const SenderId& sender) {
    const auto count = counts_.find(sender);
    if (--count->second == 0) counts_.erase(count);
}

}  // namespace camdir::dds
