#include "maps/batch.hpp"

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "freespace/freespace.hpp"
#include "maps/bake_map.hpp"
#include "maps/guarded.hpp"
#include "maps/schedule.hpp"

namespace camdir::maps {
namespace {

void describe_file(const std::string& file, BakeOutcome& outcome) {
    const auto opened = guarded(file, [&] { return freespace::Freespace::open(file); });
    if (!opened) return;
    outcome.triangles = opened->triangles().size();
    outcome.file_bytes = opened->byte_size();
    for (const freespace::Count& count : opened->metadata().counts)
        if (count.what == "samples") outcome.samples = static_cast<std::uint64_t>(count.value);
}

class Batch {
  public:
    Batch(const std::vector<config::Map>& maps, const BatchParameters& parameters, const BatchSink& sink,
          const std::stop_token& stop)
        : maps_(maps), parameters_(parameters), sink_(sink), stop_(stop), outcomes_(maps.size()) {
        const auto cores = static_cast<unsigned>(tbb::info::default_concurrency());
        threads_ = parameters.threads == 0 ? cores : std::min(parameters.threads, cores);
    }

    std::vector<BakeOutcome> run();

  private:
    void examine(std::size_t map);
    void end(std::size_t map, BakeStatus status, std::string reason);
    void work(BakeSchedule& schedule);
    void bake(std::size_t map);
    void share_threads(std::size_t running);

    const std::vector<config::Map>& maps_;
    const BatchParameters& parameters_;
    const BatchSink& sink_;
    const std::stop_token& stop_;
    unsigned threads_;
    std::vector<std::size_t> jobs_;  // indices of the maps to bake
    std::vector<std::uint64_t> needs_;

    std::mutex mutex_;  // guards the following members and the sink
    std::condition_variable changed_;
    std::vector<BakeOutcome> outcomes_;
    std::optional<tbb::global_control> limit_;
};

std::vector<BakeOutcome> Batch::run() {
    for (std::size_t map = 0; map < maps_.size(); ++map) {
        outcomes_[map].map = maps_[map].name;
        if (!stop_.stop_requested()) examine(map);
    }
    if (sink_.examined) sink_.examined(jobs_.size());
    BakeSchedule schedule(needs_, parameters_.memory, threads_);
    std::vector<std::jthread> workers;
    while (workers.size() < std::min<std::size_t>(threads_, jobs_.size()))
        workers.emplace_back([&] { work(schedule); });
    workers.clear();
    return std::move(outcomes_);
}

void Batch::examine(std::size_t map) {
    if (!parameters_.force) {
        const auto freshness = maps::examine(maps_[map]);
        if (!freshness) return end(map, BakeStatus::failed, freshness.error().message);
        if (freshness->stale.empty()) return end(map, BakeStatus::fresh, freshness->warning);
        outcomes_[map].reason = freshness->stale;
    }
    const auto need = memory_needed(maps_[map]);
    if (!need) return end(map, BakeStatus::failed, need.error().message);
    jobs_.push_back(map);
    needs_.push_back(*need);
}

void Batch::end(std::size_t map, BakeStatus status, std::string reason) {
    BakeOutcome& outcome = outcomes_[map];
    outcome.status = status;
    outcome.reason = std::move(reason);
    if (status == BakeStatus::fresh || status == BakeStatus::baked) describe_file(maps_[map].file, outcome);
    if (sink_.finished) sink_.finished(outcome);
}

void Batch::work(BakeSchedule& schedule) {
    std::unique_lock lock(mutex_);
    for (;;) {
        std::optional<std::size_t> job;
        // No wake-up for a stop: the running bakes end soon after it and notify.
        changed_.wait(lock, [&] {
            if (stop_.stop_requested() || schedule.all_started()) return true;
            job = schedule.start();
            return job.has_value();
        });
        if (!job) return;
        share_threads(schedule.running());
        lock.unlock();
        bake(jobs_[*job]);
        lock.lock();
        schedule.finish(*job);
        share_threads(schedule.running());
        changed_.notify_all();
    }
}

void Batch::bake(std::size_t map) {
    const config::Map& entry = maps_[map];
    const auto show = [&](const bake::Progress& progress) {
        const std::scoped_lock lock(mutex_);
        if (sink_.progress) sink_.progress(entry.name, progress);
    };
    const auto begin = std::chrono::steady_clock::now();
    auto baked = bake_map(entry, {threads_, parameters_.largest, parameters_.force}, show, stop_);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;

    const std::scoped_lock lock(mutex_);
    outcomes_[map].seconds = seconds.count();
    if (!baked) {
        const bool stopped = baked.error().code == ErrorCode::interrupted;
        return end(map, stopped ? BakeStatus::interrupted : BakeStatus::failed, baked.error().message);
    }
    if (!*baked) return end(map, BakeStatus::fresh, "another process baked it in the meantime");
    outcomes_[map].report = std::move(**baked);
    end(map, BakeStatus::baked, outcomes_[map].reason);
}

// Every running bake has its own thread; TBB gets the rest.
void Batch::share_threads(std::size_t running) {
    const std::size_t bakes = std::max<std::size_t>(running, 1);
    limit_.emplace(tbb::global_control::max_allowed_parallelism, threads_ + 1 - bakes);
}

}  // namespace

std::string_view name_of(BakeStatus status) {
    switch (status) {
        case BakeStatus::fresh:
            return "fresh";
        case BakeStatus::baked:
            return "baked";
        case BakeStatus::failed:
            return "failed";
        case BakeStatus::interrupted:
            break;
    }
    return "interrupted";
}

std::vector<BakeOutcome> bake_maps(const std::vector<config::Map>& maps, const BatchParameters& parameters,
                                   const BatchSink& sink, const std::stop_token& stop) {
    return Batch(maps, parameters, sink, stop).run();
}

}  // namespace camdir::maps
