// A viewer's connection: a WebSocket that takes a match's messages.
#pragma once

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <memory>
#include <optional>

#include "http/connection.hpp"
#include "live/viewer.hpp"

namespace camdir::http {

// On the thread of Site::io. Viewers say nothing: a message of theirs closes the connection, and so does one
// that does not answer pings. What it waits for keeps it alive.
class LiveConnection final : public std::enable_shared_from_this<LiveConnection> {
  public:
    explicit LiveConnection(Site& site) : site_(site) {}
    LiveConnection(const LiveConnection&) = delete;
    LiveConnection& operator=(const LiveConnection&) = delete;
    ~LiveConnection();

    // Why a request for a stream is not served: it asks for no WebSocket, or another site's page has made it.
    [[nodiscard]] static std::optional<Status> refusal_of(const Request& request);

    // To join a match with, before accept().
    [[nodiscard]] std::shared_ptr<live::Viewer> viewer();
    void accept(boost::beast::tcp_stream stream, const Request& request);

  private:
    using ErrorCode = boost::beast::error_code;

    void read();
    void send_next();
    void close(boost::beast::websocket::close_code code, const char* reason);

    Site& site_;
    std::shared_ptr<live::Viewer> viewer_;
    std::optional<boost::beast::websocket::stream<boost::beast::tcp_stream>> stream_;
    std::uint64_t place_ = 0;  // in Connections
    boost::beast::flat_buffer received_;
    live::SharedMessage sending_;
    bool open_ = false;
};

}  // namespace camdir::http
