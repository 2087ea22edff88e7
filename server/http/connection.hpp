// Connections, all on the one thread that runs Site::io.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/serializer.hpp>
#include <map>
#include <memory>
#include <optional>

#include "http/bounds.hpp"
#include "http/files.hpp"
#include "http/pages.hpp"

namespace camdir::http {

// The connections in the order in which they began what they do: wait, read or answer.
class Connections {
  public:
    [[nodiscard]] std::size_t size() const { return by_place_.size(); }
    // Moves a connection from its place, 0 when it has none yet, to the last one, which is returned.
    [[nodiscard]] std::uint64_t move_to_end(std::uint64_t place, boost::beast::tcp_stream& connection);
    void leave(std::uint64_t place) { by_place_.erase(place); }
    // False when there is none.
    bool close_oldest();

  private:
    std::map<std::uint64_t, boost::beast::tcp_stream*> by_place_;
    std::uint64_t last_place_ = 0;
};

// What the connections of a server share.
struct Site {
    const Sources sources;
    const Limits limits;
    const Files files;
    Access access;
    const std::shared_ptr<BoundCounters> bounds_reached;
    Connections connections{};
    std::size_t slow_pages = 0;  // that are made or sent
    boost::asio::io_context io{1};
    // Of the pages that are not prompt. A thread more attaches itself: the constructor of a pool that can
    // start one of its threads, but not the next, waits for ever.
    boost::asio::thread_pool makers{1};
};

// Reads requests and answers them one after the other. What it waits for keeps it alive.
class Connection final : public std::enable_shared_from_this<Connection> {
  public:
    Connection(boost::asio::ip::tcp::socket socket, Site& site);
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;
    ~Connection();

    void wait_for_request();

  private:
    using ErrorCode = boost::beast::error_code;
    using Clock = std::chrono::steady_clock;

    void read_request();
    void handle(ErrorCode error);
    // Counts what has ended for want of time.
    void note_time(ErrorCode error, Bound bound);
    void serve(Request request);
    // Goes on as a stream of a match's messages.
    void watch(const Page& page, Request request);
    void make(const Page& page, Request request);
    void send(Response response);
    void send_more();
    void sent();
    void hang_up();
    void discard_input();
    void end_slow_page();

    boost::beast::tcp_stream stream_;
    Site& site_;
    std::uint64_t place_ = 0;           // in Connections
    boost::beast::flat_buffer buffer_;  // read and not yet parsed
    std::optional<boost::beast::http::request_parser<boost::beast::http::string_body>> parser_;
    Response response_;
    std::optional<boost::beast::http::response_serializer<SharedText>> serializer_;  // while it is sent
    Clock::time_point answer_until_{};
    bool has_slow_page_ = false;
    std::size_t discarded_ = 0;  // bytes after the last request
};

}  // namespace camdir::http
