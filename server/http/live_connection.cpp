#include "http/live_connection.hpp"

#include <boost/asio/post.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <string_view>
#include <utility>

#include "http/letter_case.hpp"

namespace camdir::http {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using beast::http::field;

constexpr const char* subprotocol = "camera-director.v1";
constexpr std::size_t max_received = 1024;
// What the system keeps of frames is old when it arrives: a second or two are enough.
constexpr int system_buffer = 64 * 1024;

// Browsers say which site's page asks; other clients say nothing.
bool is_of_this_site(const Request& request) {
    if (request.count(field::origin) == 0) return true;
    const auto origin = request[field::origin];
    const std::string_view text(origin.data(), origin.size());
    const std::size_t scheme = text.find("://");
    const auto host = request[field::host];
    return scheme != std::string_view::npos &&
           equal_without_case(text.substr(scheme + 3), {host.data(), host.size()});
}

bool offers_subprotocol(const Request& request) {
    const auto offers = request[field::sec_websocket_protocol];
    return std::string_view(offers.data(), offers.size()).find(subprotocol) != std::string_view::npos;
}

}  // namespace

std::optional<Status> LiveConnection::refusal_of(const Request& request) {
    if (!websocket::is_upgrade(request)) return Status::upgrade_required;
    if (!is_of_this_site(request)) return Status::forbidden;
    return std::nullopt;
}

LiveConnection::~LiveConnection() {
    if (viewer_) viewer_->leave();
    site_.connections.leave(place_);
}

std::shared_ptr<live::Viewer> LiveConnection::viewer() {
    viewer_ = std::make_shared<live::Viewer>([self = weak_from_this(), &io = site_.io] {
        asio::post(io, [self] {
            if (const auto alive = self.lock()) alive->send_next();
        });
    });
    return viewer_;
}

void LiveConnection::accept(beast::tcp_stream stream, const Request& request) {
    stream_.emplace(std::move(stream));
    auto& socket = beast::get_lowest_layer(*stream_);
    socket.expires_never();  // the WebSocket has its own times
    ErrorCode ignored;
    socket.socket().set_option(asio::socket_base::send_buffer_size(system_buffer), ignored);
    socket.socket().set_option(asio::ip::tcp::no_delay(true), ignored);
    place_ = site_.connections.move_to_end(place_, socket);
    stream_->read_message_max(max_received);
    stream_->auto_fragment(false);
    stream_->set_option(websocket::stream_base::timeout{site_.limits.answer, site_.limits.answer, true});
    if (offers_subprotocol(request))
        stream_->set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
            response.set(field::sec_websocket_protocol, subprotocol);
        }));
    stream_->async_accept(request, [self = shared_from_this()](ErrorCode error) {
        if (error) return;
        self->open_ = true;
        self->read();
        self->send_next();
    });
}

void LiveConnection::read() {
    stream_->async_read(received_, [self = shared_from_this()](ErrorCode error, std::size_t) {
        if (error == websocket::error::message_too_big || !error)
            self->site_.bounds_reached->add(Bound::viewer_messages);
        if (!error) return self->close(websocket::close_code::policy_error, "viewers send nothing");
        self->open_ = false;
    });
}

void LiveConnection::send_next() {
    if (!open_ || sending_) return;
    if (viewer_->lost()) {
        open_ = false;
        return beast::get_lowest_layer(*stream_).close();
    }
    sending_ = viewer_->take();
    if (!sending_) {
        if (viewer_->finished()) close(websocket::close_code::normal, "that was all");
        return;
    }
    stream_->binary(sending_->kind == live::Message::Kind::frame);
    stream_->async_write(asio::buffer(sending_->content),
                         [self = shared_from_this()](ErrorCode error, std::size_t) {
                             self->sending_ = nullptr;
                             if (error) return;
                             auto& socket = beast::get_lowest_layer(*self->stream_);
                             self->place_ = self->site_.connections.move_to_end(self->place_, socket);
                             self->send_next();
                         });
}

void LiveConnection::close(websocket::close_code code, const char* reason) {
    if (!std::exchange(open_, false)) return;
    stream_->async_close({code, reason}, [self = shared_from_this()](ErrorCode) {});
}

}  // namespace camdir::http
