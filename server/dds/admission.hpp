// Which of the described matches begin here, and which wait.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "dds/admission_rate.hpp"
#include "dds/decode.hpp"
#include "dds/ownership.hpp"
#include "dds/shards.hpp"
#include "dds/waiting_matches.hpp"

namespace camdir::dds {

// A match begins where this shard serves it, its participant may begin another, and there is room. Else its
// newest description waits, within bounds. One thread at a time; times are the caller's.
class Admission {
  public:
    using Claim = Ownership::Claim;
    using Time = AdmissionRate::Time;

    struct Limits {
        std::size_t matches = 0;              // at least 1
        std::size_t participant_matches = 0;  // at least 1
        double participant_match_rate = 0.0;  // that it may begin in a second, after participant_matches; > 0
    };
    // Who serves the matches that have begun.
    class Host {
      public:
        // How many matches belong to this participant.
        [[nodiscard]] virtual std::size_t owned_by(const SenderId& participant) const = 0;
        // Whether the match has room for its endpoints.
        [[nodiscard]] virtual bool has_room_for(const std::string& match_id) const = 0;
        // The match may begin now. The host itself counts what it refuses.
        [[nodiscard]] virtual bool admits(const std::string& match_id) = 0;
        // The participant has reached a limit; its match waits, or is dropped where `limit` is waiting_limit.
        virtual void refuse(const std::string& match_id, ValidationError limit) = 0;

      protected:
        ~Host() = default;
    };

    // The host must outlive it.
    Admission(Host& host, Shards shards, const Limits& limits);

    // Of a match that is not served: whether it begins now. Else the description waits.
    [[nodiscard]] bool begins(const Claim& claim, Time now);
    // The first that waits and may begin, and waits no longer: begins() decides. Those that other shards have
    // left come before others.
    [[nodiscard]] std::optional<Claim> next(Time now);
    // A match that was served is another shard's.
    void leave(const Claim& claim) { keep(elsewhere_, claim); }
    // The description does not wait any more: its writer has withdrawn it, or the match is served.
    void withdraw(const std::string& match_id, WriterHandle writer);
    // Those whose writers are not among these (ascending) are gone.
    void retain(std::span<const WriterHandle> matched);
    // What was another shard's, and is this one's now, waits for room, and the other way round.
    void reshard(Shards shards);
    [[nodiscard]] const Shards& shards() const { return shards_; }
    // Frees memory; to be called now and then.
    void forget_idle(Time now) { rate_.forget_idle(now); }

  private:
    [[nodiscard]] WaitingMatches* queue_for(const Claim& claim, Time now);
    [[nodiscard]] bool admit(const Claim& claim, Time now);
    [[nodiscard]] bool may_own_another(const SenderId& participant) const;
    void keep(WaitingMatches& waiting, const Claim& claim);
    [[nodiscard]] std::array<WaitingMatches*, 3> queues() { return {&waiting_, &moving_, &elsewhere_}; }
    [[nodiscard]] WaitingMatches none_waiting() const;
    [[nodiscard]] WaitingMatches none_elsewhere() const;

    Host& host_;
    const Limits limits_;
    Shards shards_;
    AdmissionRate rate_;
    WaitingMatches waiting_;    // for room
    WaitingMatches moving_;     // for room, of another shard before: as many as were elsewhere
    WaitingMatches elsewhere_;  // of other shards
};

}  // namespace camdir::dds
