#include "dds/ownership.hpp"

#include <algorithm>
#include <utility>

namespace camdir::dds {

Ownership::Standing Ownership::describe(Claim claim, Time now) {
    auto known = std::ranges::find(claims_, claim.sender, &Claim::sender);
    if (known == claims_.end()) {
        if (claims_.size() >= max_claims) return Standing::stranger;
        if (claims_.empty()) sent_ = now;
        known = claims_.insert(known, Claimant{std::move(claim)});
    } else {
        static_cast<Claim&>(*known) = std::move(claim);
    }
    const bool owns = known == claims_.begin();
    if (!owns && !lost_) return Standing::stranger;
    if (!owns) pass_to(known, now);
    lost_ = owner_is_gone_ = false;
    return owns ? Standing::owner : Standing::successor;
}

Ownership::Standing Ownership::send(const SenderId& sender, std::chrono::nanoseconds silence_limit,
                                    Time now) {
    if (owns(sender)) {
        sent_ = now;
        lost_ = false;
        return Standing::owner;
    }
    const auto known = std::ranges::find(claims_, sender, &Claim::sender);
    if (known == claims_.end() || !may_take(*known, silence_limit, now)) return Standing::stranger;
    if (!known->was_silent) {
        if (std::ranges::none_of(claims_, &Claimant::was_silent)) claims_.front().was_silent = true;
    } else if (!gave_back(owner().sender)) {
        returners_.push_back({owner().sender, owner().writer});
    }
    pass_to(known, now);
    return Standing::successor;
}

bool Ownership::may_take(const Claimant& claimant, std::chrono::nanoseconds silence_limit, Time now) const {
    if (claimant.was_silent) return true;
    const int patience = gave_back(claimant.sender) ? patience_after_return : 1;
    return now - std::max(sent_, listening_since_) > patience * silence_limit;
}

Ownership::Change Ownership::dispose(WriterHandle writer, bool certain, Time now) {
    const auto known = std::ranges::find(claims_, writer, &Claim::writer);
    if (known == claims_.end()) {
        contested_ = true;
        return Change::none;
    }
    const bool counts = certain || (!contested_ && claims_.size() == 1);
    contested_ = true;
    if (!counts) return Change::none;
    if (known == claims_.begin()) return end_owner(now);
    claims_.erase(known);
    return Change::none;
}

Ownership::Change Ownership::lose() {
    if (!has_live_owner()) return Change::none;
    lost_ = true;
    return Change::lost;
}

Ownership::Change Ownership::retain(std::span<const WriterHandle> matched, Time now) {
    const auto gone = [&](const auto& of) { return !std::ranges::binary_search(matched, of.writer); };
    std::erase_if(returners_, gone);
    if (claims_.empty()) return Change::none;
    claims_.erase(std::remove_if(claims_.begin() + 1, claims_.end(), gone), claims_.end());
    if (!gone(claims_.front())) return Change::none;
    if (claims_.size() > 1 || contested_) return end_owner(now);
    owner_is_gone_ = true;
    return lose();
}

// The former owner waits, should it be there still.
void Ownership::pass_to(Claims::iterator successor, Time now) {
    std::rotate(claims_.begin(), successor, successor + 1);
    if (owner_is_gone_) claims_.erase(claims_.begin() + 1);
    begin_to_own(now);
}

Ownership::Change Ownership::end_owner(Time now) {
    claims_.erase(claims_.begin());
    if (!claims_.empty()) {
        begin_to_own(now);
        return Change::succeeded;
    }
    lost_ = owner_is_gone_ = contested_ = false;
    return Change::ended;
}

void Ownership::begin_to_own(Time now) {
    claims_.front().was_silent = false;
    std::erase_if(returners_, [&](const Returner& returner) { return owns(returner.sender); });
    sent_ = now;
    lost_ = owner_is_gone_ = false;
}

}  // namespace camdir::dds
