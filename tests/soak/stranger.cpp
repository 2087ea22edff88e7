// stranger: does to the directors and matches of a domain what a game server or observer of the SDK would
// not.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <thread>

#include "soak/priority.hpp"
#include "support/eventually.hpp"
#include "support/program.hpp"
#include "support/raw_peer.hpp"

namespace camdir::soak {
namespace {

using Clock = std::chrono::steady_clock;
using test::RawPeer;
using test::RawPoseFrame;

constexpr std::chrono::milliseconds frame_interval(33);
constexpr std::uint32_t players = 4;
constexpr std::uint64_t batches_a_peer = 20;  // then it leaves, and another comes
constexpr std::chrono::milliseconds answer_limit(1000);
constexpr std::size_t passing_frames = 30;  // that each passing match is watched for

struct Options {
    std::string act;
    std::uint32_t domain = 0;
    std::string match;
    double seconds = 1.0;
    std::uint64_t count = 1000;
    std::uint32_t batch = 50;
    std::uint32_t seed = 1;
};

camera_director_MatchInfo match_info(const std::string& match, std::uint64_t epoch, const char* map) {
    camera_director_MatchInfo info = test::raw_match_info(match, epoch);
    info.map_name = const_cast<char*>(map);  // is only read
    return info;
}

// A game server and an observer of its match.
struct PassingMatch {
    PassingMatch(std::uint32_t domain, const std::string& match)
        : id(match), peer(std::make_unique<RawPeer>(domain, match)) {
        peer->write(match_info(id, 1, "map"));
        peer->write(test::raw_request(id, "viewer", 0));
    }

    void go_on(std::uint32_t number) {
        peer->write(RawPoseFrame(id, 1, number, players).sample());
        seen += peer->take_cameras().size();
    }

    void end() {
        peer->dispose(test::raw_request(id, "viewer", 0));
        peer->dispose(match_info(id, 1, "map"));
    }

    std::string id;
    std::unique_ptr<RawPeer> peer;
    std::size_t seen = 0;  // camera frames
};

class Stranger {
  public:
    explicit Stranger(const Options& options)
        : options_(options), random_(options.seed), begun_(Clock::now()) {}

    void flap() {
        for (std::uint32_t number = 0; !is_over(); ++number) {
            const std::string match =
                "flapping-" + std::to_string(options_.seed) + '-' + std::to_string(number);
            RawPeer peer(options_.domain, match);
            const auto info = match_info(match, 1, "map");
            peer.write(info);
            peer.write(test::raw_request(match, "viewer", 0));
            send_poses(peer, match, 1, frame_interval * 15);
            answered_ += peer.directors() > 0 ? 1 : 0;
            if (number % 2 == 0) peer.dispose(info);  // the others are gone without a word
        }
    }

    void play_unknown_map() { play("unknown-map", match_info("unknown-map", 1, "nobody has this map")); }

    void play_wrong_hash() {
        auto info = match_info("wrong-hash", 1, "map");
        info.map_hash = 1;
        play("wrong-hash", info);
    }

    void send_garbage() {
        const std::string match = "garbage";
        RawPeer peer(options_.domain, match);
        peer.write(match_info(match, 1, "map"));
        peer.write(test::raw_request(match, "viewer", 0));
        for (std::uint32_t number = 0; !is_over(); ++number) {
            RawPoseFrame frame(match, 1, number, players);
            spoil(frame);
            auto sample = frame.sample();
            if (number % 16 == 15) sample.frame_number += 1U << 30U;
            attempt([&] { peer.write(sample); });
            std::this_thread::sleep_for(frame_interval / 4);
        }
    }

    void run_backwards() {
        const std::string match = "backwards";
        RawPeer peer(options_.domain, match);
        peer.write(match_info(match, 1, "map"));
        peer.write(test::raw_request(match, "viewer", 0));
        constexpr std::int64_t hour = 3'600'000'000'000;
        for (std::uint32_t number = 0; !is_over(); ++number) {
            RawPoseFrame frame(match, 1, number, players);
            auto sample = frame.sample();
            sample.frame_time = hour - 16'000'000 * std::int64_t{number};
            sample.source_time = sample.frame_time;
            attempt([&] { peer.write(sample); });
            std::this_thread::sleep_for(frame_interval);
        }
    }

