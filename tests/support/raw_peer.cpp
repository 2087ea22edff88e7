#include "support/raw_peer.hpp"

#include <algorithm>
#include <cstring>
#include <set>
#include <stdexcept>

namespace camdir::test {
namespace {

void check(dds_return_t code, const char* doing) {
    if (code < 0) throw std::runtime_error(std::string(doing) + ": " + dds_strretcode(code));
}

template <class Sequence, class Value>
void point(Sequence& sequence, std::vector<Value>& values) {
    sequence._buffer = values.data();
    sequence._length = sequence._maximum = static_cast<std::uint32_t>(values.size());
}

template <std::size_t Size>
void copy(char (&to)[Size], const std::string& from) {
    if (from.size() >= Size) throw std::runtime_error("too long for the wire: " + from);
    std::memcpy(to, from.c_str(), from.size() + 1);
}

void join(dds_qos_t* qos, const std::vector<std::string>& partitions) {
    std::vector<const char*> names;
    for (const std::string& partition : partitions)
        names.push_back(partition.c_str());
    dds_qset_partition(qos, static_cast<std::uint32_t>(names.size()), names.data());
}

dds_qos_t* reliable() {
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
    return qos;
}

dds_qos_t* newest_for_late_joiners() {
    dds_qos_t* qos = reliable();
    dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
    return qos;
}

dds_qos_t* match_info_qos() {
    dds_qos_t* qos = newest_for_late_joiners();
    dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(2));
    dds_qset_writer_data_lifecycle(qos, false);
    return qos;
}

dds_qos_t* pose_frame_qos() {
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_BEST_EFFORT, 0);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
    return qos;
}

dds_qos_t* match_event_qos() {
    dds_qos_t* qos = reliable();
    dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
    dds_qset_resource_limits(qos, 256, DDS_LENGTH_UNLIMITED, 256);
    return qos;
}

dds_qos_t* observer_request_qos() {
    dds_qos_t* qos = newest_for_late_joiners();
    dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(10));
    return qos;
}

dds_qos_t* camera_frame_qos() {
    dds_qos_t* qos = reliable();
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 32);
    dds_qset_ownership(qos, DDS_OWNERSHIP_EXCLUSIVE);
    dds_qset_liveliness(qos, DDS_LIVELINESS_MANUAL_BY_TOPIC, DDS_INFINITY);
    return qos;
}

dds_qos_t* shown_camera_qos() {
    dds_qos_t* qos = camera_frame_qos();
    dds_qset_ownership_strength(qos, 3 * 65536);
    return qos;
}

dds_qos_t* answer_qos() {
    dds_qos_t* qos = newest_for_late_joiners();
    dds_qset_ownership(qos, DDS_OWNERSHIP_EXCLUSIVE);
    return qos;
}

constexpr const char* loopback_xml =
    "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"lo\"/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast><MaxMessageSize>65500B</MaxMessageSize></General>"
    "<Discovery><ParticipantIndex>none</ParticipantIndex><SPDPInterval>1s</SPDPInterval>"
    "<Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery></Domain></CycloneDDS>";

RawPeer::CameraFrame copied(const camera_director_CameraFrame& sample) {
    RawPeer::CameraFrame frame{sample.match_id,     sample.epoch,       sample.director_id,
                               sample.frame_number, sample.pose_number, sample.frame_time,
                               sample.source_time,  sample.write_time,  {}};
    const std::uint32_t count = sample.camera_id._length;
    if (sample.target._length != count || sample.position._length != 3 * count ||
        sample.orientation._length != 4 * count || sample.vertical_fov._length != count ||
        sample.clearance._length != count || sample.flags._length != count) {
        throw std::runtime_error("a CameraFrame whose arrays disagree");
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        RawPeer::Camera camera{};
        camera.id = sample.camera_id._buffer[i];
        camera.target = sample.target._buffer[i];
        camera.flags = sample.flags._buffer[i];
        std::memcpy(camera.position, &sample.position._buffer[3 * i], sizeof camera.position);
        std::memcpy(camera.orientation, &sample.orientation._buffer[4 * i], sizeof camera.orientation);
        camera.vertical_fov = sample.vertical_fov._buffer[i];
        camera.clearance = sample.clearance._buffer[i];
        frame.cameras.push_back(camera);
    }
    return frame;
}

}  // namespace

