#include "session.hpp"

#include <algorithm>
#include <iostream>
#include <utility>
#include <vector>

#include "publisher.hpp"
#include "stream.hpp"

namespace camdir::qtv {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds patience = seconds(30);  // an idle server streams ten times a second
constexpr milliseconds patience_to_connect = seconds(10);
constexpr seconds shortest_wait{1};
constexpr seconds longest_wait{30};
constexpr std::size_t buffer_size = 1U << 16U;  // bytes

void log(const std::string& line) {
    std::cerr << "qtv-publisher: " + line + '\n';
}

// One connection.
class Session {
  public:
    Session(const Subscription& subscription, Publisher& publisher, const StopEvent& stop)
        : subscription_(subscription),
          publisher_(publisher),
          stop_(stop),
          lost_events_(publisher.lost_events()) {}

    // Returns why it has ended.
    [[nodiscard]] Error run() {
        auto connection = Connection::open(subscription_.server, patience_to_connect, stop_);
        if (!connection) return connection.error();
        if (const auto sent = connection->send(text_of(subscription_.request)); !sent) return sent.error();
        publisher_.begin_stream();
        std::vector<std::byte> buffer(buffer_size);
        while (true) {
            const auto received = connection->receive(buffer, patience);
            if (!received) return received.error();
            if (received->empty()) return {"the server has closed the connection"};
            stream_.append(*received);
            if (const auto taken = take_updates(); !taken) return taken.error();
        }
    }

    [[nodiscard]] bool refused() const { return refused_; }
    [[nodiscard]] bool has_published() const { return has_published_; }

  private:
    Result<void> take_updates() {
        while (true) {
            const auto update = stream_.next();
            if (!update) return tl::unexpected(update.error());
            if (!*update) break;
            const auto taken = std::visit([this](const auto& said) { return take(said); }, **update);
            if (!taken) return taken;
        }
        tell_unread();
        tell_lost_events();
        tell_directors();
        return {};
    }

    Result<void> take(const Answer& answer) {
        if (answer.kind == Answer::Kind::begin) {
            log("streaming from " + text_of(subscription_.server));
            return {};
        }
        refused_ = answer.kind == Answer::Kind::refused;
        return fail("the server refuses the stream: " + answer.reason);
    }

    Result<void> take(const Match& match) {
        if (match.level != level_) log("map " + match.map);
        level_ = match.level;
        return publisher_.announce(match);
    }

    Result<void> take(const quakeworld::TrackedFrame& frame) {
        has_published_ = true;
        return publisher_.publish(frame);
    }

    void tell_unread() {
        if (told_unread_ || stream_.first_unread().empty()) return;
        told_unread_ = true;
        log("part of the stream cannot be read: " + stream_.first_unread());
    }

    // Twice as many each time: a director that hangs loses all.
    void tell_lost_events() {
        const std::uint64_t lost = publisher_.lost_events();
        if (lost <= 2 * lost_events_) return;
        lost_events_ = lost;
        log(std::to_string(lost) + " events were not sent so far: a director is too far behind");
    }

    void tell_directors() {
        const std::uint32_t directors = publisher_.directors();
        if (directors != directors_) log("directors: " + std::to_string(directors));
        directors_ = directors;
    }

    const Subscription& subscription_;
    Publisher& publisher_;
    const StopEvent& stop_;
    Stream stream_;
    std::uint32_t level_ = 0;
    std::uint32_t directors_ = 0;
    std::uint64_t lost_events_;  // that were told
    bool refused_ = false;
    bool has_published_ = false;
    bool told_unread_ = false;
};

}  // namespace

Result<void> publish_stream(const Subscription& subscription, const camera_director::Context& context,
                            const StopEvent& stop) {
    Publisher publisher(context, subscription.match_id);
    seconds wait = shortest_wait;
    while (true) {
        Session session(subscription, publisher, stop);
        const Error ended = session.run();
        if (ended.code == ErrorCode::interrupted) return {};
        const std::string line = text_of(subscription.server) + ": " + ended.message;
        if (session.refused()) return fail(line);
        if (session.has_published()) wait = shortest_wait;
        log(line + "; connecting again in " + std::to_string(wait.count()) + " s");
        if (stop.wait(wait)) return {};
        wait = std::min(2 * wait, longest_wait);
    }
}

}  // namespace camdir::qtv
