// Subscriber: which matches there are, and whose.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "dds/decode.hpp"
#include "dds/subscriber.hpp"

namespace camdir::dds {

void Subscriber::match_info_found(const camera_director_MatchInfo& sample, const dds_sample_info_t& info) {
    Ownership::Claim claim;
    if (const auto error = decode(sample, claim.info)) {
        return drop(Topic::match_info, *error, sample.match_id);
    }
    const std::string match_id = claim.info.match_id;
    const MatchedWriter writer = find_writer(match_info_reader_, info.publication_handle);
    if (!writer || !writes_in(*writer, match_partition(match_id))) {
        return drop(Topic::match_info, ValidationError::wrong_partition, match_id);
    }
    claim.sender = sender_of(*writer);
    claim.writer = info.publication_handle;
    described(std::move(claim));
}

bool Subscriber::described(Ownership::Claim claim) {
    const std::string match_id = claim.info.match_id;
    if (matches_.contains(match_id)) {
        admission_.withdraw(match_id, claim.writer);
    } else {
        if (!admission_.begins(claim, Clock::now())) return false;
        // The endpoints first, because the director publishes at once.
        if (!add_match(match_id)) return true;
    }
    Match& match = *matches_[match_id];
    const auto standing = match.ownership.describe(std::move(claim), Clock::now());
    if (standing == Ownership::Standing::stranger) {
        drop(Topic::match_info, ValidationError::not_owner, match_id);
        return true;
    }
    ++counters_.of(Topic::match_info).accepted;
    if (standing == Ownership::Standing::successor) {
        begin_anew(match);
    } else {
        introduce(match);
    }
    return true;
}

// No more at once than leave the matches that run their beat.
void Subscriber::admit_waiting() {
    const auto end = Clock::now() + longest_turn();
    while (Clock::now() < end && ingress_->has_room()) {
        std::optional<Ownership::Claim> claim = admission_.next(Clock::now());
        if (!claim || !described(std::move(*claim))) return;
    }
}

std::size_t Subscriber::owned_by(const SenderId& participant) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        matches_, [&](const auto& entry) { return entry.second->ownership.owns(participant); }));
}

bool Subscriber::has_room_for(const std::string& match_id) const {
    return removal_.has_room() && !removal_.removes(match_id);
}

bool Subscriber::admits(const std::string& match_id) {
    return has_room_for(match_id) && ingress_->admit(match_id);
}

void Subscriber::refuse(const std::string& match_id, ValidationError limit) {
    drop(Topic::match_info, limit, match_id);
}

void Subscriber::match_info_lost(const camera_director_MatchInfo& key, const dds_sample_info_t& info) {
    if (info.instance_state == DDS_NOT_ALIVE_DISPOSED_INSTANCE_STATE)
        admission_.withdraw(key.match_id, info.publication_handle);
    const auto known = matches_.find(key.match_id);
    if (known == matches_.end()) return;
    Ownership& ownership = known->second->ownership;
    put_into_effect(info.instance_state == DDS_NOT_ALIVE_DISPOSED_INSTANCE_STATE
                        ? ownership.dispose(info.publication_handle, !info.valid_data, Clock::now())
                        : ownership.lose(),
                    key.match_id);
}

// A game server that is gone is not told of where another describes its match too.
void Subscriber::notice_unmatched() {
    const std::vector<WriterHandle> matched = matched_writers(match_info_reader_);
    admission_.retain(matched);
    std::vector<std::string> match_ids;
    for (const auto& [match_id, match] : matches_)
        match_ids.push_back(match_id);
    for (const std::string& match_id : match_ids)
        put_into_effect(matches_[match_id]->ownership.retain(matched, Clock::now()), match_id);
}

void Subscriber::put_into_effect(Ownership::Change change, const std::string& match_id) {
    Match& match = *matches_[match_id];
    if (change == Ownership::Change::none) return;
    if (change == Ownership::Change::succeeded) return begin_anew(match);
    if (match.service == Service::forgotten) return remove_match(match_id);
    if (change != Ownership::Change::ended) return ingress_->server_lost(match_id);
    ingress_->match_ended(match_id);
    match.service = Service::given_up;
}

// Epochs, frame numbers and clocks of its owner before mean nothing.
void Subscriber::begin_anew(Match& match) {
    hand_on_poses();
    spdlog::warn("match {}: another game server continues it", match.id());
    ingress_->match_ended(match.id());
    match.service = Service::given_up;
    introduce(match);
}

bool Subscriber::introduce(Match& match) {
    mark_given_up();  // what the director says from now on is newer
    if (!ingress_->receive(match.ownership.info())) {
        if (match.service == Service::served) match.service = Service::forgotten;
        match.next_introduction = Clock::now() + assertion_interval();
        return false;
    }
    match.service = Service::served;
    cancel_forget(match.id());
    return true;
}

// The director knows the match again: an earlier forget() must not remove it.
void Subscriber::cancel_forget(const std::string& match_id) {
    const std::lock_guard lock(mutex_);
    std::erase(forgotten_, match_id);
}

bool Subscriber::add_match(const std::string& match_id) {
    take_waiting_poses();
    const auto opened = open_match(match_id);
    if (opened) return true;
    ++counters_.endpoint_failures;
    spdlog::error("match '{}' cannot be served: {}", match_id, opened.error().message);
    remove_match(match_id);
    ingress_->match_ended(match_id);
    return false;
}