RawPeer::RawPeer(std::uint32_t domain, const std::string& match_id, std::vector<std::string> partitions)
    : partitions_(std::move(partitions)) {
    if (partitions_.empty()) partitions_.push_back("match/" + match_id);
    const dds_entity_t created = dds_create_domain(domain, loopback_xml);
    if (created != DDS_RETCODE_PRECONDITION_NOT_MET) check(created, "joining the domain");
    participant_ = dds_create_participant(domain, nullptr, nullptr);
    check(participant_, "creating a participant");
    match_info_ = add_writer(camera_director_MatchInfo_desc, "MatchInfo", match_info_qos());
    pose_frame_ = add_writer(camera_director_PoseFrame_desc, "PoseFrame", pose_frame_qos());
    match_event_ = add_writer(camera_director_MatchEvent_desc, "MatchEvent", match_event_qos());
    mover_info_ = add_writer(camera_director_MoverInfo_desc, "MoverInfo", newest_for_late_joiners());
    mover_frame_ = add_writer(camera_director_MoverFrame_desc, "MoverFrame", newest_for_late_joiners());
    observer_request_ =
        add_writer(camera_director_ObserverRequest_desc, "ObserverRequest", observer_request_qos());
    sign_ = add_writer(camera_director_DirectorSign_desc, "DirectorSign", newest_for_late_joiners());
    camera_frame_ = add_reader(camera_director_CameraFrame_desc, "CameraFrame", camera_frame_qos());
    observer_status_ = add_reader(camera_director_ObserverStatusBucket_desc, "ObserverStatus", answer_qos());
    shown_match_ = add_reader(camera_director_ShownMatch_desc, "ShownMatch", answer_qos());
}

RawPeer::~RawPeer() {
    dds_delete(participant_);
}

dds_entity_t RawPeer::add_writer(const dds_topic_descriptor_t& type, const char* topic, dds_qos_t* qos) {
    join(qos, partitions_);
    const dds_entity_t handle = dds_create_topic(participant_, &type, topic, nullptr, nullptr);
    check(handle, "creating a topic");
    const dds_entity_t writer = dds_create_writer(participant_, handle, qos, nullptr);
    dds_delete_qos(qos);
    check(writer, "creating a writer");
    return writer;
}

dds_entity_t RawPeer::add_reader(const dds_topic_descriptor_t& type, const char* topic, dds_qos_t* qos) {
    join(qos, partitions_);
    const dds_entity_t handle = dds_create_topic(participant_, &type, topic, nullptr, nullptr);
    check(handle, "creating a topic");
    const dds_entity_t reader = dds_create_reader(participant_, handle, qos, nullptr);
    dds_delete_qos(qos);
    check(reader, "creating a reader");
    return reader;
}

void RawPeer::write(const camera_director_MatchInfo& sample) {
    check(dds_write(match_info_, &sample), "writing a MatchInfo");
}
void RawPeer::write(const camera_director_PoseFrame& sample) {
    check(dds_write(pose_frame_, &sample), "writing a PoseFrame");
}
void RawPeer::write(const camera_director_MatchEvent& sample) {
    check(dds_write(match_event_, &sample), "writing a MatchEvent");
}
void RawPeer::write(const camera_director_MoverInfo& sample) {
    check(dds_write(mover_info_, &sample), "writing a MoverInfo");
}
void RawPeer::write(const camera_director_MoverFrame& sample) {
    check(dds_write(mover_frame_, &sample), "writing a MoverFrame");
}
void RawPeer::write(const camera_director_ObserverRequest& sample) {
    check(dds_write(observer_request_, &sample), "writing an ObserverRequest");
}
void RawPeer::write(const camera_director_DirectorSign& sample) {
    check(dds_write(sign_, &sample), "writing a DirectorSign");
}

void RawPeer::write(const camera_director_CameraFrame& sample) {
    if (shown_camera_ == 0)
        shown_camera_ = add_writer(camera_director_CameraFrame_desc, "CameraFrame", shown_camera_qos());
    check(dds_write(shown_camera_, &sample), "writing a CameraFrame");
}
void RawPeer::dispose(const camera_director_MatchInfo& key) {
    check(dds_dispose(match_info_, &key), "disposing MatchInfo");
}
void RawPeer::dispose(const camera_director_ObserverRequest& key) {
    check(dds_dispose(observer_request_, &key), "disposing ObserverRequest");
}

