// The director's connection to the wire.
#pragma once

#include <memory>
#include <string>

#include "config/config.hpp"
#include "dds/counters.hpp"
#include "dds/log_limit.hpp"
#include "dds/match_table.hpp"
#include "dds/participant.hpp"
#include "dds/subscriber.hpp"
#include "director/ports.hpp"

namespace camdir::dds {

// Finds matches, hands what comes in to a Receiver and writes what comes out:
//
//     auto gateway = Gateway::open(config.dds);           // check for an error
//     Director director(config, maps, **gateway);
//     (*gateway)->start(director);
//     ...
//     (*gateway)->stop_receiving();
//     director.drain();
//     (*gateway)->close();
class Gateway final : public director::Wire {
  public:
    // Joins the domain; nothing is received before `start`. One a process, see Participant.
    [[nodiscard]] static Result<std::unique_ptr<Gateway>> open(const config::Dds& config);
    ~Gateway() override;  // stops receiving and closes

    // Once. `receiver` must live until stop_receiving returns. What is received comes on a thread of the
    // gateway.
    void start(director::Receiver& receiver) { reception_.start(receiver); }
    // Nothing more is handed to the receiver. What is published still leaves.
    void stop_receiving() { reception_.stop(); }
    // Gives every match up, so that a standby takes over at once, and waits until that is on the wire. After
    // stop_receiving; what is published afterwards is lost.
    void close();

    // The Wire: see there. A sample that DDS refuses is counted and logged.
    void publish(const std::string& match_id, const director::CameraFrame& frame) override;
    void publish(const director::ObserverStatus& status) override;
    void withdraw(const std::string& match_id, const std::string& observer_id) override;
    void forget(const std::string& match_id) override { reception_.forget(match_id); }

    // Tells this director's cameras from another's.
    [[nodiscard]] std::uint64_t director_id() const { return director_id_; }
    [[nodiscard]] const Counters& counters() const { return counters_; }

  private:
    Gateway(Participant participant, const config::Dds& config);
    void count(dds_return_t written, Counter& counter, Topic topic, const std::string& match_id);

    Participant participant_;
    const std::uint64_t director_id_;
    Counters counters_;
    LogLimit failure_log_;
    MatchTable table_;
    Reception reception_;
};

}  // namespace camdir::dds
