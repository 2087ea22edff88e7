#include "live/relay.hpp"

#include <algorithm>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "live/frame.hpp"
#include "live/history.hpp"
#include "live/notes.hpp"
#include "live/shown_movers.hpp"

namespace camdir::live {

// One match. Its messages come from one thread at a time, its viewers from others.
class Relay::Channel {
  public:
    explicit Channel(Relay& relay) : relay_(relay) {}

    void show(const director::MatchInfo& shown);
    void show(const director::PoseFrame& poses, const director::CameraFrame& cameras);
    void show(const director::MatchEvent& event);
    // Returns the viewers, who are to leave.
    std::vector<std::shared_ptr<Viewer>> end(EndReason reason);
    // False: it has ended.
    [[nodiscard]] bool join(const std::shared_ptr<Viewer>& viewer);
    [[nodiscard]] std::size_t viewers();

  private:
    // With the mutex held.
    [[nodiscard]] std::uint8_t slot_of(std::uint32_t player) const;
    [[nodiscard]] SlotOf slots() const {
        return [this](std::uint32_t player) { return slot_of(player); };
    }
    void give_slots();
    // False: it has one, or there is none.
    bool give_slot(const Place& place);
    void add_unlisted(const director::PoseFrame& poses);
    void forget_left();
    [[nodiscard]] SharedMessage encode_last() const;
    void put(const SharedMessage& message);