    // Claims what belongs to others, and leaves as if it were its own.
    void usurp() {
        constexpr std::uint64_t greatest = std::numeric_limits<std::uint64_t>::max();
        RawPeer peer(options_.domain, options_.match);
        const auto info = match_info(options_.match, greatest, "map");
        const auto request = test::raw_request(options_.match, "viewer-0", 1);
        for (std::uint32_t number = 0x7fffff00; !is_over(); ++number) {
            attempt([&] { peer.write(info); });
            attempt([&] { peer.write(request); });
            for (const std::uint64_t epoch : {std::uint64_t{1}, greatest}) {
                RawPoseFrame frame(options_.match, epoch, number, players);
                attempt([&] { peer.write(frame.sample()); });
            }
            if (number % 8 == 0) attempt([&] { peer.dispose(request); });
            std::this_thread::sleep_for(frame_interval);
        }
        attempt([&] { peer.dispose(request); });
        attempt([&] { peer.dispose(info); });
    }

    void flood_with_observers() {
        std::unique_ptr<RawPeer> peer;
        flood([&](const std::vector<std::string>& ids, std::uint64_t batch) {
            if (batch % batches_a_peer == 0)
                peer = std::make_unique<RawPeer>(options_.domain, options_.match);
            for (const std::string& id : ids)
                attempt([&] { peer->write(test::raw_request(options_.match, id, 0)); });
            const auto answered = [&] {
                return std::ranges::count_if(ids,
                                             [&](const auto& id) { return peer->statuses().contains(id); });
            };
            (void)test::eventually([&] { return answered() == std::ssize(ids); }, answer_limit);
            answered_ += static_cast<std::uint64_t>(answered());
            for (const std::string& id : ids)
                attempt([&] { peer->dispose(test::raw_request(options_.match, id, 0)); });
        });
    }

    // Each with a participant of its own and one observer, who has to see it; then half of them end as they
    // should, and the others are gone without a word.
    void play_passing_matches() {
        flood([&](const std::vector<std::string>& ids, std::uint64_t /*batch*/) {
            std::vector<PassingMatch> matches;
            for (const std::string& id : ids)
                matches.emplace_back(options_.domain, id);
            const auto is_watched = [](const PassingMatch& match) { return match.seen >= passing_frames; };
            const auto limit = Clock::now() + test::patience;
            for (std::uint32_t number = 0; !std::ranges::all_of(matches, is_watched); ++number) {
                if (Clock::now() > limit) throw std::runtime_error("an observer does not see its match");
                for (PassingMatch& match : matches)
                    match.go_on(number);
                std::this_thread::sleep_for(frame_interval);
            }
            for (std::size_t i = 0; i < matches.size(); i += 2)
                matches[i].end();
            answered_ += ids.size();
        });
    }

    // Each of a partition of its own.
    void flood_with_matches() {
        flood([&](const std::vector<std::string>& ids, std::uint64_t /*batch*/) {
            std::vector<std::string> partitions;
            for (const std::string& id : ids)
                partitions.push_back("match/" + id);
            RawPeer peer(options_.domain, ids.front(), partitions);
            for (const std::string& id : ids)
                attempt([&] { peer.write(match_info(id, 1, "map")); });
            (void)test::eventually([&] { return peer.served_matches() == ids.size(); }, answer_limit);
            answered_ += peer.served_matches();
            for (const std::string& id : ids) {
                attempt([&] { peer.write(RawPoseFrame(id, 1, 0, players).sample()); });
                attempt([&] { peer.dispose(match_info(id, 1, "map")); });
            }
        });
    }

    void print() const { std::cout << "written " << written_ << "\nanswered " << answered_ << '\n'; }

  private:
    [[nodiscard]] bool is_over() const {
        return Clock::now() - begun_ >= std::chrono::duration<double>(options_.seconds);
    }

    // What the domain does not take in time is lost.
    static void attempt(const std::function<void()>& write) {
        try {
            write();
        } catch (const std::runtime_error&) {
        }
    }

    void play(const std::string& match, const camera_director_MatchInfo& info) {
        RawPeer peer(options_.domain, match);
        peer.write(info);
        peer.write(test::raw_request(match, "viewer", 0));
        send_poses(peer, match, info.epoch, std::chrono::hours(1));
        peer.dispose(info);
    }

