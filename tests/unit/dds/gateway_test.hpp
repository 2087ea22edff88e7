// For tests of the gateway: one that hands on to a recorder, and its peers.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "dds/gateway.hpp"
#include "support/eventually.hpp"
#include "support/raw_peer.hpp"
#include "support/test_domain.hpp"

namespace camdir::dds {

using test::eventually;
using test::RawPeer;
using test::RawPoseFrame;

// Records the calls of the gateway as lines.
class Recorder final : public director::Ingress {
  public:
    bool admit(const std::string& match_id) override {
        note("admit " + match_id);
        return accepts;
    }
    bool has_room() const override { return accepts; }
    bool receive(const director::MatchInfo& info) override {
        note("info " + info.match_id + " " + std::to_string(info.epoch));
        while (hangs)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        std::this_thread::sleep_for(begins_in.load());
        if (director::Publisher* publisher = shows_at_once) publisher->publish(info);
        return accepts;
    }
    void server_lost(const std::string& match_id) override { note("silent " + match_id); }
    void match_ended(const std::string& match_id) override { note("over " + match_id); }
    void receive(std::span<director::PoseArrival> arrivals) override {
        for (const auto& [match_id, frame] : arrivals) {
            note("pose " + match_id + " " + std::to_string(frame.frame_number));
            if (frame.movers) note("movers " + match_id + " " + in_words(*frame.movers));
        }
    }
    void receive(const std::string& match_id, const director::MatchEvent& event) override {
        note("event " + match_id + " " + std::to_string(event.kind) + " " + event.detail);
    }
    void receive(const director::ObserverRequest& request) override {
        note("request " + request.observer_id + " " + std::to_string(request.target));
    }
    void request_ended(const std::string& /*match_id*/, const std::string& observer_id) override {
        note("gone " + observer_id);
    }
    void follow(const std::string& match_id, const director::CameraFrame& shown) override {
        note("follow " + match_id + " " + std::to_string(shown.pose_number));
    }
    std::chrono::nanoseconds silence_limit(const director::MatchInfo& /*info*/) const override {
        return silence.load();
    }
    bool responsive(std::chrono::milliseconds /*limit*/) const override {
        ++questions;
        return answers;
    }

    [[nodiscard]] bool has(const std::string& line) const { return count(line) > 0; }
    [[nodiscard]] std::ptrdiff_t count(const std::string& line) const {
        const std::lock_guard lock(mutex_);
        return std::count(lines_.begin(), lines_.end(), line);
    }
    [[nodiscard]] std::vector<std::string> lines() const {
        const std::lock_guard lock(mutex_);
        return lines_;
    }

    std::atomic<bool> accepts{true};
    std::atomic<bool> answers{true};
    std::atomic<bool> hangs{false};  // as long as this is true, with a MatchInfo
    std::atomic<std::chrono::milliseconds> begins_in{std::chrono::milliseconds(0)};
    mutable std::atomic<int> questions{0};  // whether it is responsive
    std::atomic<std::chrono::nanoseconds> silence{std::chrono::hours(1)};
    std::atomic<director::Publisher*> shows_at_once{nullptr};

  private:
    // The shapes' names, and the time of the frame.
    static std::string in_words(const director::MatchMovers& movers) {
        std::string text;
        for (const director::Mover& mover : movers.info->movers)
            text += mover.shape.name + " ";
        return text + "at " + std::to_string(movers.frame->frame_time);
    }
    void note(std::string line) {
        const std::lock_guard lock(mutex_);
        lines_.push_back(std::move(line));
    }
    mutable std::mutex mutex_;
    std::vector<std::string> lines_;
};

class GatewayTest : public testing::Test {
  protected:
    void SetUp() override {
        config_.domain = domain_.id();
        config_.director_id = 77;
        auto gateway = Gateway::open(config_, limits_);
        ASSERT_TRUE(gateway) << gateway.error().message;
        gateway_ = std::move(*gateway);
        gateway_->start(recorder_);
    }
    void TearDown() override {
        // Before the gateway, which shuts down all of DDS in the process.
        peers_.clear();
        gateway_.reset();
    }

    RawPeer& peer(const std::string& match_id, const std::vector<std::string>& partitions = {}) {
        return *peers_.emplace_back(std::make_unique<RawPeer>(domain_.id(), match_id, partitions));
    }
    // A peer whose match the gateway has found and handed on, with all endpoints matched.
    RawPeer& game(const std::string& match_id, std::uint64_t epoch = 1) {
        const std::string line = "info " + match_id + " " + std::to_string(epoch);
        const std::ptrdiff_t before = recorder_.count(line);
        RawPeer& raw = peer(match_id);
        raw.write(test::raw_match_info(match_id, epoch));
        if (!eventually([&] { return raw.directors() == 1 && recorder_.count(line) > before; })) {
            throw std::runtime_error("the match was not found");
        }
        return raw;
    }
    // The same, of which the gateway writes what is published instead of keeping it.
    RawPeer& led_game(const std::string& match_id) {
        const std::uint32_t before = gateway_->counters().matches_led;
        RawPeer& raw = game(match_id);
        if (!eventually([&] { return gateway_->counters().matches_led > before; })) {
            throw std::runtime_error("the gateway does not lead the match");
        }
        return raw;
    }
    std::uint64_t dropped(Topic topic, ValidationError error) {
        return gateway_->counters().of(topic).dropped[static_cast<std::size_t>(error)];
    }
    // Poses are best effort: writes until one has arrived.
    bool arrives(RawPeer& raw, RawPoseFrame& frame, const std::string& line) {
        return eventually([&] {
            raw.write(frame.sample());
            return recorder_.has(line);
        });
    }
    // Writes poses, numbered after `number`, until the last one has arrived: then none is on its way.
    bool last_arrives(RawPeer& raw, const std::string& match_id, std::uint32_t number) {
        constexpr std::chrono::seconds lost{1};
        return eventually([&] {
            RawPoseFrame frame(match_id, 1, ++number, 1);
            raw.write(frame.sample());
            return eventually(
                [&] { return recorder_.has("pose " + match_id + " " + std::to_string(number)); }, lost);
        });
    }

    test::TestDomain domain_;
    config::Dds config_;
    config::Limits limits_;
    Recorder recorder_;
    std::unique_ptr<Gateway> gateway_;
    std::vector<std::unique_ptr<RawPeer>> peers_;
};

}  // namespace camdir::dds
