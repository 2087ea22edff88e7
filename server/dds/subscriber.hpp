// The receiving half of the gateway: one thread that takes samples, validates them and hands them on.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

#include "base/log_limit.hpp"
#include "config/config.hpp"
#include "dds/admission.hpp"
#include "dds/counters.hpp"
#include "dds/endpoint_removal.hpp"
#include "dds/match_table.hpp"
#include "dds/ownership.hpp"
#include "dds/participant.hpp"
#include "dds/ready_list.hpp"
#include "dds/request_owners.hpp"
#include "dds/sender.hpp"
#include "dds/sent_movers.hpp"
#include "dds/shards.hpp"
#include "dds/take_buffer.hpp"
#include "dds/turn_queue.hpp"
#include "director/ports.hpp"

namespace camdir::dds {

// Finds matches by their MatchInfo in the configured partitions. A match's partition is read until the
// director has forgotten the match and its game server is gone. Of all participants that send for a match,
// the owner alone is heard (ownership.hpp), and of an observer's requests those of its writer. The thread
// also asserts the liveliness of the writers while the ingress is responsive, and takes over matches from
// directors that do not.
class Subscriber final : private Admission::Host {
  public:
    struct Options {
        Leadership leadership;
        std::uint64_t director_id = 0;
        std::vector<std::string> partitions;
        Shards shards;
        Admission::Limits limits;
        std::size_t participant_observers = 0;  // of a match
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
    // The following are thread-safe and return at once. The director has forgotten the match.
    void forget(const std::string& match_id);
    // The director has ended the match, but not forgotten it.
    void give_up(const std::string& match_id);
    // Matches of other shards go on here until they do there.
    void reshard(Shards shards);

    // False when the thread is late by more than `limit` with what it does several times per lease, or the
    // end of a match takes longer. Thread-safe.
    [[nodiscard]] bool responsive(std::chrono::nanoseconds limit) const;

  private:
    using Clock = std::chrono::steady_clock;
    struct Match;
    // What is to be done when a reader of the match has reported.
    struct Source : ReadyList::Source {
        Source(Match& of, void (Subscriber::*with)(Match&)) : match(of), take(with) {}
        Match& match;
        void (Subscriber::*take)(Match&);
    };
    // By the director. What is forgotten, or was refused at once, is introduced again when a pose, an event
    // or a request arrives; what has ended there or was given up, and may have observers still, when its game
    // server sends.
    enum class Service { served, given_up, forgotten };
    struct Match {
        explicit Match(std::size_t participant_observers) : request_owners(participant_observers) {}
        [[nodiscard]] const std::string& id() const { return endpoints->match_id(); }

        MatchTable::Endpoints endpoints;
        Ownership ownership;
        RequestOwners request_owners;
        Service service = Service::served;
        Clock::time_point next_introduction{};  // after a refusal, but for another description
        bool is_of_shard = true;
        SenderLookup pose_senders, event_senders, mover_info_senders, mover_frame_senders;
        SentMovers movers;
        Source poses{*this, &Subscriber::take_poses};
        Source mover_infos{*this, &Subscriber::take_mover_infos};
        Source mover_frames{*this, &Subscriber::take_mover_frames};
        Source mover_info_writers{*this, &Subscriber::notice_unmatched_movers};
        Source mover_frame_writers{*this, &Subscriber::notice_unmatched_movers};
        Source events{*this, &Subscriber::take_events};
        Source requests{*this, &Subscriber::take_requests};
        Source requesters{*this, &Subscriber::notice_unmatched_requests};
        Source cameras{*this, &Subscriber::take_cameras};
        Source signs{*this, &Subscriber::take_signs};
    };

    void run() noexcept;
    void notice_absence();
    void take_ready(const std::vector<ReadyList::Source*>& ready);
    [[nodiscard]] std::chrono::milliseconds assertion_interval() const {
        return options_.leadership.lease / Succession::beats;
    }
    // Of what begins or changes hands: so long that neither assertions nor poses are late.
    [[nodiscard]] std::chrono::milliseconds longest_turn() const {
        return std::min(assertion_interval() / 2, std::chrono::milliseconds(25));
    }
    void assert_liveliness();
    void decide();
    void notice_what_is_owed();
    void notice_what_is_owed(Match& match);
    void catch_up();

