#include "dds/admission.hpp"

#include <algorithm>
#include <utility>

namespace camdir::dds {

Admission::Admission(Host& host, Shards shards, const Limits& limits)
    : host_(host),
      limits_(limits),
      shards_(std::move(shards)),
      rate_(limits.participant_matches, limits.participant_match_rate),
      waiting_(none_waiting()),
      elsewhere_(none_elsewhere()) {}

bool Admission::begins(const Claim& claim, Time now) {
    WaitingMatches* const queue = queue_for(claim, now);
    for (WaitingMatches* other : queues())
        if (other != queue) other->remove(claim.info.match_id, claim.writer);  // an older description
    if (queue != nullptr) keep(*queue, claim);
    return queue == nullptr;
}

// Null: it begins.
WaitingMatches* Admission::queue_for(const Claim& claim, Time now) {
    if (!shards_.serves(claim.info.match_id)) return &elsewhere_;
    if (admit(claim, now)) return nullptr;
    return moving_.has(claim.info.match_id, claim.writer) ? &moving_ : &waiting_;
}

bool Admission::admit(const Claim& claim, Time now) {
    const std::string& match_id = claim.info.match_id;
    if (!may_own_another(claim.sender)) {
        host_.refuse(match_id, ValidationError::participant_limit);
        return false;
    }
    if (!rate_.allows(claim.sender, now)) {
        host_.refuse(match_id, ValidationError::participant_rate);
        return false;
    }
    if (!host_.admits(match_id)) return false;
    rate_.take(claim.sender, now);
    return true;
}

std::optional<Admission::Claim> Admission::next(Time now) {
    const auto may_begin = [&](const Claim& claim) {
        return may_own_another(claim.sender) && rate_.allows(claim.sender, now) &&
               host_.has_room_for(claim.info.match_id);
    };
    std::optional<Claim> claim = moving_.take(may_begin);
    return claim ? std::move(claim) : waiting_.take(may_begin);
}

bool Admission::may_own_another(const SenderId& participant) const {
    return host_.owned_by(participant) < limits_.participant_matches;
}

void Admission::keep(WaitingMatches& waiting, const Claim& claim) {
    if (!waiting.keep(claim)) host_.refuse(claim.info.match_id, ValidationError::waiting_limit);
}

void Admission::withdraw(const std::string& match_id, WriterHandle writer) {
    for (WaitingMatches* waiting : queues())
        waiting->remove(match_id, writer);
}

void Admission::retain(std::span<const WriterHandle> matched) {
    for (WaitingMatches* waiting : queues())
        waiting->retain(matched);
}

void Admission::reshard(Shards shards) {
    shards_ = std::move(shards);
    const auto sort = [&](WaitingMatches all, WaitingMatches& here) {
        while (const auto claim = all.take([](const Claim&) { return true; }))
            keep(shards_.serves(claim->info.match_id) ? here : elsewhere_, *claim);
    };
    WaitingMatches elsewhere = std::exchange(elsewhere_, none_elsewhere());
    sort(std::exchange(moving_, {}), moving_);
    sort(std::move(elsewhere), moving_);
    sort(std::exchange(waiting_, none_waiting()), waiting_);
}

WaitingMatches Admission::none_waiting() const {
    return {limits_.matches, std::max<std::size_t>(limits_.matches / 4, 1)};
}

// As many as the other shards may serve.
WaitingMatches Admission::none_elsewhere() const {
    const std::size_t others = shards_.count();
    return {others * limits_.matches, others * limits_.participant_matches};
}

}  // namespace camdir::dds