    void send_poses(RawPeer& peer, const std::string& match, std::uint64_t epoch, Clock::duration duration) {
        const auto end = Clock::now() + duration;
        for (std::uint32_t number = 0; !is_over() && Clock::now() < end; ++number) {
            RawPoseFrame frame(match, epoch, number, players);
            attempt([&] { peer.write(frame.sample()); });
            std::this_thread::sleep_for(frame_interval);
        }
    }

    void spoil(RawPoseFrame& frame) {
        std::vector<float>* const arrays[] = {&frame.eye, &frame.orientation, &frame.velocity};
        std::vector<float>& array = *arrays[random_() % std::size(arrays)];
        switch (random_() % 6) {
            case 0:
                std::ranges::fill(array, std::numeric_limits<float>::quiet_NaN());
                break;
            case 1:
                array[random_() % array.size()] = std::numeric_limits<float>::infinity();
                break;
            case 2:
                array.resize(random_() % (2 * array.size()));
                break;
            case 3:
                frame.flags.resize(random_() % 8);
                break;
            case 4:
                frame.player_id.resize(300, 0);
                break;
            default:
                std::ranges::fill(array, 1e30F);
        }
    }

    // options_.count ids in batches, evenly over options_.seconds.
    void flood(const std::function<void(const std::vector<std::string>& ids, std::uint64_t batch)>& pass) {
        const std::uint64_t batches = (options_.count + options_.batch - 1) / options_.batch;
        const std::chrono::duration<double> interval(options_.seconds / static_cast<double>(batches));
        for (std::uint64_t batch = 0; batch < batches && !is_over(); ++batch) {
            std::vector<std::string> ids;
            for (; ids.size() < options_.batch && written_ < options_.count; ++written_)
                ids.push_back("x-" + std::to_string(options_.seed) + '-' + std::to_string(written_));
            pass(ids, batch);
            std::this_thread::sleep_until(
                begun_ + std::chrono::duration_cast<Clock::duration>(interval * (batch + 1)));
        }
    }

    const Options& options_;
    std::minstd_rand random_;
    Clock::time_point begun_;
    std::uint64_t written_ = 0, answered_ = 0;
};

// By their names in scenarios.
const std::map<std::string, void (Stranger::*)()> acts = {
    {"flapping_match", &Stranger::flap},
    {"unknown_map", &Stranger::play_unknown_map},
    {"wrong_hash", &Stranger::play_wrong_hash},
    {"garbage_poses", &Stranger::send_garbage},
    {"backward_time", &Stranger::run_backwards},
    {"usurper", &Stranger::usurp},
    {"flood_observers", &Stranger::flood_with_observers},
    {"flood_matches", &Stranger::flood_with_matches},
    {"passing_matches", &Stranger::play_passing_matches},
};

void run(const Options& options) {
    stand_for_another_machine();
    Stranger stranger(options);
    (stranger.*acts.at(options.act))();
    stranger.print();
}

}  // namespace
}  // namespace camdir::soak

int main(int argc, char** argv) {
    using namespace camdir;
    soak::Options options;
    CLI::App app("Does what game servers and observers of the SDK do not.", "stranger");
    std::vector<std::string> names;
    for (const auto& [name, act] : soak::acts)
        names.push_back(name);
    app.add_option("act", options.act)->required()->check(CLI::IsMember(names));
    app.add_option("--domain", options.domain, "DDS domain")->required();
    app.add_option("--match", options.match, "A real match, whose observers are viewer-0, ...")->required();
    app.add_option("--seconds", options.seconds, "Duration")->capture_default_str();
    app.add_option("--count", options.count, "Of a flood")->capture_default_str();
    app.add_option("--batch", options.batch, "At a time")->check(CLI::Range(1, 256))->capture_default_str();
    app.add_option("--seed", options.seed, "Another one gives other names and garbage")
        ->capture_default_str();
    const int status = test::run_program(app, argc, argv, [&] {
        soak::run(options);
        return 0;
    });
    dds_delete(DDS_CYCLONEDDS_HANDLE);  // before the library's static objects go
    return status;
}
