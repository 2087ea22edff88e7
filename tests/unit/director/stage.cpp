#include "stage.hpp"

#include <cmath>
#include <utility>

#include "camera/camera.hpp"
#include "support/freespace_meshes.hpp"

namespace camdir::director {

void MemoryPublisher::publish(const MatchInfo& shown) {
    const std::lock_guard lock(mutex_);
    shown_[shown.match_id] = shown;
}

void MemoryPublisher::end(const std::string& match_id) {
    const std::lock_guard lock(mutex_);
    shown_.erase(match_id);
}

void MemoryPublisher::publish(const std::string& match_id, const CameraFrame& frame) {
    const std::lock_guard lock(mutex_);
    frames_[match_id].push_back(frame);
}

bool MemoryPublisher::publish(const ObserverStatus& status) {
    const std::lock_guard lock(mutex_);
    statuses_[{status.match_id, status.observer_id}] = status;
    ++statuses_published_;
    return true;
}

void MemoryPublisher::withdraw(const std::string& match_id, const std::string& observer_id) {
    const std::lock_guard lock(mutex_);
    statuses_.erase({match_id, observer_id});
}

void MemoryPublisher::forget(const std::string& match_id) {
    const std::lock_guard lock(mutex_);
    forgotten_.insert(match_id);
}

void MemoryPublisher::give_up(const std::string& match_id) {
    const std::lock_guard lock(mutex_);
    given_up_.insert(match_id);
}

std::optional<MatchInfo> MemoryPublisher::shown(const std::string& match_id) const {
    const std::lock_guard lock(mutex_);
    const auto found = shown_.find(match_id);
    return found == shown_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<CameraFrame> MemoryPublisher::frames(const std::string& match_id) const {
    const std::lock_guard lock(mutex_);
    const auto found = frames_.find(match_id);
    return found == frames_.end() ? std::vector<CameraFrame>{} : found->second;
}

ObserverStatus MemoryPublisher::status(const std::string& observer_id, const std::string& match_id) const {
    const std::lock_guard lock(mutex_);
    const auto found = statuses_.find({match_id, observer_id});
    ObserverStatus none;
    none.reason = "none";
    return found == statuses_.end() ? none : found->second;
}

std::size_t MemoryPublisher::statuses_published() const {
    const std::lock_guard lock(mutex_);
    return statuses_published_;
}

bool MemoryPublisher::has_status(const std::string& observer_id, const std::string& match_id) const {
    const std::lock_guard lock(mutex_);
    return statuses_.contains({match_id, observer_id});
}

bool MemoryPublisher::forgotten(const std::string& match_id) const {
    const std::lock_guard lock(mutex_);
    return forgotten_.contains(match_id);
}

bool MemoryPublisher::given_up(const std::string& match_id) const {
    const std::lock_guard lock(mutex_);
    return given_up_.contains(match_id);
}

void receive(Director& director, const std::string& match_id, const PoseFrame& frame) {
    PoseArrival arrival{match_id, frame};
    director.receive({&arrival, 1});
}

Stage::Stage(const config::Config& config, Audiences audiences)
    : director(config, maps, publisher, std::move(audiences)) {
    maps.add("square", false);
    maps.set_ready("square", square());
}

config::Config Stage::default_config() {
    config::Config config;
    config.profiles["default"];
    config.limits.workers = 2;
    config.limits.pose_rate_hz = 1'000'000;  // frames of many seconds come in one
    config.matches.silence_frames = 100000;
    return config;
}

freespace::Freespace Stage::square() {
    return test::make_freespace(test::square_contents());
}

MatchInfo Stage::info(const std::string& match_id, std::uint64_t epoch,
                      const std::vector<std::uint32_t>& players) {
    MatchInfo info;
    info.match_id = match_id;
    info.epoch = epoch;
    info.map_name = "square";
    info.metres_per_unit = 0.0254F;
    info.rate_hz = 20.0F;
    for (const std::uint32_t id : players)
        info.players.push_back({id, "player " + std::to_string(id), "", 0});
    return info;
}

ObserverRequest Stage::request(const std::string& observer_id, std::uint32_t target,
                               const std::string& match_id) {
    ObserverRequest request;
    request.match_id = match_id;
    request.observer_id = observer_id;
    request.target = target;
    return request;
}

PoseFrame Stage::poses(std::uint32_t number, std::uint64_t epoch, const std::vector<std::uint32_t>& players) {
    PoseFrame frame;
    frame.epoch = epoch;
    frame.frame_number = number;
    frame.frame_time = static_cast<std::int64_t>(number) * 50'000'000;
    frame.source_time = 1'000'000'000 + frame.frame_time;
    for (const std::uint32_t id : players) {
        const float angle = 0.02F * static_cast<float>(number) + static_cast<float>(id);
        PlayerPose pose;
        pose.player_id = id;
        pose.eye = Vec3f(50.0F + 20.0F * std::cos(angle), 50.0F + 20.0F * std::sin(angle), 0.0F);
        pose.orientation = Quatf(Eigen::AngleAxisf(angle + 1.57F, Vec3f::UnitZ()));
        pose.flags = pose_alive;
        frame.poses.push_back(pose);
    }
    return frame;
}

bool Stage::start(const MatchInfo& match) {
    const bool taken = director.receive(match);
    director.flush();
    return taken;
}

void Stage::ask(const ObserverRequest& wanted) {
    director.receive(wanted);
    director.flush();
}

void Stage::send(const PoseFrame& frame, const std::string& match_id) {
    receive(director, match_id, frame);
    director.flush();
}

bool cuts(const CameraFrame& frame) {
    return (frame.cameras.at(0).flags & camera::cut) != 0;
}

}  // namespace camdir::director
