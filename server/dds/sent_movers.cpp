#include "dds/sent_movers.hpp"

#include <algorithm>
#include <utility>

namespace camdir::dds {

SentMovers::Sent* SentMovers::find(const SenderId& sender) {
    const auto found = std::ranges::find(senders_, sender, &Sent::sender);
    return found == senders_.end() ? nullptr : &*found;
}

bool SentMovers::admit(const SenderId& sender, const SenderId& owner, std::span<const SenderId> heirs) {
    auto known = std::ranges::find(senders_, sender, &Sent::sender);
    if (known == senders_.end()) {
        if (senders_.size() >= max_senders) {
            const auto leaves = std::ranges::find_if(senders_, [&](const Sent& sent) {
                return sent.sender != owner && std::ranges::find(heirs, sent.sender) == heirs.end();
            });
            if (leaves == senders_.end()) return false;
            senders_.erase(leaves);
        }
        known = senders_.insert(senders_.end(), Sent{sender, {}, {}, {}, {}, {}, {}});
    }
    std::rotate(known, known + 1, senders_.end());
    return true;
}

void SentMovers::retain(std::span<const SenderId> matched) {
    std::erase_if(senders_,
                  [&](const Sent& sent) { return std::ranges::find(matched, sent.sender) == matched.end(); });
}

void SentMovers::put(const SenderId& sender, std::shared_ptr<director::MoverInfo> described,
                     bool counted_as_dropped) {
    Sent& sent = *find(sender);
    sent.described = std::move(described);
    sent.counted_as_dropped = counted_as_dropped;
}

void SentMovers::put_bounded(const SenderId& sender, std::shared_ptr<const director::MoverInfo> info) {
    Sent* sent = find(sender);
    if (sent == nullptr || (sent->info && *sent->info == *info)) return;
    sent->info = std::move(info);
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
