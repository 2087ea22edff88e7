// What the participants of a match have said of its movers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "dds/sender.hpp"
#include "director/messages.hpp"

namespace camdir::dds {

// Keeps it for each sender, because who does not own the match now may own it later. Movers and poses are of
// different topics, so that either may arrive first: each pose frame gets the movers of the newest frame_time
// up to its own. One thread at a time.
class SentMovers {
  public:
    static constexpr std::size_t max_senders = 8;
    static constexpr std::size_t max_waiting = 8;  // mover frames of a sender whose poses are awaited

    [[nodiscard]] bool empty() const { return senders_.empty(); }

    // Returns whether there is a place for `sender`. Where all are taken the one that was longest without a
    // sample leaves, but for the owner's and those of `heirs`, who may own the match.
    bool admit(const SenderId& sender, const SenderId& owner, std::span<const SenderId> heirs = {});
    // Who is not among these is gone.
    void retain(std::span<const SenderId> matched);
    // Of a sender that has been admitted since others were. Not null. A description, whose hulls have no
    // bounds yet, replaces the one that waits, and counts from put_bounded() on.
    void put(const SenderId& sender, std::shared_ptr<director::MoverInfo> described, bool counted_as_dropped);
    void put(const SenderId& sender, std::shared_ptr<const director::MoverFrame> frame);

    // A description waits for its bounds.
    [[nodiscard]] bool has_described() const {
        return std::ranges::any_of(senders_, [](const Sent& sent) { return sent.described != nullptr; });
    }
    enum class Rank { owner, may_own, stranger };
    struct Described {
        SenderId sender;
        std::shared_ptr<director::MoverInfo> info;
        bool counted_as_dropped;
    };
    // The description that is to have bounds next, which waits no longer: the owner's first, and no
    // stranger's.
    template <class RankOf>
    [[nodiscard]] std::optional<Described> take_described(const RankOf& rank_of) {
        for (const Rank rank : {Rank::owner, Rank::may_own})
            for (Sent& sent : senders_)
                if (sent.described && rank_of(sent.sender) == rank)
                    return Described{sent.sender, std::exchange(sent.described, nullptr),
                                     sent.counted_as_dropped};
        return std::nullopt;
    }
    // Nothing when the sender has left meanwhile.
    void put_bounded(const SenderId& sender, std::shared_ptr<const director::MoverInfo> info);

    // The movers of this sender as of a pose frame of its. Null where they are of another epoch, or not
    // complete yet. The same object as before where nothing has changed.
    [[nodiscard]] std::shared_ptr<const director::MatchMovers> at(const SenderId& sender, std::uint64_t epoch,
                                                                  std::int64_t frame_time);

  private:
    using Frame = std::shared_ptr<const director::MoverFrame>;
    struct Sent {
        SenderId sender{};
        std::shared_ptr<director::MoverInfo> described;  // newer than `info`
        bool counted_as_dropped = false;                 // what is described
        std::shared_ptr<const director::MoverInfo> info;
        Frame frame;                 // as of the last poses
        std::vector<Frame> waiting;  // in the order of arrival
        std::shared_ptr<const director::MatchMovers> both;
    };
    [[nodiscard]] Sent* find(const SenderId& sender);

    std::vector<Sent> senders_;  // who has sent last is the last
};

}  // namespace camdir::dds
