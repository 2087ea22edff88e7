// The receiving half of the gateway: one thread that takes samples, validates them and hands them on.
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

// Finds matches by their MatchInfo in the configured partitions. A match's partition is read until the
// director has forgotten the match and its game server is gone. The thread also asserts the liveliness of the
// writers while the ingress is responsive.
class Subscriber {
  public:
    struct Options {
        Leadership leadership;
        std::uint64_t director_id = 0;
        std::vector<std::string> partitions;
    };

    // The references must outlive the subscriber.
    Subscriber(const Participant& participant, Options options, MatchTable& table, WireCounters& counters);
    ~Subscriber();  // stops

    // To be called once.
    [[nodiscard]] Result<void> open();
    // To be called once, after open(). `ingress` must live until stop() returns.
    void start(director::Ingress& ingress);
    // Ends handing on samples and asserting liveliness.
    void stop();
    // The director has forgotten the match. Thread-safe, returns at once.
    void forget(const std::string& match_id);

  private:
    using Clock = std::chrono::steady_clock;
    struct Match;
    // What the waitset reports when a reader has samples.
    struct Source {
        Match* match;
        void (Subscriber::*take)(Match&);
    };
    struct Match {
        director::MatchInfo info;
        MatchTable::Endpoints endpoints;
        dds_instance_handle_t server = 0;  // the writer of its MatchInfo
        bool has_server = true;            // that writer is alive
        bool forgotten = false;            // by the director; reintroduced when a sample arrives
        Source poses, events, requests;
    };

    [[nodiscard]] Result<void> watch(dds_entity_t reader, const void* tag);
    void run() noexcept;
    void take_triggered(std::size_t count);
    void assert_liveliness();

    // Counts the sample and logs each reason at most once a second.
    void drop(Topic topic, ValidationError error, const std::string& match_id);
    void take_match_infos();
    // Validates and decodes a sample of the match. Returns false when the sample was dropped and counted, or
    // the match was refused.
    template <class Sample, class Message>
    [[nodiscard]] bool accept(Match& match, Topic topic, const Sample& sample, Message& message);
    void take_poses(Match& match);
    void take_events(Match& match);
    void take_requests(Match& match);

    void match_info_found(const camera_director_MatchInfo& sample, const dds_sample_info_t& info);
    void match_info_lost(const std::string& match_id, const dds_sample_info_t& info);
    // Returns false after logging why its endpoints could not be created.
    [[nodiscard]] bool add_match(const std::string& match_id);
    [[nodiscard]] Result<void> open_match(const std::string& match_id);
    void remove_match(const std::string& match_id);
    void remove_forgotten();
    void cancel_forget(const std::string& match_id);
    [[nodiscard]] bool reintroduce(Match& match);
    [[nodiscard]] bool written_in(const dds_sample_info_t& info, const std::string& partition) const;

    const Participant& participant_;
    const Options options_;
    MatchTable& table_;
    WireCounters& counters_;
    std::array<std::array<LogLimit, validation_error_names.size()>, topic_count> drop_logs_{};
    director::Ingress* ingress_ = nullptr;

    Entity match_info_subscriber_;
    dds_entity_t match_info_reader_ = 0;
    Entity waitset_;
    Entity guard_;
    std::atomic<bool> stopping_{false};
    std::mutex forgotten_mutex_;
    std::vector<std::string> forgotten_;
    std::thread thread_;

    // Used by the thread only.
    std::unordered_map<std::string, std::unique_ptr<Match>> matches_;
    std::vector<dds_attach_t> triggered_;
    TakeBuffer<camera_director_MatchInfo> match_info_samples_;
    TakeBuffer<camera_director_PoseFrame> pose_samples_;
    TakeBuffer<camera_director_MatchEvent> event_samples_;
    TakeBuffer<camera_director_ObserverRequest> request_samples_;
    director::PoseFrame pose_frame_;
    director::MatchEvent match_event_;
    director::ObserverRequest observer_request_;
};

}  // namespace camdir::dds
