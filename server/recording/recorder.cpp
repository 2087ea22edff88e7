#include "recording/recorder.hpp"

#include <spdlog/spdlog.h>

#include <chrono>
#include <utility>

#include "director/clock.hpp"

namespace camdir::recording {
namespace {

// Frames, events and requests of a match: some seconds. Descriptions may use as many places again.
constexpr std::size_t max_waiting = 512;
// Of all matches: as many of 128 matches; beside them, ends.
constexpr std::size_t max_waiting_of_all = 128 * max_waiting;
constexpr std::size_t max_waiting_bytes = 128U << 20U;
constexpr std::size_t max_ends = 8192;
constexpr std::chrono::milliseconds write_period{50};

std::int64_t wall_clock_ns() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

// Each frame's own while something moves.
std::size_t bytes_of_movers(const director::PoseFrame& frame) {
    return frame.movers ? frame.movers->frame->poses.size() * sizeof(director::MoverPose) : 0;
}

// About; what most matches consist of.
std::size_t bytes_of(const Message& message) {
    std::size_t bytes = sizeof message;
    if (const auto* frame = std::get_if<director::PoseFrame>(&message))
        bytes += frame->poses.size() * sizeof(director::PlayerPose) + bytes_of_movers(*frame);
    if (const auto* frame = std::get_if<director::CameraFrame>(&message))
        bytes += frame->cameras.size() * sizeof(director::ShotCamera);
    if (const auto* info = std::get_if<director::MatchInfo>(&message))
        bytes += info->players.size() * sizeof(director::Player);
    return bytes;
}

}  // namespace

Recorder::Recorder(RecorderOptions options)
    : options_(std::move(options)), thread_([this](const std::stop_token& stop) { run(stop); }) {}

Recorder::~Recorder() {
    thread_.request_stop();
    thread_.join();
}

void Recorder::show(const director::MatchInfo& shown) {
    put(shown.match_id, {shown}, 2 * max_waiting);
}

void Recorder::show(const std::string& match_id, const director::PoseFrame& poses,
                    const director::CameraFrame& cameras) {
    std::vector<Message> messages;  // a list in braces would copy each twice
    messages.reserve(2);
    messages.emplace_back(poses);
    messages.emplace_back(cameras);
    put(match_id, std::move(messages), max_waiting);
}

void Recorder::show(const std::string& match_id, const director::MatchEvent& event) {
    put(match_id, {event}, max_waiting);
}

void Recorder::request(const director::ObserverRequest& request) {
    put(request.match_id, {request}, max_waiting);
}

void Recorder::request_ended(const std::string& match_id, const std::string& observer_id) {
    put(match_id, {Withdrawal{observer_id}}, 2 * max_waiting);
}

// One end is enough, where another waits already.
void Recorder::end(const std::string& match_id) {
    const std::lock_guard lock(mutex_);
    const auto waiting = waiting_of_.find(match_id);
    if (waiting != waiting_of_.end() && waiting->second.ends) return;
    if (waiting_.size() >= max_waiting_of_all + max_ends) {
        ++statistics_.dropped;
        return;
    }
    push({director::now_ns(), match_id, {}, true});
}

void Recorder::put(const std::string& match_id, std::vector<Message> messages, std::size_t max) {
    std::size_t bytes = 0;
    for (const Message& message : messages)
        bytes += bytes_of(message);
    const std::lock_guard lock(mutex_);
    const auto waiting = waiting_of_.find(match_id);
    if (waiting_.size() >= max_waiting_of_all || waiting_bytes_ + bytes > max_waiting_bytes ||
        (waiting != waiting_of_.end() && waiting->second.count >= max)) {
        statistics_.dropped += messages.size();
        return;
    }
    waiting_bytes_ += bytes;
    push({director::now_ns(), match_id, std::move(messages)});
}

void Recorder::push(Shown shown) {
    Waiting& waiting = waiting_of_[shown.match_id];
    waiting.count += shown.ends ? 0 : 1;
    waiting.ends = shown.ends;
    waiting_.push_back(std::move(shown));
}

RecorderStatistics Recorder::statistics() const {
    const std::lock_guard lock(mutex_);
    return statistics_;
}

void Recorder::wait_until_written() {
    std::unique_lock lock(mutex_);
    written_.wait(lock, [this] { return waiting_.empty() && !is_writing_; });
}

void Recorder::run(const std::stop_token& stop) {
    if (const auto opened = open_archive(); !opened)
        spdlog::warn("no match is recorded yet: {}", opened.error().message);
    while (!stop.stop_requested()) {
        for (Shown& shown : take(stop))
            write(std::move(shown));
        end_due_fragments();
        keep_within_bound();
        broadcast_.drop_unwanted();
        update_statistics();
    }
    for (Shown& shown : take(stop))
        write(std::move(shown));
    for (auto& [match_id, match] : matches_)
        finish(match_id, match);
    keep_within_bound();
    update_statistics();
}

std::vector<Recorder::Shown> Recorder::take(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    written_.wait_for(lock, stop, write_period, [] { return false; });
    is_writing_ = true;
    waiting_of_.clear();
    waiting_bytes_ = 0;
    return std::exchange(waiting_, {});
}

void Recorder::write(Shown shown) {
    Match& match = matches_[shown.match_id];
    for (Message& message : shown.messages)
        write(shown.match_id, match, {shown.time, std::move(message)});
    if (shown.ends) {
        finish(shown.match_id, match);
        match.failed = match.needs_archive = false;
    }
    if (!match.recording && !match.failed && match.requests.empty()) matches_.erase(shown.match_id);
}

// The record's time is the steady clock's here.
void Recorder::write(const std::string& match_id, Match& match, Record record) {
    Result<void> done;
    if (const auto* info = std::get_if<director::MatchInfo>(&record.message)) {
        if (info->epoch != match.info.epoch) match.failed = match.needs_archive = false;
        match.info = *info;
        if (!match.recording && !match.failed) done = begin(match_id, match, record.time);
    } else if (match.needs_archive && (archive_ || record.time >= archive_due_)) {
        done = begin(match_id, match, record.time);
        if (done)
            done = match.recording->writer.append({record.time + match.recording->clock_offset, match.info});
    }
    if (const auto* request = std::get_if<director::ObserverRequest>(&record.message))
        match.requests[request->observer_id] = *request;
    if (const auto* withdrawal = std::get_if<Withdrawal>(&record.message))
        match.requests.erase(withdrawal->observer_id);
    if (done && match.recording) {
        record.time += match.recording->clock_offset;
        if (const auto* poses = std::get_if<director::PoseFrame>(&record.message))
            done = append_movers(match, *poses, record.time);
        if (done) done = match.recording->writer.append(record);
    }
    if (!done) return fail(match_id, match, done.error());
    if (match.recording) tell_viewers(match_id, match);
}

Result<void> Recorder::append_movers(Match& match, const director::PoseFrame& poses, std::int64_t time) {
    Result<void> done;
    Writer& writer = match.recording->writer;
    if (!poses.movers) {
        const bool had = match.movers.info && match.movers.info->epoch == poses.epoch;
        match.movers = {};
        return had ? writer.append({time, director::MoverInfo{poses.epoch, {}}}) : done;
    }
    const director::MatchMovers& movers = *poses.movers;
    if (movers.info != match.movers.info) done = writer.append({time, *movers.info});
    if (done && movers.frame != match.movers.frame) done = writer.append({time, *movers.frame});
    match.movers = movers;
    return done;
}

// Another director may have it, and leave it to this one.
Result<void> Recorder::open_archive() {
    archive_due_ = director::now_ns() + options_.folder_retry;
    auto archive = Archive::open(options_.folder);
    if (!archive) return tl::unexpected(archive.error());
    archive_ = std::move(*archive);
    return {};
}

Result<void> Recorder::begin(const std::string& match_id, Match& match, std::int64_t time) {
    if (archive_ && !archive_->is_in_place()) archive_.reset();
    if (!archive_)
        if (auto opened = open_archive(); !opened) return opened;
    const std::int64_t clock_offset = wall_clock_ns() - director::now_ns();
    const std::string id = new_recording_id(time + clock_offset);
    const std::string name = folder_name(id, match_id);
    auto writer = Writer::create(options_.folder / name,
                                 {match.info, options_.director_version, options_.fragment_duration},
                                 options_.max_match_bytes);
    if (!writer) return tl::unexpected(writer.error());
    match.recording.emplace(Recording{id, name, std::move(*writer), clock_offset});
    match.failed = match.needs_archive = false;
    match.movers = {};
    Result<void> done;
    for (auto request = match.requests.begin(); done && request != match.requests.end(); ++request)
        done = match.recording->writer.append({time + clock_offset, request->second});
    return done;
}

void Recorder::finish(const std::string& match_id, Match& match) {
    if (!match.recording) return;
    const auto done = match.recording->writer.finish();
    if (!done) return fail(match_id, match, done.error());
    end_recording(match_id, match);
}

void Recorder::fail(const std::string& match_id, Match& match, const Error& error) {
    if (!std::exchange(match.failed, true)) {
        ++failures_;
        spdlog::error("match {}: no longer recorded: {}{}", match_id, error.message, advice());
    }
    match.needs_archive = archive_ == nullptr;
    end_recording(match_id, match);
}

std::string Recorder::advice() const {
    constexpr std::uintmax_t nearly_full = std::uintmax_t{16} << 20U;
    std::error_code error;
    const auto space = std::filesystem::space(options_.folder, error);
    return error || space.available > nearly_full
               ? ""
               : "; free space, or lower /recording/disk_mib, which is more than the disk has for recordings";
}

void Recorder::end_recording(const std::string& match_id, Match& match) {
    if (!match.recording) return;
    tell_viewers(match_id, match);
    broadcast_.end(match_id);
    ended_fragments_ += match.recording->writer.fragments();
    if (archive_) archive_->add_ended(match.recording->name, match.recording->writer.folder_bytes());
    match.recording.reset();
}

void Recorder::tell_viewers(const std::string& match_id, Match& match) {
    Recording& recording = *match.recording;
    const auto& written = recording.writer.written();
    if (written.empty()) return;
    const std::uint32_t first = written.front().fragment;
    const std::uint32_t end = recording.writer.fragments();
    if (first == recording.first && end == recording.end) return;
    if (end != recording.end) recording.complete_at = Channel::Clock::now();
    recording.first = first;
    recording.end = end;
    broadcast_.set(match_id, {recording.id,
                              options_.folder / recording.name,
                              match.info.map_name,
                              1e-9 * static_cast<double>(options_.fragment_duration),
                              match.info.spectator_delay_s,
                              {first, end - 1},
                              recording.complete_at});
}

void Recorder::end_due_fragments() {
    for (auto& [match_id, match] : matches_) {
        if (!match.recording) continue;
        const std::int64_t time = director::now_ns() + match.recording->clock_offset;
        if (const auto done = match.recording->writer.advance(time); !done)
            fail(match_id, match, done.error());
        else
            tell_viewers(match_id, match);
    }
}

void Recorder::keep_within_bound() {
    while (disk_bytes() > options_.max_bytes && (remove_oldest_recording() || remove_oldest_fragment())) {
    }
}

bool Recorder::remove_oldest_recording() {
    if (!archive_) return false;
    const std::vector<std::string> names = archive_->remove_oldest();
    for (const std::string& name : names)
        broadcast_.remove(options_.folder / name);
    return !names.empty();
}

bool Recorder::remove_oldest_fragment() {
    std::pair<const std::string, Match>* oldest = nullptr;
    const auto begin_time = [](const auto& match) {
        return match.second.recording->writer.written().front().begin_time;
    };
    for (auto& match : matches_) {
        const bool can = match.second.recording && match.second.recording->writer.written().size() > 1;
        if (can && (oldest == nullptr || begin_time(match) < begin_time(*oldest))) oldest = &match;
    }
    if (oldest == nullptr) return false;
    auto& [match_id, match] = *oldest;
    if (const auto done = match.recording->writer.remove_oldest(); !done)
        fail(match_id, match, done.error());
    else
        tell_viewers(match_id, match);
    return true;
}

std::uint64_t Recorder::disk_bytes() const {
    std::uint64_t bytes = archive_ ? archive_->ended_bytes() : 0;
    for (const auto& [match_id, match] : matches_)
        if (match.recording) bytes += match.recording->writer.bytes();
    return bytes;
}

void Recorder::update_statistics() {
    RecorderStatistics sum;
    sum.bytes = disk_bytes();
    sum.fragments = ended_fragments_;
    sum.failures = failures_;
    for (const auto& [match_id, match] : matches_) {
        if (!match.recording) continue;
        ++sum.running;
        sum.fragments += match.recording->writer.fragments();
    }
    const std::lock_guard lock(mutex_);
    sum.dropped = statistics_.dropped;
    statistics_ = sum;
    is_writing_ = false;
    written_.notify_all();
}

}  // namespace camdir::recording
