// Deletes the endpoints of matches that have ended.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/turn_timer.hpp"
#include "dds/match_table.hpp"

namespace camdir::dds {

// In threads of its own: for each endpoint DDS waits until all of its own threads have passed a certain
// point, and whoever waits with it receives nothing meanwhile. Thread-safe.
class EndpointRemoval {
  public:
    // As many matches may wait for the end of theirs.
    explicit EndpointRemoval(std::size_t capacity);
    // Deletes what is left.
    ~EndpointRemoval();
    EndpointRemoval(const EndpointRemoval&) = delete;
    EndpointRemoval& operator=(const EndpointRemoval&) = delete;

    [[nodiscard]] bool has_room() const;
    // New endpoints of this match would be taken for its former ones, which are not deleted yet.
    [[nodiscard]] bool removes(const std::string& match_id) const;
    // False when the endpoints of a match take longer than `limit`.
    [[nodiscard]] bool responsive(std::chrono::nanoseconds limit) const {
        return std::ranges::all_of(turns_, [&](const TurnTimer& turn) { return turn.within(limit); });
    }
    void add(MatchTable::Endpoints endpoints);

  private:
    void run(const std::stop_token& stop, TurnTimer& turn);

    // The waits of one thread are also those of the others.
    static constexpr std::size_t thread_count = 4;

    const std::size_t capacity_;
    mutable std::mutex mutex_;
    std::condition_variable_any changed_;
    std::deque<MatchTable::Endpoints> waiting_;
    std::multiset<std::string> pending_;  // match ids, waiting or being deleted
    std::array<TurnTimer, thread_count> turns_;
    std::vector<std::jthread> threads_;
};

}  // namespace camdir::dds
