// The receiving half of the gateway: one thread that waits for samples, checks them and hands them on.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

#include "config/config.hpp"
#include "dds/counters.hpp"
#include "dds/log_limit.hpp"
#include "dds/match_table.hpp"
#include "dds/participant.hpp"
#include "dds/take_buffer.hpp"
#include "director/ports.hpp"

namespace camdir::dds {

// A match is found by its MatchInfo in the configured partitions. From then on its partition is read, until
// the director has forgotten it and its game server is gone. The thread also asserts the liveliness of the
// camera writers while the receiver is responsive, and repeats a match's statuses when another director has
// gone.
class Reception {
  public:
    struct Terms {
        Leadership leadership;
        std::uint64_t director_id = 0;
        std::vector<std::string> partitions;
    };

    // The references must outlive it.
    Reception(const Participant& participant, Terms terms, MatchTable& table, Counters& counters);
    ~Reception();  // stops

    // Once.
    [[nodiscard]] Result<void> open();
    // Once, after open. `receiver` must live until `stop` returns.
    void start(director::Receiver& receiver);
    // Nothing more is handed on, liveliness is asserted no more.
    void stop();
    // The director has forgotten the match. Thread-safe, returns at once.
    void forget(const std::string& match_id);

  private:
    using Clock = std::chrono::steady_clock;
    struct Match;
    // What the waitset names when a reader has samples.
    struct Source {
        Match* match;
        void (Reception::*take)(Match&);
    };
    struct Match {
        director::MatchInfo info;
        MatchTable::Endpoints endpoints;
        dds_instance_handle_t server = 0;  // the writer of its MatchInfo
        bool has_server = true;            // which is alive
        bool forgotten = false;            // by the director; it is told again when something comes
        Source poses, events, requests, rivals;
        Clock::time_point repeat_until{};  // its statuses are repeated until then
    };

    [[nodiscard]] Result<void> watch(dds_entity_t reader, const void* tag);
    void run() noexcept;
    void take_triggered(std::size_t count);
    void assert_liveliness();
    void repeat_statuses(Clock::time_point now);

    // Counts the sample and logs each reason at most once a second.
    void drop(Topic topic, Defect defect, const std::string& match_id);
    void take_match_infos();
    // Checks a sample of the match and decodes it. False: it is dropped, counted, or the match was refused.
    template <class Sample, class Message>
    [[nodiscard]] bool accept(Match& match, Topic topic, const Sample& sample, Message& message);
    void take_poses(Match& match);
    void take_events(Match& match);
    void take_requests(Match& match);
    void discard_rivals_statuses(Match& match);

    void match_found(const camera_director_MatchInfo& sample, const dds_sample_info_t& info);
    void match_lost(const std::string& match_id, const dds_sample_info_t& info);
    [[nodiscard]] Result<void> add_match(const director::MatchInfo& info);
    void remove_match(const std::string& match_id);
    void remove_forgotten();
    void keep(const std::string& match_id);
    [[nodiscard]] bool known_again(Match& match);
    [[nodiscard]] bool written_in(const dds_sample_info_t& info, const std::string& partition) const;

    const Participant& participant_;
    const Terms terms_;
    MatchTable& table_;
    Counters& counters_;
    std::array<std::array<LogLimit, defect_names.size()>, topic_count> drop_logs_{};
    director::Receiver* receiver_ = nullptr;

    Entity subscriber_;  // of MatchInfo
    dds_entity_t match_info_reader_ = 0;
    Entity waitset_;
    Entity guard_;
    std::atomic<bool> stopping_{false};
    std::mutex forgotten_mutex_;
    std::vector<std::string> forgotten_;
    std::thread thread_;

    // From here on the thread's own.
    std::unordered_map<std::string, std::unique_ptr<Match>> matches_;
    std::vector<dds_attach_t> triggered_;
    TakeBuffer<camera_director_MatchInfo> match_info_samples_;
    TakeBuffer<camera_director_PoseFrame> pose_samples_;
    TakeBuffer<camera_director_MatchEvent> event_samples_;
    TakeBuffer<camera_director_ObserverRequest> request_samples_;
    TakeBuffer<camera_director_ObserverStatus> status_samples_;
    director::PoseFrame pose_frame_;
    director::MatchEvent match_event_;
    director::ObserverRequest observer_request_;
};

}  // namespace camdir::dds