    Relay& relay_;
    std::mutex mutex_;
    director::MatchInfo match_;
    Roster roster_;
    std::map<std::uint32_t, std::uint8_t> slots_;  // by player
    std::optional<History> history_;               // of this epoch; none before and after the match
    director::PoseFrame poses_;                    // the last ones
    director::CameraFrame cameras_;
    ShownMovers movers_;
    std::vector<std::shared_ptr<Viewer>> viewers_;
};

void Relay::Channel::show(const director::MatchInfo& shown) {
    const std::lock_guard lock(mutex_);
    if (!history_ || match_.epoch != shown.epoch || match_.map_name != shown.map_name) {
        history_.emplace();
        poses_ = {};
        cameras_ = {};
        movers_ = {};
    }
    match_ = shown;
    give_slots();
    put(match_note(match_, roster_));
}

void Relay::Channel::show(const director::PoseFrame& poses, const director::CameraFrame& cameras) {
    const std::lock_guard lock(mutex_);
    if (!history_) return;  // the server stops
    poses_ = poses;
    cameras_ = cameras;
    add_unlisted(poses);
    if (movers_.follow(poses.movers) && !viewers_.empty()) put(movers_note(movers_.movers()));
    for (const Cut& cut : history_->add(poses, cameras)) {
        const SharedMessage note = cut_note(cut, slots());
        history_->keep_cut(note);
        put(note);
    }
    forget_left();
    if (!viewers_.empty()) put(encode_last());
}

void Relay::Channel::show(const director::MatchEvent& event) {
    const std::lock_guard lock(mutex_);
    if (!history_) return;
    const SharedMessage note = event_note(event, slots());
    history_->keep(event, note);
    put(note);
}

std::vector<std::shared_ptr<Viewer>> Relay::Channel::end(EndReason reason) {
    const std::lock_guard lock(mutex_);
    put(end_note(reason));
    for (const auto& viewer : viewers_)
        viewer->finish();
    history_.reset();
    return std::exchange(viewers_, {});
}

bool Relay::Channel::join(const std::shared_ptr<Viewer>& viewer) {
    const std::lock_guard lock(mutex_);
    if (!history_) return false;
    viewer->put(match_note(match_, roster_));
    viewer->put(history_note(*history_, slots()));
    if (!movers_.movers().empty()) viewer->put(movers_note(movers_.movers()));
    if (!poses_.poses.empty()) viewer->put(encode_last());
    viewers_.push_back(viewer);
    return true;
}

std::size_t Relay::Channel::viewers() {
    const std::lock_guard lock(mutex_);
    forget_left();
    return viewers_.size();
}

std::uint8_t Relay::Channel::slot_of(std::uint32_t player) const {
    const auto found = slots_.find(player);
    return found == slots_.end() ? no_slot : found->second;
}

// Who has a slot keeps it, so that frames which viewers have kept stay readable; slots of players that are
// gone are given away when there is no other.
void Relay::Channel::give_slots() {
    for (auto& [slot, place] : roster_)
        place.listed = false;
    for (const director::Player& player : match_.players)
        if (const std::uint8_t slot = slot_of(player.id); slot != no_slot) roster_[slot] = {player, true};
    for (const director::Player& player : match_.players)
        give_slot({player, true});
}

bool Relay::Channel::give_slot(const Place& place) {
    if (slot_of(place.player.id) != no_slot) return false;
    std::uint8_t slot = 0;
    while (slot < no_slot && roster_.contains(slot))
        ++slot;
    if (slot == no_slot) {
        const auto gone = std::ranges::find_if(roster_, [&](const auto& taken) {
            return !taken.second.listed &&
                   std::ranges::find(poses_.poses, taken.second.player.id,
                                     &director::PlayerPose::player_id) == poses_.poses.end();
        });
        if (gone == roster_.end()) return false;  // more players than slots: these are not shown
        slot = gone->first;
        slots_.erase(gone->second.player.id);
    }
    slots_[place.player.id] = slot;
    roster_[slot] = place;
    return true;
}

void Relay::Channel::add_unlisted(const director::PoseFrame& poses) {
    bool any = false;
    for (const director::PlayerPose& pose : poses.poses) {
        director::Player player;
        player.id = pose.player_id;
        any = give_slot({player, false}) || any;
    }
    if (any) put(match_note(match_, roster_));
}

void Relay::Channel::forget_left() {
    std::erase_if(viewers_, [this](const std::shared_ptr<Viewer>& viewer) {
        if (viewer->lost()) ++relay_.lost_viewers_;
        return viewer->lost() || viewer->left();
    });
}

SharedMessage Relay::Channel::encode_last() const {
    return std::make_shared<Message>(Message{
        Message::Kind::frame,
        encode_frame(poses_, cameras_, movers_.poses(), position_step(match_.metres_per_unit), slots())});
}

void Relay::Channel::put(const SharedMessage& message) {
    for (const auto& viewer : viewers_) {
        relay_.dropped_frames_ += viewer->put(message);
        if (message->kind == Message::Kind::frame) ++relay_.frames_;
    }
}

Relay::~Relay() = default;

void Relay::show(const director::MatchInfo& shown) {
    if (const auto channel = find(shown.match_id)) return channel->show(shown);
    const auto channel = std::make_shared<Channel>(*this);
    channel->show(shown);  // before anybody can find it, it knows its match
    const std::unique_lock lock(mutex_);
    if (!closed_) channels_.emplace(shown.match_id, channel);
}

void Relay::show(const std::string& match_id, const director::PoseFrame& poses,
                 const director::CameraFrame& cameras) {
    if (const auto channel = find(match_id)) channel->show(poses, cameras);
}

void Relay::show(const std::string& match_id, const director::MatchEvent& event) {
    if (const auto channel = find(match_id)) channel->show(event);
}

void Relay::end(const std::string& match_id) {
    std::shared_ptr<Channel> channel;
    {
        const std::unique_lock lock(mutex_);
        const auto found = channels_.find(match_id);
        if (found == channels_.end()) return;
        channel = found->second;
        channels_.erase(found);
    }
    channel->end(EndReason::match);
}

std::size_t Relay::close(std::chrono::milliseconds limit) {
    constexpr std::chrono::milliseconds step{5};
    std::map<std::string, std::shared_ptr<Channel>> channels;
    {
        const std::unique_lock lock(mutex_);
        closed_ = true;
        channels.swap(channels_);
    }
    std::vector<std::shared_ptr<Viewer>> watching;
    for (const auto& [match_id, channel] : channels)
        for (auto& viewer : channel->end(EndReason::server))
            watching.push_back(std::move(viewer));
    const auto end = std::chrono::steady_clock::now() + limit;
    for (;; std::this_thread::sleep_for(step)) {
        std::erase_if(watching, [](const std::shared_ptr<Viewer>& viewer) { return viewer->left(); });
        if (watching.empty() || std::chrono::steady_clock::now() >= end) return watching.size();
    }
}

Relay::Admission Relay::join(const std::string& match_id, const std::shared_ptr<Viewer>& viewer) {
    if (statistics().viewers >= max_viewers_) return Admission::full;
    const auto channel = find(match_id);
    return channel && channel->join(viewer) ? Admission::joined : Admission::no_match;
}

RelayStatistics Relay::statistics() const {
    RelayStatistics result{0, frames_, dropped_frames_, lost_viewers_};
    const std::shared_lock lock(mutex_);
    for (const auto& [match_id, channel] : channels_)
        result.viewers += channel->viewers();
    return result;
}

std::shared_ptr<Relay::Channel> Relay::find(const std::string& match_id) const {
    const std::shared_lock lock(mutex_);
    const auto found = channels_.find(match_id);
    return found == channels_.end() ? nullptr : found->second;
}

}  // namespace camdir::live