std::vector<RawPeer::CameraFrame> RawPeer::take_cameras() {
    std::vector<CameraFrame> frames;
    void* samples[32] = {};
    dds_sample_info_t infos[32];
    const dds_return_t count = dds_take(camera_frame_, samples, infos, 32, 32);
    check(count, "taking CameraFrames");
    for (dds_return_t i = 0; i < count; ++i) {
        if (!infos[i].valid_data) continue;
        frames.push_back(copied(*static_cast<const camera_director_CameraFrame*>(samples[i])));
    }
    if (count > 0) dds_return_loan(camera_frame_, samples, count);
    return frames;
}

const std::map<std::string, camera_director_ObserverStatus>& RawPeer::statuses() {
    void* taken = nullptr;
    dds_sample_info_t info;
    while (dds_take(observer_status_, &taken, &info, 1, 1) > 0) {
        const auto& sample = *static_cast<const camera_director_ObserverStatusBucket*>(taken);
        std::erase_if(statuses_, [&](const auto& status) { return buckets_[status.first] == sample.bucket; });
        const bool is_alive = info.valid_data && info.instance_state == DDS_ALIVE_INSTANCE_STATE;
        for (std::uint32_t i = 0; is_alive && i < sample.statuses._length; ++i) {
            const camera_director_ObserverStatus& status = sample.statuses._buffer[i];
            statuses_[status.observer_id] = status;
            buckets_[status.observer_id] = sample.bucket;
        }
        dds_return_loan(observer_status_, &taken, 1);
    }
    return statuses_;
}

std::vector<std::optional<std::uint64_t>> RawPeer::take_shown_epochs() {
    std::vector<std::optional<std::uint64_t>> epochs;
    void* sample = nullptr;
    dds_sample_info_t info;
    while (dds_take(shown_match_, &sample, &info, 1, 1) > 0) {
        if (info.valid_data)
            epochs.emplace_back(static_cast<const camera_director_ShownMatch*>(sample)->epoch);
        if (info.instance_state != DDS_ALIVE_INSTANCE_STATE) epochs.emplace_back(std::nullopt);
        dds_return_loan(shown_match_, &sample, 1);
    }
    return epochs;
}

std::int32_t RawPeer::camera_strength() {
    std::vector<dds_instance_handle_t> writers(16);
    const dds_return_t count = dds_get_matched_publications(camera_frame_, writers.data(), writers.size());
    check(count, "finding the writers of CameraFrame");
    std::int32_t strongest = -1;
    for (dds_return_t i = 0; i < count; ++i) {
        std::int32_t strength = -1;
        auto* writer = dds_get_matched_publication_data(camera_frame_, writers[static_cast<std::size_t>(i)]);
        if (writer == nullptr) continue;
        dds_qget_ownership_strength(writer->qos, &strength);
        dds_builtintopic_free_endpoint(writer);
        strongest = std::max(strongest, strength);
    }
    return strongest;
}

std::uint32_t RawPeer::directors() {
    dds_subscription_matched_status_t status{};
    check(dds_get_subscription_matched_status(camera_frame_, &status), "counting directors");
    return status.current_count;
}

std::size_t RawPeer::served_matches() {
    std::vector<dds_instance_handle_t> writers(directors());
    const dds_return_t count = dds_get_matched_publications(camera_frame_, writers.data(), writers.size());
    check(count, "looking for directors");
    writers.resize(std::min(writers.size(), static_cast<std::size_t>(count)));
    std::set<std::string> partitions;
    for (const dds_instance_handle_t writer : writers) {
        dds_builtintopic_endpoint_t* endpoint = dds_get_matched_publication_data(camera_frame_, writer);
        if (endpoint == nullptr) continue;  // it has just gone
        std::uint32_t names = 0;
        char** name = nullptr;
        dds_qget_partition(endpoint->qos, &names, &name);
        for (std::uint32_t i = 0; i < names; ++i) {
            partitions.insert(name[i]);
            dds_free(name[i]);
        }
        dds_free(name);
        dds_builtintopic_free_endpoint(endpoint);
    }
    return partitions.size();
}

