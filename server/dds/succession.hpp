// Who of a match's directors leads it: whoever serves it, serves on; another follows only where the leader
// dies, hangs, leaves, is cut off or has no cameras.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <tuple>
#include <unordered_map>

namespace camdir::dds {

inline constexpr std::uint32_t max_term = 0x7fff;
inline constexpr std::uint32_t max_rank = 0xffff;
inline constexpr std::chrono::milliseconds max_lease{60'000};

// What a director tells the others of itself.
struct Sign {
    std::uint64_t director_id = 0;
    std::uint32_t term = 0;  // of a standby: in which it would lead, greater than its leader's
    std::uint32_t rank = 0;
    std::chrono::milliseconds lease{0};  // without a sign for longer it is dead
    bool leads = false;
    bool has_cameras = false;  // and could lead with them
    std::uint64_t shard = 0;   // 0: none

    bool operator==(const Sign&) const = default;
};

// The view of one director. Where the game server and all other directors fall silent together, it is itself
// that cannot be reached: it stands by until it hears one of them again. One thread at a time. Only
// what says so makes it take over; all else that may change own() makes it stand by.
class Succession {
  public:
    using Clock = std::chrono::steady_clock;
    using Time = Clock::time_point;

    // How long the directors of a match that begins look for each other.
    static constexpr std::chrono::milliseconds settling{250};
    // How long a leader may be without cameras where a standby has them; so long a director has cameras after
    // it has computed some.
    static constexpr std::chrono::milliseconds patience{300};
    // Directors that were apart for longer than `apart` have forgotten each other, and need so long until
    // they have met again.
    static constexpr std::chrono::seconds apart{5}, meeting{3};
    // Others who have lost this director forget it, and fall silent, within so long of each other.
    static constexpr std::chrono::seconds together{2};
    // After so long a first leader's term is later than that of one that begins and has not found it yet.
    static constexpr std::chrono::seconds establishing{1};
    static constexpr std::size_t max_others = 64;
    // Of another's lease in own ones: what is longer would keep the match without cameras for that long.
    static constexpr int max_other_lease = 10;
    // Calls of live() in a lease: some may come late.
    static constexpr int beats = 4;

    // A director is dead to the others, and to itself, after `lease` without a sign.
    Succession(std::uint64_t director_id, std::uint32_t rank, std::chrono::milliseconds lease, Time now);

    // It has computed cameras.
    void produce(Time now) { produced_ = now; }
    // The game server was heard. Returns whether a decision has waited for it: decide() is due.
    [[nodiscard]] bool hear(Time now);
    // May take over. Counts for nothing where max_others live.
    void see(const Sign& other, Time now);
    // It left: the next one takes over at once.
    void leave(std::uint64_t director_id, Time now);
    // This director lives and responds. One that was silent for longer than its lease stands by, if there
    // were others, and looks for a new leader. May take over.
    void live(Time now);
    // Leads no more until live() is called, if there is another that lives.
    void resign(Time now);
    // Directors of other shards than `home` lead the match only where none of it does; 0: all may.
    void set_shards(std::uint64_t own, std::uint64_t home) {
        own_.shard = own;
        home_ = home;
    }
    // Whether another lives that has cameras, if this one has some, and is to lead as well as this one.
    [[nodiscard]] bool has_successor(Time now) const;
    // Whether another of the match's shard lives that leads.
    [[nodiscard]] bool follows(Time now) const {
        const Other* other = own_.leads ? nullptr : leader(now);
        return other != nullptr && is_at_home(other->sign);
    }
    // To be called before anything is written.
    void notice_absence(Time now);
    // What time alone changes: may take over. To be called when all signs that have come are seen, and not
    // later than next_change().
    void decide(Time now);

    [[nodiscard]] const Sign& own() const { return own_; }
    [[nodiscard]] Time next_change(Time now) const;

  private:
    struct Other {
        Sign sign;
        Time seen;
        Time camera_change;
    };

    [[nodiscard]] static bool lives(const Other& other, Time now) {
        return now <= other.seen + other.sign.lease;
    }
    [[nodiscard]] bool is_at_home(const Sign& sign) const { return home_ == 0 || sign.shard == home_; }
    [[nodiscard]] auto aptness_of(const Sign& sign) const {
        return std::tuple(sign.has_cameras, is_at_home(sign), sign.rank, sign.director_id);
    }
    [[nodiscard]] Clock::duration longest_silence() const;
    [[nodiscard]] const Other* last_heard() const;
    [[nodiscard]] bool waits_for_game(Time now) const;
    [[nodiscard]] Clock::duration game_silence() const;
    void notice_cut(Time now);
    void come_back(Time now);
    void forget_dead(Time then);
    void notice_reunion(Time now);
    void forget_who_did_not_return(Time now);
    void miss(Clock::duration absence, Time now);
    void notice_cameras(Time now);
    [[nodiscard]] const Other* leader(Time now) const;
    [[nodiscard]] bool is_first(Time now) const;
    [[nodiscard]] Time may_depose_from(const Other& leader) const;
    [[nodiscard]] bool may_depose(const Other& leader, Time now) const;

    Sign own_;
    std::uint64_t home_ = 0;
    bool resigned_ = false;
    std::optional<Time> cut_off_;   // when it heard somebody for the last time
    std::optional<Time> returned_;  // since when it hears somebody again, as long as it has not heard all
    Time heard_;                    // the game server
    Clock::duration interval_{0};   // at which it is heard, and a little longer
    Time lived_;                    // last sign of its own life
    Time settled_;                  // until then it does not take over
    Time barred_;                   // the same after an absence: until then others need not wait for it
    Time led_since_;
    Time produced_;
    Time camera_change_;
    std::unordered_map<std::uint64_t, Other> others_;
};

}  // namespace camdir::dds
