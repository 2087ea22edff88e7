// crowd: observers that all connect at once, each with a participant of its own; how long the last of them
// waits for its camera.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <camera_director/camera_director.hpp>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "soak/priority.hpp"
#include "support/program.hpp"

namespace camdir::soak {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
    std::uint32_t domain = 0;
    std::string directors;
    std::string match_prefix;
    std::uint32_t matches = 1, players = 1;
    std::uint32_t first = 0, count = 1;
    double seconds = 30.0;
};

class Member {
  public:
    Member(const Options& options, std::uint32_t number)
        : connected_(Clock::now()),
          context_(camera_director::Context::open({.domain = options.domain, .directors = options.directors})
                       .value()),
          observer_(camera_director::Observer::open(
                        context_, options.match_prefix + '-' + std::to_string(number % options.matches),
                        "crowd-" + std::to_string(number))
                        .value()) {
        observer_.request({.target = number / options.matches % options.players}).value();
    }

    // Takes the frames that have come. Whether one of them had its camera.
    bool look(std::vector<camera_director::Camera>& cameras) {
        while (const auto frame = observer_.next_frame(cameras).value()) {
            const auto status = observer_.shot_status().value();
            const auto end = cameras.begin() + frame->camera_count;
            if (status.state == CDIR_SHOT_ACCEPTED &&
                std::any_of(cameras.begin(), end,
                            [&](const auto& camera) { return camera.camera_id == status.camera_id; }))
                return true;
        }
        return false;
    }
    [[nodiscard]] double waited() const {
        return std::chrono::duration<double>(Clock::now() - connected_).count();
    }

  private:
    Clock::time_point connected_;
    camera_director::Context context_;
    camera_director::Observer observer_;
};

// Of the member that waits longest.
double wait_for_all(std::vector<Member>& members, Clock::time_point limit) {
    std::vector<camera_director::Camera> cameras(CDIR_MAX_CAMERAS);
    std::vector<Member*> waiting;
    for (Member& member : members)
        waiting.push_back(&member);
    double longest = 0.0;
    while (!waiting.empty()) {
        std::erase_if(waiting, [&](Member* member) {
            if (!member->look(cameras)) return false;
            longest = std::max(longest, member->waited());
            return true;
        });
        if (Clock::now() > limit)
            throw std::runtime_error(std::to_string(waiting.size()) + " observers do not see their cameras");
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return longest;
}

void run(const Options& options) {
    stand_for_another_machine();
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(options.seconds));
    std::vector<Member> members;
    members.reserve(options.count);
    for (std::uint32_t i = 0; i < options.count; ++i)
        members.emplace_back(options, options.first + i);
    const double longest = wait_for_all(members, end);
    std::cout << "answered " << members.size() << "\nlongest_wait_ms " << std::lround(1e3 * longest) << '\n';
    std::this_thread::sleep_until(end);
}

}  // namespace
}  // namespace camdir::soak

int main(int argc, char** argv) {
    using namespace camdir;
    soak::Options options;
    CLI::App app("Observers that all connect at once.", "crowd");
    app.add_option("--domain", options.domain, "DDS domain")->required();
    app.add_option("--directors", options.directors, "Directors' addresses, separated by commas")->required();
    app.add_option("--match-prefix", options.match_prefix, "Observes PREFIX-0, PREFIX-1, ... in turn")
        ->required();
    app.add_option("--matches", options.matches)->check(CLI::Range(1, 4096))->capture_default_str();
    app.add_option("--players", options.players, "Of a match")
        ->check(CLI::Range(1, 256))
        ->capture_default_str();
    app.add_option("--first", options.first, "Number of the first observer")->capture_default_str();
    app.add_option("--count", options.count, "Observers")->check(CLI::Range(1, 256))->capture_default_str();
    app.add_option("--seconds", options.seconds, "How long they stay, and wait at most")
        ->capture_default_str();
    return test::run_program(app, argc, argv, [&] {
        soak::run(options);
        return 0;
    });
}