bool RawPeer::signs_are_known() {
    dds_publication_matched_status_t status{};
    check(dds_get_publication_matched_status(sign_, &status), "counting readers of signs");
    return status.current_count > 0 && dds_wait_for_acks(sign_, 0) == DDS_RETCODE_OK;
}

camera_director_MatchInfo raw_match_info(const std::string& match_id, std::uint64_t epoch) {
    static char map_name[] = "test_map";
    camera_director_MatchInfo sample{};
    copy(sample.match_id, match_id);
    sample.epoch = epoch;
    sample.map_name = map_name;
    sample.metres_per_unit = 0.0254F;
    sample.rate_hz = 60.0F;
    return sample;
}

camera_director_ObserverRequest raw_request(const std::string& match_id, const std::string& observer_id,
                                            std::uint32_t target) {
    camera_director_ObserverRequest sample{};
    copy(sample.match_id, match_id);
    copy(sample.observer_id, observer_id);
    sample.target = target;
    return sample;
}

RawPoseFrame::RawPoseFrame(const std::string& match_id, std::uint64_t epoch, std::uint32_t frame_number,
                           std::uint32_t count)
    : flags(count, 1), eye(3 * count, 0.0F), velocity(3 * count, 0.0F) {
    copy(sample_.match_id, match_id);
    sample_.epoch = epoch;
    sample_.frame_number = frame_number;
    sample_.frame_time = std::int64_t{16'000'000} * frame_number;
    for (std::uint32_t i = 0; i < count; ++i) {
        player_id.push_back(i);
        orientation.insert(orientation.end(), {0.0F, 0.0F, 0.0F, 1.0F});
    }
}

const camera_director_PoseFrame& RawPoseFrame::sample() {
    point(sample_.player_id, player_id);
    point(sample_.eye, eye);
    point(sample_.orientation, orientation);
    point(sample_.velocity, velocity);
    point(sample_.flags, flags);
    point(sample_.discontinuities, discontinuities);
    return sample_;
}

RawMoverInfo::RawMoverInfo(const std::string& match_id, std::uint64_t epoch) {
    copy(sample_.match_id, match_id);
    sample_.epoch = epoch;
}

void RawMoverInfo::add_mover(std::uint32_t id, const std::string& name) {
    mover_id.push_back(id);
    copy(reinterpret_cast<char(&)[64]>(model.emplace_back()), name);
    hulls.push_back(0);
    balls.push_back(0);
}

void RawMoverInfo::add_box(const float (&minimum)[3], const float (&maximum)[3]) {
    ++hulls.back();
    half_spaces.push_back(6);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        float up[4] = {0.0F, 0.0F, 0.0F, maximum[axis]};
        float down[4] = {0.0F, 0.0F, 0.0F, -minimum[axis]};
        up[axis] = 1.0F;
        down[axis] = -1.0F;
        planes.insert(planes.end(), up, up + 4);
        planes.insert(planes.end(), down, down + 4);
    }
}

void RawMoverInfo::add_ball(const float (&centre)[3], float radius) {
    ++balls.back();
    spheres.insert(spheres.end(), centre, centre + 3);
    spheres.push_back(radius);
}

const camera_director_MoverInfo& RawMoverInfo::sample() {
    point(sample_.mover_id, mover_id);
    sample_.model._buffer = reinterpret_cast<char(*)[64]>(model.data());
    sample_.model._length = sample_.model._maximum = static_cast<std::uint32_t>(model.size());
    point(sample_.hulls, hulls);
    point(sample_.half_spaces, half_spaces);
    point(sample_.planes, planes);
    point(sample_.balls, balls);
    point(sample_.spheres, spheres);
    return sample_;
}

RawMoverFrame::RawMoverFrame(const std::string& match_id, std::uint64_t epoch, std::int64_t frame_time) {
    copy(sample_.match_id, match_id);
    sample_.epoch = epoch;
    sample_.frame_time = frame_time;
}

void RawMoverFrame::add(std::uint32_t id, const float (&at)[3]) {
    mover_id.push_back(id);
    position.insert(position.end(), at, at + 3);
    orientation.insert(orientation.end(), {0.0F, 0.0F, 0.0F, 1.0F});
}

const camera_director_MoverFrame& RawMoverFrame::sample() {
    point(sample_.mover_id, mover_id);
    point(sample_.position, position);
    point(sample_.orientation, orientation);
    return sample_;
}

}  // namespace camdir::test
