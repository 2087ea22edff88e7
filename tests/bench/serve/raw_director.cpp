// raw-director: what answers poses with cameras at the least cost that DDS allows, as a yardstick for the
// director.
//
// It accepts every request, and writes one camera for each player that is asked for, at the player's eye.
#include <camera_director.h>

#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <csignal>
#include <cstring>
#include <iostream>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "idl/topics.hpp"

namespace camdir::bench {
namespace {

using wire::Topic;

volatile std::sig_atomic_t interrupted = 0;

dds_entity_t created(dds_entity_t entity) {
    if (entity < 0) throw std::runtime_error(dds_strretcode(entity));
    return entity;
}

dds_entity_t topic(dds_entity_t participant, Topic which) {
    return created(
        dds_create_topic(participant, &wire::topic_type(which), wire::topic_name(which), nullptr, nullptr));
}

wire::Qos partition(const std::string& name) {
    wire::Qos qos(dds_create_qos());
    const char* const names[] = {name.c_str()};
    dds_qset_partition(qos.get(), 1, const_cast<const char**>(names));
    return qos;
}

template <class Element, class Sequence>
void borrow(std::vector<Element>& storage, Sequence& sequence) {
    sequence._buffer = storage.data();
    sequence._length = sequence._maximum = static_cast<std::uint32_t>(storage.size());
    sequence._release = false;
}

// One match's writers and the sample that it writes.
class RawMatch {
  public:
    RawMatch(dds_entity_t participant, const std::string& match_id) {
        publisher_ = created(
            dds_create_publisher(participant, partition(wire::match_partition(match_id)).get(), nullptr));
        cameras_ = writer(participant, Topic::camera_frame);
        statuses_ = writer(participant, Topic::observer_status);
        std::strncpy(sample_.match_id, match_id.c_str(), sizeof sample_.match_id - 1);
    }

    // Answered with the next poses, which tell the epoch.
    void accept(const camera_director_ObserverRequest& request) {
        shots_.insert(request.target);
        camera_director_ObserverStatus& status = answers_.emplace_back();
        std::memcpy(status.observer_id, request.observer_id, sizeof status.observer_id);
        status.state = 1;
        status.camera_id = request.target + 1;
        is_answered_ = false;
    }

    void answer(const camera_director_PoseFrame& poses) {
        if (!std::exchange(is_answered_, true)) write_answers(poses.epoch);
        clear();
        for (std::uint32_t i = 0; i < poses.player_id._length; ++i)
            if (shots_.contains(poses.player_id._buffer[i])) add(poses, i);
        if (camera_id_.empty()) return;
        sample_.epoch = poses.epoch;
        sample_.pose_number = poses.frame_number;
        sample_.frame_time = poses.frame_time;
        sample_.source_time = poses.source_time;
        sample_.write_time = std::chrono::duration_cast<std::chrono::nanoseconds>(
                                 std::chrono::system_clock::now().time_since_epoch())
                                 .count();
        sample_.director_id = 1;
        borrow(camera_id_, sample_.camera_id);
        borrow(target_, sample_.target);
        borrow(position_, sample_.position);
        borrow(orientation_, sample_.orientation);
        borrow(one_, sample_.vertical_fov);
        borrow(one_, sample_.clearance);
        borrow(flags_, sample_.flags);
        dds_write(cameras_, &sample_);
        ++sample_.frame_number;
    }

  private:
    dds_entity_t writer(dds_entity_t participant, Topic which) const {
        const wire::Qos qos = wire::topic_qos(which, DDS_MSECS(100));
        return created(dds_create_writer(publisher_, topic(participant, which), qos.get(), nullptr));
    }
    // All in one bucket.
    void write_answers(std::uint64_t epoch) {
        for (camera_director_ObserverStatus& status : answers_)
            status.epoch = epoch;
        camera_director_ObserverStatusBucket sample{};
        std::memcpy(sample.match_id, sample_.match_id, sizeof sample.match_id);
        borrow(answers_, sample.statuses);
        dds_write(statuses_, &sample);
    }
    void clear() {
        camera_id_.clear();
        target_.clear();
        position_.clear();
        orientation_.clear();
        one_.clear();
        flags_.clear();
    }
    void add(const camera_director_PoseFrame& poses, std::uint32_t i) {
        camera_id_.push_back(poses.player_id._buffer[i] + 1);
        target_.push_back(poses.player_id._buffer[i]);
        const float* eye = poses.eye._buffer + 3 * i;
        position_.insert(position_.end(), eye, eye + 3);
        const float* orientation = poses.orientation._buffer + 4 * i;
        orientation_.insert(orientation_.end(), orientation, orientation + 4);
        one_.push_back(1.0F);
        flags_.push_back(0);
    }

