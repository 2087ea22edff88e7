// Whose a match is, of all the participants that describe it.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <span>
#include <vector>

#include "dds/sender.hpp"
#include "director/messages.hpp"

namespace camdir::dds {

// A match belongs to the participant that opened it until that one disposes its description, is gone, or has
// sent no poses for as long as makes a match silent while another who describes the match sends them. Others
// who describe it wait for that. Who was only silent gets the match back with its next poses, and whoever
// has given it back takes it for silence again only after patience_after_return times as long. One thread at
// a time; times are the caller's.
class Ownership {
  public:
    using Time = std::chrono::steady_clock::time_point;

    static constexpr std::size_t max_claims = 8;  // the owner's and those that wait
    static constexpr int patience_after_return = 10;

    struct Claim {
        SenderId sender{};
        WriterHandle writer = 0;  // of the description
        director::MatchInfo info;
    };
    enum class Standing {
        owner,      // the sample counts
        successor,  // it counts, and the match begins anew with the owner's description
        stranger    // it does not count
    };
    enum class Change { none, lost, ended, succeeded };

    // Each describes the match; what waits is kept. A claim beyond max_claims is not.
    [[nodiscard]] Standing describe(Claim claim, Time now);
    // A pose frame.
    [[nodiscard]] Standing send(const SenderId& sender, std::chrono::nanoseconds silence_limit, Time now);
    // The description was disposed by this writer. `certain`: not when it may have been another, because DDS
    // told of it with the last description only; then it counts unless there are others.
    [[nodiscard]] Change dispose(WriterHandle writer, bool certain, Time now);
    // The liveliness of all is lost: each may be back.
    [[nodiscard]] Change lose();
    // Those whose writers are not among these (ascending) are gone.
    [[nodiscard]] Change retain(std::span<const WriterHandle> matched, Time now);
    // Until now nobody was listened to, who therefore was not silent.
    void resume(Time now) { listening_since_ = now; }

    [[nodiscard]] bool owns(const SenderId& sender) const {
        return !claims_.empty() && claims_.front().sender == sender;
    }
    // Describes the match: owns it, or may own it later.
    [[nodiscard]] bool knows(const SenderId& sender) const {
        return std::ranges::find(claims_, sender, &Claim::sender) != claims_.end();
    }
    // The owner's first; also of those whose liveliness is lost.
    [[nodiscard]] std::vector<Claim> claims() const { return {claims_.begin(), claims_.end()}; }
    [[nodiscard]] bool has_owner() const { return !claims_.empty(); }
    [[nodiscard]] bool has_live_owner() const { return has_owner() && !lost_; }
    // The following are to be called while there has been an owner since the last `ended`.
    [[nodiscard]] const Claim& owner() const { return claims_.front(); }
    [[nodiscard]] const director::MatchInfo& info() const { return owner().info; }

  private:
    struct Claimant : Claim {
        bool was_silent = false;  // and lost the match for it
    };
    using Claims = std::vector<Claimant>;
    struct Returner {
        SenderId sender;
        WriterHandle writer;
    };

    [[nodiscard]] bool may_take(const Claimant& claimant, std::chrono::nanoseconds silence_limit,
                                Time now) const;
    [[nodiscard]] bool gave_back(const SenderId& sender) const {
        return std::ranges::find(returners_, sender, &Returner::sender) != returners_.end();
    }
    void pass_to(Claims::iterator successor, Time now);
    [[nodiscard]] Change end_owner(Time now);
    void begin_to_own(Time now);

    Claims claims_;                    // the owner's first, then in the order of arrival
    std::vector<Returner> returners_;  // gave the match back, as long as they are matched, claims or not
    bool lost_ = false;
    bool owner_is_gone_ = false;  // for good, but its match waits for another
    // The description has been disposed, and the match goes on. DDS may not tell of another disposal: the
    // owner ends the match when it leaves.
    bool contested_ = false;
    Time sent_{};  // the owner's last pose, or since when it owns the match
    Time listening_since_{};
};

}  // namespace camdir::dds