    // Counts the sample and logs each reason at most once a second.
    void drop(Topic topic, ValidationError error, const std::string& match_id);
    void take_match_infos();
    // Takes what has arrived. What is too much at once is ready again.
    template <class Sample, class Visit>
    void take(TakeBuffer<Sample>& buffer, dds_entity_t reader, ReadyList::Source& source, Visit visit);
    // Validates and decodes a sample of the match. Returns false when the sample was dropped and counted.
    template <class Sample, class Message>
    [[nodiscard]] bool is_valid(const Match& match, Topic topic, const Sample& sample, Message& message);
    // The sample counts, and may introduce the match again: false when that was refused.
    [[nodiscard]] bool accept(Match& match, Topic topic);
    // A valid pose frame of the participant that owns the match, or may take it now.
    [[nodiscard]] bool is_of_owner(Match& match, const dds_sample_info_t& info);
    // Keeps them until they are handed on together.
    void take_poses(Match& match);
    void hand_on_poses();
    void take_waiting_poses();
    void take_mover_infos(Match& match);
    void take_mover_frames(Match& match);
    void ask_for_bounds(Match& match);
    void ask_again_for_bounds();
    void bound_movers();
    bool bound_next(Match& match);
    // The sender owns the match; else its sample counts as dropped.
    [[nodiscard]] bool comes_from_owner(const Match& match, Topic topic, const SenderId* sender);
    void notice_unmatched_movers(Match& match);
    void take_events(Match& match);
    void take_requests(Match& match);
    void request_found(Match& match, WriterHandle writer);
    void request_lost(Match& match, const std::string& observer_id, const dds_sample_info_t& info);
    void pass_on(Match& match, const director::ObserverRequest& request);
    void put_into_effect(const RequestOwners::Outcome& outcome, Match& match);
    void notice_unmatched_requests(Match& match);
    void take_cameras(Match& match);
    void take_signs(Match& match);
    void take_signs_of_new_matches();
    void warn_of_namesake(const std::string& match_id);

    void match_info_found(const camera_director_MatchInfo& sample, const dds_sample_info_t& info);
    void match_info_lost(const camera_director_MatchInfo& key, const dds_sample_info_t& info);
    // Of a match that may be new. Returns false where the description waits.
    bool described(Ownership::Claim claim);
    void admit_waiting();
    void notice_unmatched();
    void put_into_effect(Ownership::Change change, const std::string& match_id);
    void begin_anew(Match& match);
    [[nodiscard]] std::size_t owned_by(const SenderId& participant) const override;
    [[nodiscard]] bool has_room_for(const std::string& match_id) const override;
    [[nodiscard]] bool admits(const std::string& match_id) override;
    void refuse(const std::string& match_id, ValidationError limit) override;
    // Returns false after logging why its endpoints could not be created.
    [[nodiscard]] bool add_match(const std::string& match_id);
    [[nodiscard]] Result<void> open_match(const std::string& match_id);
    [[nodiscard]] Result<void> watch(Match& match);
    void unwatch(Match& match);
    void remove_match(const std::string& match_id);
    void remove_forgotten();
    void mark_given_up();
    void put_new_shards_into_effect();
    // Hands over matches of other shards, and leaves those that a director of theirs leads.
    void leave_matches();
    void leave(const std::string& match_id);
    // Returns false when the director refuses the match.
    bool introduce(Match& match);
    void cancel_forget(const std::string& match_id);

    const Participant& participant_;
    const Options options_;
    MatchTable& table_;
    WireCounters& counters_;
    std::array<std::array<LogLimit, validation_error_names.size()>, topic_count> drop_logs_{};
    LogLimit namesake_log_;
    director::Ingress* ingress_ = nullptr;

    ReadyList ready_;
    ReadyList::Source match_infos_, matched_;
    Entity match_info_subscriber_;
    dds_entity_t match_info_reader_ = 0;
    std::atomic<bool> stopping_{false};
    std::mutex mutex_;  // guards the next three
    std::vector<std::string> forgotten_;
    std::vector<std::string> given_up_;
    std::optional<Shards> new_shards_;
    std::atomic<Clock::time_point> next_assertion_{Clock::time_point::max()};  // max: the thread does not run
    std::thread thread_;

    // Used by the thread only.
    Admission admission_;
    EndpointRemoval removal_;
    std::unordered_map<std::string, std::unique_ptr<Match>> matches_;
    std::vector<std::string> new_matches_;  // whose signs were not looked at yet
    Clock::time_point poses_taken_{};       // of all matches
    TurnQueue to_bound_;                    // matches with movers without bounds
    TurnQueue to_catch_up_;                 // matches that owe something
    Clock::time_point next_notice_{};
    Clock::time_point listened_{};                                // to all who send
    Clock::time_point next_decision_ = Clock::time_point::max();  // when matches may change hands
    std::string next_to_decide_;                                  // the match, or any
    TakeBuffer<camera_director_MatchInfo> match_info_sample_;
    TakeBuffer<camera_director_PoseFrame> pose_samples_;
    TakeBuffer<camera_director_MoverInfo> mover_info_samples_;
    TakeBuffer<camera_director_MoverFrame> mover_frame_samples_;
    TakeBuffer<camera_director_MatchEvent> event_samples_;
    TakeBuffer<camera_director_ObserverRequest> request_samples_;
    TakeBuffer<camera_director_CameraFrame> camera_samples_;
    TakeBuffer<camera_director_DirectorSign> sign_samples_;
    director::PoseFrame pose_frame_;
    std::vector<director::PoseArrival> arrivals_;  // the first arrived_; the rest is memory for more
    std::size_t arrived_ = 0;
    director::MatchEvent match_event_;
    director::ObserverRequest observer_request_;
    director::CameraFrame shown_;
};

}  // namespace camdir::dds