    dds_entity_t publisher_, cameras_, statuses_;
    std::set<std::uint32_t> shots_;
    std::vector<camera_director_ObserverStatus> answers_;
    bool is_answered_ = true;
    camera_director_CameraFrame sample_{};
    std::vector<std::uint32_t> camera_id_, target_, flags_;
    std::vector<float> position_, orientation_, one_;
};

class RawDirector {
  public:
    explicit RawDirector(dds_domainid_t domain) {
        const std::string xml =
            "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"lo\"/></Interfaces>"
            "<AllowMulticast>false</AllowMulticast><MaxMessageSize>65500B</MaxMessageSize></General>"
            "<Discovery><ParticipantIndex>0</ParticipantIndex><SPDPInterval>1s</SPDPInterval></Discovery>"
            "<Internal><SocketReceiveBufferSize max=\"4MB\"/></Internal></Domain></CycloneDDS>";
        created(dds_create_domain(domain, xml.c_str()));
        participant_ = created(dds_create_participant(domain, nullptr, nullptr));
        subscriber_ = created(dds_create_subscriber(participant_, partition("match/*").get(), nullptr));
        poses_ = reader(Topic::pose_frame);
        requests_ = reader(Topic::observer_request);
        waitset_ = created(dds_create_waitset(participant_));
        for (const dds_entity_t reader : {poses_, requests_})
            dds_waitset_attach(waitset_, created(dds_create_readcondition(reader, DDS_ANY_STATE)), reader);
    }
    ~RawDirector() { dds_delete(DDS_CYCLONEDDS_HANDLE); }
    RawDirector(const RawDirector&) = delete;
    RawDirector& operator=(const RawDirector&) = delete;

    void run() {
        std::array<dds_attach_t, 2> triggered{};
        while (interrupted == 0) {
            dds_waitset_wait(waitset_, triggered.data(), triggered.size(), DDS_MSECS(100));
            take<camera_director_ObserverRequest>(
                requests_, [](RawMatch& match, const auto& request) { match.accept(request); });
            take<camera_director_PoseFrame>(poses_,
                                            [](RawMatch& match, const auto& poses) { match.answer(poses); });
        }
    }

  private:
    dds_entity_t reader(Topic which) const {
        const wire::Qos qos = wire::topic_qos(which, DDS_MSECS(100));
        return created(dds_create_reader(subscriber_, topic(participant_, which), qos.get(), nullptr));
    }

    template <class Sample, class Use>
    void take(dds_entity_t reader, const Use& use) {
        std::array<void*, 32> samples{};
        std::array<dds_sample_info_t, 32> infos{};
        const dds_return_t count =
            dds_take(reader, samples.data(), infos.data(), samples.size(), samples.size());
        for (dds_return_t i = 0; i < count; ++i) {
            if (!infos[i].valid_data) continue;
            const auto& sample = *static_cast<const Sample*>(samples[i]);
            use(matches_.try_emplace(sample.match_id, participant_, sample.match_id).first->second, sample);
        }
        if (count > 0) dds_return_loan(reader, samples.data(), count);
    }

    dds_entity_t participant_, subscriber_, poses_, requests_, waitset_;
    std::map<std::string, RawMatch> matches_;
};

}  // namespace
}  // namespace camdir::bench

int main(int argc, char** argv) {
    CLI::App app("Answers poses with cameras at the least cost that DDS allows.", "raw-director");
    std::uint32_t domain = 0;
    app.add_option("--domain", domain, "DDS domain")->check(CLI::Range(0, 230));
    CLI11_PARSE(app, argc, argv);
    for (const int number : {SIGINT, SIGTERM})
        std::signal(number, [](int) { camdir::bench::interrupted = 1; });
    try {
        camdir::bench::RawDirector(domain).run();
    } catch (const std::exception& error) {
        std::cerr << "raw-director: " << error.what() << '\n';
        return 1;
    }
}
