// The requests of a match's observers that wait for its turn.
#pragma once

#include <list>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "director/messages.hpp"

namespace camdir::director {

// What an observer has done since it was taken last.
struct ObserverNews {
    std::string observer_id;
    bool ended = false;                           // the request that was taken before
    std::optional<ObserverRequest> request = {};  // that counts now
};

// Of every observer only what counts now waits, in the order in which the observers came: however often they
// ask and leave, no more waits than there are observers. Nothing is dropped: observers who have left would
// keep their places. One thread at a time.
class RequestQueue {
  public:
    void put(ObserverRequest request);
    void end(const std::string& observer_id);

    [[nodiscard]] bool empty() const { return waiting_.empty(); }
    // Precondition: not empty.
    [[nodiscard]] ObserverNews take();

  private:
    using Place = std::list<ObserverNews>::iterator;

    ObserverNews& news_of(const std::string& observer_id);

    std::list<ObserverNews> waiting_;
    std::unordered_map<std::string, Place> places_;  // by observer id
    std::unordered_set<std::string> taken_;          // observers whose request was taken, and not its end
};

}  // namespace camdir::director
