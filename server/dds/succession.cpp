#include "dds/succession.hpp"

#include <algorithm>
#include <tuple>

namespace camdir::dds {
namespace {

auto claim_of(const Sign& sign) {
    return std::tuple(sign.term, sign.rank, sign.director_id);
}

auto aptness_of(const Sign& sign) {
    return std::tuple(sign.has_cameras, sign.rank, sign.director_id);
}

}  // namespace

Succession::Succession(std::uint64_t director_id, std::uint32_t rank, std::chrono::milliseconds lease,
                       Time now)
    : lived_(now), settled_(now + settling), produced_(now - 2 * patience), camera_change_(now) {
    own_.director_id = director_id;
    own_.rank = rank;
    own_.lease = lease;
}

void Succession::see(const Sign& other, Time now) {
    if (other.director_id == own_.director_id) return;
    auto known = others_.find(other.director_id);
    if (known == others_.end()) {
        if (others_.size() >= max_others)
            std::erase_if(others_, [&](const auto& entry) { return !lives(entry.second, now); });
        if (others_.size() >= max_others) return;
        known = others_.try_emplace(other.director_id, Other{other, now, now}).first;
    }
    if (known->second.sign.has_cameras != other.has_cameras) known->second.camera_change = now;
    known->second.sign = other;
    known->second.seen = now;
    decide(now);
}

void Succession::leave(std::uint64_t director_id, Time now) {
    others_.erase(director_id);
    decide(now);
}

void Succession::live(Time now) {
    notice_absence(now);
    lived_ = now;
    resigned_ = false;
    decide(now);
}

void Succession::resign(Time now) {
    resigned_ = std::ranges::any_of(others_, [&](const auto& other) { return lives(other.second, now); });
    if (resigned_) settled_ = now + std::max<Clock::duration>(own_.lease, settling);
    if (resigned_) own_.leads = false;
}

bool Succession::has_successor(Time now) const {
    return std::ranges::any_of(others_, [&](const auto& entry) {
        return lives(entry.second, now) && entry.second.sign.has_cameras >= own_.has_cameras;
    });
}

// A leader is silent until its next beat. What a standby has last heard may be a beat older than its own last
// sign, and it must not take a leader for dead that it did not listen to.
Succession::Clock::duration Succession::longest_silence() const {
    return own_.leads ? Clock::duration(own_.lease) : own_.lease - own_.lease * 3 / (2 * beats);
}

// Only the time that it listened counts: what the others did meanwhile they have the rest of their leases to
// say, a whole one to a leader, and longer where they have to be met again.
void Succession::notice_absence(Time now) {
    const Clock::duration absence = now - lived_;
    if (absence <= longest_silence()) return;
    std::erase_if(others_, [&](const auto& entry) { return entry.second.seen + apart < lived_; });
    if (settled_ > lived_) settled_ += absence;
    lived_ = now;
    if (others_.empty()) return;
    if (absence > apart) barred_ = now + meeting;
    if (own_.leads) barred_ = std::max(barred_, now + std::max<Clock::duration>(own_.lease, settling));
    settled_ = std::max(settled_, barred_);
    own_.leads = false;
    for (auto& [id, other] : others_)
        other.seen = std::min(now, other.seen + absence);
}

void Succession::notice_cameras(Time now) {
    const bool has_cameras = now - produced_ <= patience && now >= barred_;
    if (has_cameras == own_.has_cameras) return;
    own_.has_cameras = has_cameras;
    camera_change_ = now;
}

void Succession::decide(Time now) {
    notice_absence(now);
    notice_cameras(now);
    if (resigned_) {
        own_.leads = false;
    } else if (const Other* other = leader(now)) {
        own_.leads = own_.leads ? claim_of(own_) > claim_of(other->sign) : may_depose(*other, now);
        if (!own_.leads) own_.term = std::min(max_term, std::max(own_.term, other->sign.term + 1));
    } else if (!own_.leads) {
        own_.leads = now >= settled_ && is_first(now);
        if (own_.leads) led_since_ = now;
    }
    if (own_.leads && now - led_since_ > establishing) own_.term = std::max(own_.term, 1U);
}

const Succession::Other* Succession::leader(Time now) const {
    const Other* found = nullptr;
    for (const auto& [id, other] : others_) {
        if (!other.sign.leads || !lives(other, now)) continue;
        if (found == nullptr || claim_of(other.sign) > claim_of(found->sign)) found = &other;
    }
    return found;
}

bool Succession::is_first(Time now) const {
    return std::ranges::none_of(others_, [&](const auto& entry) {
        const Other& other = entry.second;
        return lives(other, now) && aptness_of(other.sign) > aptness_of(own_);
    });
}

Succession::Time Succession::may_depose_from(const Other& leader) const {
    return std::max({settled_, camera_change_ + patience, leader.camera_change + patience});
}

bool Succession::may_depose(const Other& leader, Time now) const {
    return own_.has_cameras && !leader.sign.has_cameras && now > may_depose_from(leader) &&
           own_.term > leader.sign.term && is_first(now);
}

Succession::Time Succession::next_change(Time now) const {
    constexpr std::chrono::milliseconds afterwards{1};
    Time next = now + own_.lease + afterwards;
    const auto consider = [&](Time then) {
        if (then > now) next = std::min(next, then);
    };
    consider(produced_ + patience + afterwards);
    if (own_.leads) return next;
    consider(settled_);
    for (const auto& [id, other] : others_) {
        consider(other.seen + other.sign.lease + afterwards);
        if (other.sign.leads && own_.has_cameras) consider(may_depose_from(other) + afterwards);
    }
    return next;
}

}  // namespace camdir::dds
