// The director's connection to DDS.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "base/log_limit.hpp"
#include "config/config.hpp"
#include "dds/counters.hpp"
#include "dds/match_table.hpp"
#include "dds/participant.hpp"
#include "dds/subscriber.hpp"
#include "director/ports.hpp"

namespace camdir::dds {

// Finds matches, hands what is received to an Ingress and writes what is published:
//
//     auto gateway = Gateway::open(config.dds, config.limits);           // check for an error
//     Director director(config, maps, **gateway);
//     (*gateway)->start(director);
//     ...
//     (*gateway)->stop_receiving();
//     director.drain();
//     (*gateway)->close();
class Gateway final : public director::Publisher {
  public:
    // Joins the domain; nothing is received before start(). One per process, see Participant.
    [[nodiscard]] static Result<std::unique_ptr<Gateway>> open(const config::Dds& config,
                                                               const config::Limits& limits);
    ~Gateway() override;  // stop_receiving() and close()

    // To be called once. `ingress` is called from a thread of the gateway and must live until
    // stop_receiving() returns.
    void start(director::Ingress& ingress) { subscriber_.start(ingress); }
    // False when reception is late by more than `limit`, or removes a match for longer: it has hung.
    // Thread-safe.
    [[nodiscard]] bool responsive(std::chrono::nanoseconds limit) const {
        return subscriber_.responsive(limit);
    }
    // Whether this director leads the match; else it stands by, or does not serve it. Thread-safe.
    [[nodiscard]] bool leads(const std::string& match_id) const;
    struct HandOver {
        std::size_t led = 0;   // matches that this director led
        std::size_t kept = 0;  // of these, for want of another that could serve them
    };
    // Leaves every match to a standby that has cameras, if it has some, and stands by. Thread-safe.
    HandOver hand_over();
    // Takes effect soon: matches of other shards go on here until they do there. Thread-safe.
    void reshard(const config::Dds& config);
    // Nothing more is handed to the ingress. Standbys take over at once; where there is none, publishing
    // still works.
    void stop_receiving();
    // Releases the ownership of every match and waits 100 ms for that to reach the readers. To be called
    // after stop_receiving(); what is published afterwards is lost.
    void close();

    // See director::Publisher. Samples that DDS refuses are counted and logged. A status is published where
    // it is kept to be written: after the next camera frame or, when none comes, within 50 ms; by a standby
    // when it takes over.
    void publish(const director::MatchInfo& shown) override;
    void end(const std::string& match_id) override;
    void publish(const std::string& match_id, const director::CameraFrame& frame) override;
    bool publish(const director::ObserverStatus& status) override;
    void withdraw(const std::string& match_id, const std::string& observer_id) override;
    void forget(const std::string& match_id) override { subscriber_.forget(match_id); }
    void give_up(const std::string& match_id) override { subscriber_.give_up(match_id); }

    // Distinguishes this director's cameras from those of others.
    [[nodiscard]] std::uint64_t director_id() const { return director_id_; }
    // Of DDS Security; none: plain DDS.
    [[nodiscard]] const std::optional<Identity>& identity() const { return participant_.identity(); }
    [[nodiscard]] const WireCounters& counters() const { return counters_; }

  private:
    Gateway(Participant participant, const config::Dds& config, const config::Limits& limits);
    void count(Written written, WireCounter& counter, Topic topic, const std::string& match_id);

    Participant participant_;
    const std::uint64_t director_id_;
    WireCounters counters_;
    LogLimit failure_log_;
    MatchTable table_;
    Subscriber subscriber_;
};

}  // namespace camdir::dds
