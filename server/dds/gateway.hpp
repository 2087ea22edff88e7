// The director's connection to DDS.
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

// Finds matches, hands what is received to an Ingress and writes what is published:
//
//     auto gateway = Gateway::open(config.dds);           // check for an error
//     Director director(config, maps, **gateway);
//     (*gateway)->start(director);
//     ...
//     (*gateway)->stop_receiving();
//     director.drain();
//     (*gateway)->close();
class Gateway final : public director::Publisher {
  public:
    // Joins the domain; nothing is received before start(). One per process, see Participant.
    [[nodiscard]] static Result<std::unique_ptr<Gateway>> open(const config::Dds& config);
    ~Gateway() override;  // stop_receiving() and close()

    // To be called once. `ingress` is called from a thread of the gateway and must live until
    // stop_receiving() returns.
    void start(director::Ingress& ingress) { subscriber_.start(ingress); }
    // Nothing more is handed to the ingress. Publishing still works.
    void stop_receiving() { subscriber_.stop(); }
    // Releases the ownership of every match, so that a standby takes over at once, and waits 100 ms for that
    // to reach the readers. To be called after stop_receiving(); what is published afterwards is lost.
    void close();

    // See director::Publisher. Samples that DDS refuses are counted and logged.
    void publish(const director::MatchInfo& shown) override;
    void end(const std::string& match_id) override;
    void publish(const std::string& match_id, const director::CameraFrame& frame) override;
    void publish(const director::ObserverStatus& status) override;
    void withdraw(const std::string& match_id, const std::string& observer_id) override;
    void forget(const std::string& match_id) override { subscriber_.forget(match_id); }

    // Distinguishes this director's cameras from those of others.
    [[nodiscard]] std::uint64_t director_id() const { return director_id_; }
    [[nodiscard]] const WireCounters& counters() const { return counters_; }

  private:
    Gateway(Participant participant, const config::Dds& config);
    void count(dds_return_t written, WireCounter& counter, Topic topic, const std::string& match_id);

    Participant participant_;
    const std::uint64_t director_id_;
    WireCounters counters_;
    LogLimit failure_log_;
    MatchTable table_;
    Subscriber subscriber_;
};

}  // namespace camdir::dds