// On failure the caller removes the match.
Result<void> Subscriber::open_match(const std::string& match_id) {
    auto endpoints =
        MatchEndpoints::open(participant_, match_id, options_.leadership, options_.director_id, counters_);
    if (!endpoints) return tl::unexpected(endpoints.error());
    auto& match = matches_[match_id];
    match = std::make_unique<Match>(options_.participant_observers);
    match->endpoints = std::move(*endpoints);
    match->endpoints->set_shards(admission_.shards().own(), admission_.shards().home_of(match_id));
    table_.add(match->endpoints);
    next_decision_ = Clock::now();
    counters_.matches = static_cast<std::uint32_t>(matches_.size());
    if (auto watched = watch(*match); !watched) return watched;
    new_matches_.push_back(match_id);
    return {};
}

Result<void> Subscriber::watch(Match& match) {
    const MatchEndpoints& endpoints = *match.endpoints;
    Result<void> watched = ready_.watch(endpoints.pose_reader(), match.poses);
    if (watched) watched = ready_.watch(endpoints.event_reader(), match.events);
    if (watched) watched = ready_.watch(endpoints.request_reader(), match.requests, &match.requesters);
    if (watched) watched = ready_.watch(endpoints.camera_reader(), match.cameras);
    if (watched) watched = ready_.watch(endpoints.sign_reader(), match.signs);
    if (!participant_.has_movers()) return watched;
    if (watched)
        watched = ready_.watch(endpoints.mover_info_reader(), match.mover_infos, &match.mover_info_writers);
    if (watched)
        watched =
            ready_.watch(endpoints.mover_frame_reader(), match.mover_frames, &match.mover_frame_writers);
    return watched;
}

void Subscriber::unwatch(Match& match) {
    const MatchEndpoints& endpoints = *match.endpoints;
    ready_.unwatch(endpoints.pose_reader(), match.poses);
    ready_.unwatch(endpoints.event_reader(), match.events);
    ready_.unwatch(endpoints.request_reader(), match.requests, &match.requesters);
    ready_.unwatch(endpoints.camera_reader(), match.cameras);
    ready_.unwatch(endpoints.sign_reader(), match.signs);
    if (!participant_.has_movers()) return;
    ready_.unwatch(endpoints.mover_info_reader(), match.mover_infos, &match.mover_info_writers);
    ready_.unwatch(endpoints.mover_frame_reader(), match.mover_frames, &match.mover_frame_writers);
}

void Subscriber::remove_match(const std::string& match_id) {
    table_.remove(match_id);
    const auto known = matches_.find(match_id);
    if (known == matches_.end()) return;
    unwatch(*known->second);
    removal_.add(std::move(known->second->endpoints));
    matches_.erase(known);
    counters_.matches = static_cast<std::uint32_t>(matches_.size());
}

void Subscriber::mark_given_up() {
    const std::lock_guard lock(mutex_);
    for (const std::string& match_id : std::exchange(given_up_, {}))
        if (const auto known = matches_.find(match_id); known != matches_.end())
            known->second->service = Service::given_up;
}

void Subscriber::remove_forgotten() {
    std::vector<std::string> forgotten;
    {
        const std::lock_guard lock(mutex_);
        forgotten.swap(forgotten_);
    }
    for (const std::string& match_id : forgotten) {
        const auto known = matches_.find(match_id);
        if (known == matches_.end()) continue;
        // A paused game server may send poses again without another MatchInfo.
        if (known->second->ownership.has_live_owner()) {
            known->second->service = Service::forgotten;
        } else {
            remove_match(match_id);
        }
    }
}

void Subscriber::put_new_shards_into_effect() {
    std::optional<Shards> changed;
    {
        const std::lock_guard lock(mutex_);
        changed.swap(new_shards_);
    }
    if (!changed) return;
    admission_.reshard(std::move(*changed));
    const Shards& shards = admission_.shards();
    for (const auto& [match_id, match] : matches_) {
        match->is_of_shard = shards.serves(match_id);
        match->endpoints->set_shards(shards.own(), shards.home_of(match_id));
    }
}

void Subscriber::leave_matches() {
    std::vector<std::string> left;
    std::uint32_t leaving = 0;
    for (const auto& [match_id, match] : matches_) {
        if (match->is_of_shard) continue;
        ++leaving;
        if (match->endpoints->is_leading())
            (void)match->endpoints->hand_over();  // again, until another has cameras
        else if (match->endpoints->is_following())
            left.push_back(match_id);
    }
    for (const std::string& match_id : left)
        leave(match_id);
    counters_.matches_leaving = leaving - static_cast<std::uint32_t>(left.size());
}

void Subscriber::leave(const std::string& match_id) {
    Match& match = *matches_[match_id];
    spdlog::info("match {}: left to another shard", match_id);
    for (const Ownership::Claim& claim : match.ownership.claims())
        admission_.leave(claim);
    for (const std::string& observer_id : match.request_owners.observers())
        ingress_->request_ended(match_id, observer_id);
    ingress_->match_ended(match_id);
    match.endpoints->resign();  // nobody waits for it
    remove_match(match_id);
}

}  // namespace camdir::dds
