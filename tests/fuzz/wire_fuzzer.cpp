#include <spdlog/spdlog.h>

#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>

#include "dds/decode.hpp"
#include "dds/encode.hpp"
#include "dds/sent_movers.hpp"
#include "director/director.hpp"
#include "support/descriptions.hpp"
#include "support/freespace_meshes.hpp"
#include "wire_input.hpp"

namespace camdir {
namespace {

constexpr int max_records = 32;

bool finite(const float* values, std::size_t count) {
    return std::all_of(values, values + count, [](float value) { return std::isfinite(value); });
}

// Encodes what is published, as for DDS.
class Encoder final : public director::Publisher {
  public:
    void publish(const director::MatchInfo& shown) override {
        dds::ShownMatchEncoder encoder;
        const auto sample = test::described_as<camera_director_MatchInfo>(encoder.encode(shown));
        director::MatchInfo again;
        assert(!dds::decode(sample, again));
    }
    void end(const std::string& /*match_id*/) override {}
    void publish(const std::string& match_id, const director::CameraFrame& frame) override {
        dds::CameraFrameEncoder encoder(match_id, 1);
        const camera_director_CameraFrame& sample = encoder.encode(frame, 0);
        assert(finite(sample.position._buffer, sample.position._length));
        director::CameraFrame again;
        assert(!dds::decode(sample, again));
    }
    bool publish(const director::ObserverStatus& status) override {
        const camera_director_ObserverStatus sample = dds::encode(status);
        assert(sample.state <= 3);
        return true;
    }
    void withdraw(const std::string& /*match_id*/, const std::string& /*observer_id*/) override {}
    void forget(const std::string& /*match_id*/) override {}
    void give_up(const std::string& /*match_id*/) override {}
};

config::Config configuration() {
    config::Config config;
    config.profiles["default"];
    config.limits.workers = 1;
    return config;
}

const director::MapLibrary& maps() {
    static director::MapLibrary library;
    static const bool filled = [] {
        library.add("square", false);
        library.set_ready("square", test::make_freespace(test::square_contents()));
        return true;
    }();
    (void)filled;
    return library;
}

// A director that takes what is valid, from whatever match.
class Receiver {
  public:
    Receiver() {
        (void)ownership_.describe({sender_, 1, {}}, now_);
        (void)movers_.admit(sender_, 1, ownership_);
    }

    void take(const fuzz::WireRecord& record) {
        const std::span fields = record.fields;
        switch (record.topic % 8) {
            case 0:
                return take<camera_director_MatchInfo, director::MatchInfo>(
                    camera_director_MatchInfo_desc, fields, [&](const auto& /*match_id*/, const auto& info) {
                        if (director_.admit(info.match_id)) director_.receive(info);
                    });
            case 1:
                return take<camera_director_PoseFrame, director::PoseFrame>(
                    camera_director_PoseFrame_desc, fields, [&](const auto& match_id, const auto& frame) {
                        director::PoseArrival arrival{match_id, frame};
                        arrival.frame.movers = movers_.at(sender_, frame.epoch, frame.frame_time);
                        director_.receive({&arrival, 1});
                    });
            case 2:
                return take<camera_director_MatchEvent, director::MatchEvent>(
                    camera_director_MatchEvent_desc, fields,
                    [&](const auto& match_id, const auto& event) { director_.receive(match_id, event); });
            case 3:
                return take<camera_director_ObserverRequest, director::ObserverRequest>(
                    camera_director_ObserverRequest_desc, fields,
                    [&](const auto& /*match_id*/, const auto& request) { director_.receive(request); });
            case 4:
                return take<camera_director_CameraFrame, director::CameraFrame>(
                    camera_director_CameraFrame_desc, fields,
                    [&](const auto& match_id, const auto& shown) { director_.follow(match_id, shown); });
            case 6:
                return take<camera_director_MoverInfo, director::MoverInfo>(
                    camera_director_MoverInfo_desc, fields, [&](const auto& /*match_id*/, const auto& info) {
                        movers_.put(sender_, std::make_shared<director::MoverInfo>(info), false);
                        while (movers_.bound_next(ownership_)) {
                        }
                    });
            case 7:
                return take<camera_director_MoverFrame, director::MoverFrame>(
                    camera_director_MoverFrame_desc, fields,
                    [&](const auto& /*match_id*/, const auto& frame) {
                        movers_.put(sender_, std::make_shared<director::MoverFrame>(frame));
                    });
            default:
                return take<camera_director_DirectorSign, dds::Sign>(
                    camera_director_DirectorSign_desc, fields,
                    [&](const auto& /*match_id*/, const auto& sign) { see(sign); });
        }
    }

  private:
    template <class Sample, class Message, class Pass>
    void take(const dds_topic_descriptor_t& type, std::span<const std::uint8_t> fields, const Pass& pass) {
        const fuzz::ReceivedSample<Sample> sample(type, fields);
        if (!sample) return;
        Message message{};
        if (dds::decode(*sample, message)) return;
        pass(std::string((*sample).match_id), message);
        director_.flush();
    }

    void see(const dds::Sign& sign) {
        now_ += std::chrono::milliseconds(50);
        succession_.see(sign, now_);
        succession_.live(now_);
        succession_.decide(now_);
        assert(succession_.next_change(now_) >= now_);
    }

    static constexpr dds::SenderId sender_{1};
    dds::Ownership ownership_;
    dds::SentMovers movers_;  // of whatever match
    Encoder encoder_;
    director::Director director_{configuration(), maps(), encoder_};
    dds::Succession::Time now_{};
    dds::Succession succession_{77, 1, std::chrono::milliseconds(200), now_};
};

}  // namespace
}  // namespace camdir

// Whatever the bytes, as samples from other programs: the director drops them, or publishes what observers
// can read.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    spdlog::set_level(spdlog::level::off);
    camdir::Receiver receiver;
    std::span<const std::uint8_t> bytes(data, size);
    for (int i = 0; i < camdir::max_records; ++i) {
        const auto record = camdir::fuzz::next_record(bytes);
        if (!record) break;
        receiver.take(*record);
    }
    return 0;
}
