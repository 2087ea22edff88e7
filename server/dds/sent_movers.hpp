// What the participants of a match have said of its movers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dds/decode.hpp"
#include "dds/ownership.hpp"
#include "dds/qos.hpp"
#include "director/messages.hpp"

namespace camdir::dds {

// Keeps it for each sender, because who does not own the match now may own it later. Movers and poses are of
// different topics, so that either may arrive first: each pose frame gets the movers of the newest frame_time
// up to its own. One thread at a time.
class SentMovers {
  public:
    static constexpr std::size_t max_senders = 8;
    // Mover frames of a sender whose poses are awaited: all that come to be read before these.
    static constexpr std::size_t max_waiting = kept_until_taken;

    [[nodiscard]] bool empty() const { return senders_.empty(); }

    // `sender` has written by `writer`. Returns whether there is a place for it. Where all are taken the one
    // that was longest without a sample leaves, but for those who own the match or may own it.
    [[nodiscard]] bool admit(const SenderId& sender, WriterHandle writer, const Ownership& ownership);
    // Who has no writer among these (ascending) is gone.
    void retain(std::span<const WriterHandle> matched);
    // Of a sender that has been admitted since others were. Not null. A description, whose hulls have no
    // bounds yet, replaces the one that waits for them, and is in effect when all have theirs.
    void put(const SenderId& sender, std::shared_ptr<director::MoverInfo> described, bool counted_as_dropped);
    void put(const SenderId& sender, std::shared_ptr<const director::MoverFrame> frame);

    // Some hulls have no bounds yet.
    [[nodiscard]] bool has_unbounded() const {
        return bounding_ ||
               std::ranges::any_of(senders_, [](const Sent& sent) { return sent.described != nullptr; });
    }
    // Of a description that is complete or wrong now, and was not counted before.
    struct Step {
        bool is_accepted = false;
        std::optional<ValidationError> error;
    };
    // Finds the bounds of one more hull, in up to 1 ms: of the owner's description first, then of those who
    // may own the match. Returns nothing where there is no hull but of strangers, which wait.
    [[nodiscard]] std::optional<Step> bound_next(const Ownership& ownership);

    // The movers of this sender as of a pose frame of its. Null where they are of another epoch, or not
    // complete yet. The same object as before where nothing has changed.
    [[nodiscard]] std::shared_ptr<const director::MatchMovers> at(const SenderId& sender, std::uint64_t epoch,
                                                                  std::int64_t frame_time);

  private:
    using Frame = std::shared_ptr<const director::MoverFrame>;
    struct Sent {
        SenderId sender{};
        std::vector<WriterHandle> writers;
        std::shared_ptr<director::MoverInfo> described;  // newer than `info`
        bool counted_as_dropped = false;                 // what is described
        std::shared_ptr<const director::MoverInfo> info;
        Frame frame;                 // as of the last poses
        std::vector<Frame> waiting;  // in the order of arrival
        std::shared_ptr<const director::MatchMovers> both;
    };
    struct Described {
        SenderId sender;
        std::shared_ptr<director::MoverInfo> info;
        bool counted_as_dropped;
    };
    [[nodiscard]] Sent* find(const SenderId& sender);
    [[nodiscard]] std::optional<Described> take_described(const Ownership& ownership);
    void put_bounded(const Described& described);

    std::vector<Sent> senders_;          // who has sent last is the last
    std::optional<Described> bounding_;  // some hulls have bounds
};

}  // namespace camdir::dds
