// Whose the requests of a match's observers are.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "dds/sender.hpp"
#include "director/messages.hpp"

namespace camdir::dds {

// The request of an observer id belongs to the writer that was the first to write one, until that one
// disposes it or is gone. Of the others the newest request waits for that. One thread at a time.
class RequestOwners {
  public:
    // No participant has more than `max_of_sender` observers.
    explicit RequestOwners(std::size_t max_of_sender) : max_of_sender_(max_of_sender) {}

    enum class Standing {
        owner,     // the request counts
        stranger,  // it is another writer's, and waits
        refused    // its sender has too many observers
    };
    [[nodiscard]] Standing put(const director::ObserverRequest& request, WriterHandle writer,
                               const SenderId& sender);

    // What becomes of an observer whose owner has gone.
    struct Outcome {
        std::string observer_id;
        std::optional<director::ObserverRequest> next;  // empty: there is no request any more
    };
    // The request was disposed by this writer. `certain`: see Ownership::dispose(). Nothing when it is
    // another's.
    [[nodiscard]] std::optional<Outcome> dispose(const std::string& observer_id, WriterHandle writer,
                                                 bool certain);
    // The liveliness of all who wrote it is lost.
    [[nodiscard]] std::optional<Outcome> lose(const std::string& observer_id);
    // Writers that are not among these (ascending) are gone.
    [[nodiscard]] std::vector<Outcome> retain(std::span<const WriterHandle> matched);

    [[nodiscard]] std::vector<std::string> observers() const;

  private:
    struct Waiting {
        WriterHandle writer;
        SenderId sender;
        director::ObserverRequest request;
    };
    struct Owner {
        WriterHandle writer;
        SenderId sender;
        bool contested = false;  // another has written or disposed it
        std::optional<Waiting> waiting = {};
    };
    using Owners = std::unordered_map<std::string, Owner>;

    [[nodiscard]] Outcome end(Owners::iterator owner);

    void drop_waiting(Owner& owner);
    void release(const SenderId& sender);

    const std::size_t max_of_sender_;
    Owners owners_;                           // by observer id
    std::map<SenderId, std::size_t> counts_;  // of observers, those that wait included
};

}  // namespace camdir::dds
