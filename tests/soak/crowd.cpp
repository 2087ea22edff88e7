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
        : name_("crowd-" + std::to_string(number)),
          connected_(Clock::now()),
          context_(camera_director::Context::open({.domain = options.domain, .directors = options.directors})
                       .value()),
          observer_(
              camera_director::Observer::open(
                  context_, options.match_prefix + '-' + std::to_string(number % options.matches), name_)
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
    // What it has instead of its camera.
    [[nodiscard]] std::string lack() const {
        const auto status = observer_.shot_status().value();
        const auto counters = observer_.counters().value();
        std::string text = name_ + ", for " + std::to_string(std::lround(waited())) +
                           " s: " + cdir_shot_state_name(status.state);
        if (status.reason[0] != '\0') text += " (" + std::string(status.reason) + ')';
        return text + ", " + std::to_string(counters.directors) + " directors, " +
               std::to_string(counters.frames) + " frames";
    }

  private:
    std::string name_;
    Clock::time_point connected_;
    camera_director::Context context_;
    camera_director::Observer observer_;
};

// The members that do not have their cameras yet.
class Queue {
  public:
    void enter(Member& member) { waiting_.push_back(&member); }

    // Those that have their cameras now leave.
    void look() {
        std::erase_if(waiting_, [&](Member* member) {
            if (!member->look(cameras_)) return false;
            longest_wait_ = std::max(longest_wait_, member->waited());
            return true;
        });
    }
    void wait_until_empty(Clock::time_point limit) {
        while (!waiting_.empty()) {
            if (Clock::now() > limit) throw std::runtime_error(lacks());
            std::this_thread::sleep_for(std::chrono::milliseconds(50));  // a hundred processes do
            look();
        }
    }
    [[nodiscard]] double longest_wait() const { return longest_wait_; }

  private:
    [[nodiscard]] std::string lacks() const {
        std::string text = std::to_string(waiting_.size()) + " observers do not see their cameras:";
        for (const Member* member : waiting_)
            text += '\n' + member->lack();
        return text;
    }

    std::vector<Member*> waiting_;
    std::vector<camera_director::Camera> cameras_ = std::vector<camera_director::Camera>(CDIR_MAX_CAMERAS);
    double longest_wait_ = 0.0;
};

void run(const Options& options) {
    stand_for_one_of_many_machines();
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(options.seconds));
    std::vector<Member> members;
    members.reserve(options.count);
    Queue queue;
    for (std::uint32_t i = 0; i < options.count; ++i) {
        queue.enter(members.emplace_back(options, options.first + i));
        queue.look();  // to open the others takes seconds where hundreds do
    }
    queue.wait_until_empty(end);
    std::cout << "answered " << members.size() << "\nlongest_wait_ms "
              << std::lround(1e3 * queue.longest_wait()) << '\n';
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
