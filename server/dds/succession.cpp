#include "dds/succession.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace camdir::dds {
namespace {

auto claim_of(const Sign& sign) {
    return std::tuple(sign.term, sign.rank, sign.director_id);
}

// Of a game server's frames, in which its silence is told from a pause between two.
constexpr std::chrono::milliseconds longest_interval{700};

}  // namespace

Succession::Succession(std::uint64_t director_id, std::uint32_t rank, std::chrono::milliseconds lease,
                       Time now)
    : heard_(now - 2 * together),
      lived_(now),
      settled_(now + settling),
      produced_(now - 2 * patience),
      camera_change_(now) {
    own_.director_id = director_id;
    own_.rank = rank;
    own_.lease = lease;
}

void Succession::see(const Sign& other, Time now) {
    if (other.director_id == own_.director_id) return;
    come_back(now);
    auto known = others_.find(other.director_id);
    if (known == others_.end()) {
        if (others_.size() >= max_others)
            std::erase_if(others_, [&](const auto& entry) { return !lives(entry.second, now); });
        if (others_.size() >= max_others) return;
        known = others_.try_emplace(other.director_id, Other{other, now, now}).first;
    }
    if (known->second.sign.has_cameras != other.has_cameras) known->second.camera_change = now;
    known->second.sign = other;
    known->second.sign.lease = std::min(other.lease, max_other_lease * own_.lease);
    known->second.seen = now;
    notice_reunion(now);
    decide(now);
}

bool Succession::hear(Time now) {
    const bool awaited = waits_for_game(now);
    come_back(now);
    interval_ = std::clamp<Clock::duration>(now - heard_, interval_ * 9 / 10, longest_interval);
    heard_ = now;
    return awaited;
}

void Succession::leave(std::uint64_t director_id, Time now) {
    come_back(now);
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
        const Sign& other = entry.second.sign;
        return lives(entry.second, now) && is_at_home(other) && other.has_cameras >= own_.has_cameras;
    });
}

// A leader is silent until its next beat. What a standby has last heard may be a beat older than its own last
// sign, and it must not take a leader for dead that it did not listen to.
Succession::Clock::duration Succession::longest_silence() const {
    return own_.leads ? Clock::duration(own_.lease) : own_.lease - own_.lease * 3 / (2 * beats);
}

void Succession::notice_absence(Time now) {
    const Clock::duration absence = now - lived_;
    if (absence <= longest_silence()) return;
    if (!cut_off_) forget_dead(lived_);
    if (settled_ > lived_) settled_ += absence;
    lived_ = now;
    miss(absence, now);
}

// Only the time that it listened counts: what the others did meanwhile they have the rest of their leases to
// say, a whole one to a leader, and longer where they have to be met again.
void Succession::miss(Clock::duration absence, Time now) {
    returned_.reset();
    if (others_.empty()) return;
    if (absence > apart) barred_ = now + meeting;
    if (own_.leads) barred_ = std::max(barred_, now + std::max<Clock::duration>(own_.lease, settling));
    settled_ = std::max(settled_, barred_);
    own_.leads = false;
    notice_cameras(now);  // its last sign says so: nobody waits for it
    heard_ = std::min(now, heard_ + absence);
    for (auto& [id, other] : others_)
        other.seen = std::min(now, other.seen + absence);
}

const Succession::Other* Succession::last_heard() const {
    const Other* last = nullptr;
    for (const auto& [id, other] : others_)
        if (last == nullptr || other.seen > last->seen) last = &other;
    return last;
}

// The game server that was heard until about the last sign of the others has not been heard since they are
// dead: it tells whether it is they who are gone.
bool Succession::waits_for_game(Time now) const {
    const Other* last = last_heard();
    return last != nullptr && !lives(*last, now) && last->seen <= heard_ + together &&
           heard_ <= last->seen + last->sign.lease;
}

// A game server that sends slowly is not silent between two frames.
Succession::Clock::duration Succession::game_silence() const {
    return std::max<Clock::duration>(own_.lease, 3 * interval_);
}

// Where it still computes cameras, of a delay, it shows them.
void Succession::notice_cut(Time now) {
    const Other* last = last_heard();
    if (cut_off_ || last == nullptr || lives(*last, now)) return;
    if (now <= heard_ + game_silence() || now <= produced_ + own_.lease) return;
    if (last->seen > heard_ + together || heard_ > last->seen + together) return;
    cut_off_ = std::max(heard_, last->seen);
    own_.leads = false;
}

void Succession::come_back(Time now) {
    notice_absence(now);
    notice_cut(now);
    if (!cut_off_) return;
    const Time cut = *std::exchange(cut_off_, std::nullopt);
    forget_dead(cut);
    barred_ = std::max(barred_, now + std::max<Clock::duration>(own_.lease, settling));
    miss(now - cut, now);
    returned_ = now;
}

// Others that were dead for long by then.
void Succession::forget_dead(Time then) {
    std::erase_if(others_, [&](const auto& entry) { return entry.second.seen + apart < then; });
}

// Their silence and the game server's next one have nothing to do with each other.
void Succession::forget_who_did_not_return(Time now) {
    if (!returned_ || cut_off_ || now < settled_) return;
    std::erase_if(others_, [&](const auto& entry) { return entry.second.seen <= *returned_; });
    returned_.reset();
}

// Who leads is known again.
void Succession::notice_reunion(Time now) {
    if (!returned_ ||
        std::ranges::any_of(others_, [&](const auto& entry) { return entry.second.seen <= *returned_; }))
        return;
    returned_.reset();
    barred_ = settled_ = now;
}

void Succession::notice_cameras(Time now) {
    const bool has_cameras = now - produced_ <= patience && now >= barred_ && !cut_off_;
    if (has_cameras == own_.has_cameras) return;
    own_.has_cameras = has_cameras;
    camera_change_ = now;
}

void Succession::decide(Time now) {
    notice_absence(now);
    notice_cut(now);
    forget_who_did_not_return(now);
    notice_cameras(now);
    if (resigned_ || cut_off_) {
        own_.leads = false;
    } else if (const Other* other = leader(now)) {
        own_.leads = own_.leads ? claim_of(own_) > claim_of(other->sign) : may_depose(*other, now);
        if (!own_.leads) own_.term = std::min(max_term, std::max(own_.term, other->sign.term + 1));
    } else if (!own_.leads) {
        own_.leads = now >= settled_ && is_first(now) && !waits_for_game(now);
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
    consider(heard_ + game_silence() + afterwards);
    consider(settled_);
    for (const auto& [id, other] : others_) {
        consider(other.seen + other.sign.lease + afterwards);
        if (!own_.leads && other.sign.leads && own_.has_cameras)
            consider(may_depose_from(other) + afterwards);
    }
    return next;
}

}  // namespace camdir::dds
