#include "dds/sent_movers.hpp"

#include <algorithm>
#include <utility>

namespace camdir::dds {

SentMovers::Sent* SentMovers::find(const SenderId& sender) {
    const auto found = std::ranges::find(senders_, sender, &Sent::sender);
    return found == senders_.end() ? nullptr : &*found;
}

bool SentMovers::admit(const SenderId& sender, WriterHandle writer, const Ownership& ownership) {
    auto known = std::ranges::find(senders_, sender, &Sent::sender);
    if (known == senders_.end()) {
        if (senders_.size() >= max_senders) {
            const auto leaves = std::ranges::find_if(
                senders_, [&](const Sent& sent) { return !ownership.knows(sent.sender); });
            if (leaves == senders_.end()) return false;
            senders_.erase(leaves);
        }
        known = senders_.insert(senders_.end(), Sent{});
        known->sender = sender;
    }
    if (std::ranges::find(known->writers, writer) == known->writers.end()) known->writers.push_back(writer);
    std::rotate(known, known + 1, senders_.end());
    return true;
}

void SentMovers::retain(std::span<const WriterHandle> matched) {
    const auto gone = [&](WriterHandle writer) { return !std::ranges::binary_search(matched, writer); };
    for (Sent& sent : senders_)
        std::erase_if(sent.writers, gone);
    std::erase_if(senders_, [](const Sent& sent) { return sent.writers.empty(); });
}

void SentMovers::put(const SenderId& sender, std::shared_ptr<director::MoverInfo> described,
                     bool counted_as_dropped) {
    Sent& sent = *find(sender);
    sent.described = std::move(described);
    sent.counted_as_dropped = counted_as_dropped;
}

std::optional<SentMovers::Step> SentMovers::bound_next(const Ownership& ownership) {
    if (!bounding_) bounding_ = take_described(ownership);
    if (!bounding_) return std::nullopt;
    const auto error = bound_hulls(*bounding_->info, 1);
    if (!error && !has_bounds(*bounding_->info)) return Step{};
    const Described done = *std::exchange(bounding_, std::nullopt);
    if (!error) put_bounded(done);
    return done.counted_as_dropped ? Step{} : Step{!error, error};
}

std::optional<SentMovers::Described> SentMovers::take_described(const Ownership& ownership) {
    for (const bool of_owner : {true, false})
        for (Sent& sent : senders_)
            if (sent.described && (of_owner ? ownership.owns(sent.sender) : ownership.knows(sent.sender)))
                return Described{sent.sender, std::exchange(sent.described, nullptr),
                                 sent.counted_as_dropped};
    return std::nullopt;
}

// The sender may have left meanwhile.
void SentMovers::put_bounded(const Described& described) {
    Sent* sent = find(described.sender);
    if (sent == nullptr || (sent->info && *sent->info == *described.info)) return;
    sent->info = described.info;
}

void SentMovers::put(const SenderId& sender, Frame frame) {
    Sent& sent = *find(sender);
    if (sent.waiting.size() >= max_waiting) {
        sent.frame = sent.waiting.front();
        sent.waiting.erase(sent.waiting.begin());
    }
    sent.waiting.push_back(std::move(frame));
}

std::shared_ptr<const director::MatchMovers> SentMovers::at(const SenderId& sender, std::uint64_t epoch,
                                                            std::int64_t frame_time) {
    Sent* sent = find(sender);
    if (sent == nullptr) return nullptr;
    const auto is_due = [&](const Frame& frame) {
        return frame->epoch < epoch || (frame->epoch == epoch && frame->frame_time <= frame_time);
    };
    auto& waiting = sent->waiting;
    const auto later = std::ranges::find_if_not(waiting, is_due);
    if (later != waiting.begin()) sent->frame = *std::prev(later);
    waiting.erase(waiting.begin(), later);
    if (!sent->info || !sent->frame || sent->info->epoch != epoch || sent->frame->epoch != epoch)
        return nullptr;
    if (!sent->both || sent->both->info != sent->info || sent->both->frame != sent->frame)
        sent->both =
            std::make_shared<const director::MatchMovers>(director::MatchMovers{sent->info, sent->frame});
    return sent->both;
}

}  // namespace camdir::dds
