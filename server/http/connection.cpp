#include "http/connection.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <exception>
#include <utility>

#include "http/live_connection.hpp"
#include "recording/percent.hpp"

namespace camdir::http {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;

constexpr std::size_t max_header = 16 * 1024;  // enough for a browser's
constexpr std::size_t max_body = 4 * 1024;
constexpr std::size_t chunk = 4 * 1024;
// Of what was sent to a client and has not arrived: who reads slowly holds no more of the system's memory,
// and takes no more of the thread's time at once.
constexpr int send_buffer = 128 * 1024;
constexpr std::uint64_t least_rate = 64 * 1024;  // bytes a second, of a large answer
// So much of what follows an answer to an unread request is taken: the system would else reset the
// connection, and the client might not see the answer.
constexpr std::size_t max_discarded = 256 * 1024;
constexpr std::chrono::seconds discarding{2};

std::optional<Bound> bound_of(Status status) {
    if (status == Status::request_header_fields_too_large) return Bound::header_size;
    if (status == Status::payload_too_large) return Bound::body_size;
    return std::nullopt;
}

// What is answered when a request cannot be read; nullopt: nothing, because the connection is lost.
std::optional<Status> status_of(const beast::error_code& unread) {
    using beast::http::error;
    if (unread == error::header_limit || unread == error::buffer_overflow)
        return Status::request_header_fields_too_large;
    if (unread == error::body_limit) return Status::payload_too_large;
    if (unread == error::end_of_stream || unread == error::partial_message) return std::nullopt;
    const bool of_http = unread.category() == make_error_code(error::bad_method).category();
    return of_http ? std::optional(Status::bad_request) : std::nullopt;
}

// What fails for one request, as where no memory is left, is no reason to end the others.
Response made(const Page& page, const Sources& sources, const Request& request) {
    try {
        return answer(request, page.make(sources, below(page, request)));
    } catch (const std::exception& error) {
        spdlog::error("http: {}: {}", page.path, error.what());
        return refusal(request, Status::internal_server_error);
    }
}

}  // namespace

std::uint64_t Connections::move_to_end(std::uint64_t place, beast::tcp_stream& connection) {
    by_place_.erase(place);
    by_place_.emplace(++last_place_, &connection);
    return last_place_;
}

bool Connections::close_oldest() {
    if (by_place_.empty()) return false;
    by_place_.begin()->second->close();
    by_place_.erase(by_place_.begin());
    return true;
}

Connection::Connection(asio::ip::tcp::socket socket, Site& site)
    : stream_(std::move(socket)), site_(site), buffer_(max_header + chunk) {
    ErrorCode ignored;
    stream_.socket().set_option(asio::socket_base::send_buffer_size(send_buffer), ignored);
}

Connection::~Connection() {
    end_slow_page();
    site_.connections.leave(place_);
}

void Connection::wait_for_request() {
    place_ = site_.connections.move_to_end(place_, stream_);
    if (buffer_.size() > 0) return read_request();
    stream_.expires_after(site_.limits.idle);
    stream_.async_read_some(buffer_.prepare(chunk),
                            [self = shared_from_this()](ErrorCode error, std::size_t size) {
                                if (error) return self->note_time(error, Bound::idle_time);
                                self->buffer_.commit(size);
                                self->read_request();
                            });
}

void Connection::read_request() {
    parser_.emplace();
    parser_->header_limit(max_header);
    parser_->body_limit(max_body);
    stream_.expires_after(site_.limits.request);
    beast::http::async_read(
        stream_, buffer_, *parser_,
        [self = shared_from_this()](ErrorCode error, std::size_t) { self->handle(error); });
}

void Connection::handle(ErrorCode error) {
    place_ = site_.connections.move_to_end(place_, stream_);
    if (!error) return serve(parser_->release());
    note_time(error, Bound::request_time);
    const auto status = status_of(error);
    if (!status) return;
    if (const auto bound = bound_of(*status)) site_.bounds_reached->add(*bound);
    Request unread;
    unread.keep_alive(false);
    send(refusal(unread, *status));
}

void Connection::note_time(ErrorCode error, Bound bound) {
    if (error == beast::error::timeout) site_.bounds_reached->add(bound);
}

void Connection::serve(Request request) {
    const File* file = site_.files.find(path_of(request));
    const Page* page = file != nullptr ? &file_page : find_page(request);
    if (auto refused = check(request, page, site_.access)) return send(std::move(*refused));
    if (file != nullptr) return send(answer(request, content_of(*file, request)));
    if (page->make == nullptr) return watch(*page, std::move(request));
    if (page->prompt) return send(answer(request, page->make(site_.sources, below(*page, request))));
    if (site_.slow_pages >= site_.limits.slow_pages) {
        site_.bounds_reached->add(Bound::slow_pages);
        return send(refusal(request, Status::service_unavailable));
    }
    make(*page, std::move(request));
}

void Connection::watch(const Page& page, Request request) {
    if (const auto status = LiveConnection::refusal_of(request)) return send(refusal(request, *status));
    const auto live = std::make_shared<LiveConnection>(site_);
    const std::string_view name = below(page, request).substr(1);
    switch (site_.sources.join(recording::percent_decoded(name).value_or(""), live->viewer())) {
        case live::Relay::Admission::no_match:
            return send(refusal(request, Status::not_found));
        case live::Relay::Admission::full:
            site_.bounds_reached->add(Bound::viewers);
            return send(refusal(request, Status::service_unavailable));
        case live::Relay::Admission::joined:
            break;
    }
    site_.connections.leave(place_);
    live->accept(std::move(stream_), request);
}

void Connection::make(const Page& page, Request request) {
    ++site_.slow_pages;
    has_slow_page_ = true;
    asio::post(site_.makers, [self = shared_from_this(), &page, request = std::move(request)]() mutable {
        Response response = made(page, self->site_.sources, request);
        auto& io = self->site_.io;
        asio::post(io, [self = std::move(self), response = std::move(response)]() mutable {
            self->send(std::move(response));
        });
    });
}

void Connection::send(Response response) {
    response_ = std::move(response);
    serializer_.emplace(response_);
    const std::chrono::seconds for_size(response_.payload_size().value_or(0) / least_rate);
    answer_until_ = Clock::now() + site_.limits.answer + for_size;
    send_more();
}

// The client takes some of it in time, and all of it at no less than the least rate.
void Connection::send_more() {
    stream_.expires_at(std::min(Clock::now() + site_.limits.answer, answer_until_));
    beast::http::async_write_some(stream_, *serializer_,
                                  [self = shared_from_this()](ErrorCode error, std::size_t) {
                                      if (error) return self->note_time(error, Bound::answer_time);
                                      if (!self->serializer_->is_done()) return self->send_more();
                                      self->sent();
                                  });
}

void Connection::sent() {
    end_slow_page();
    serializer_.reset();
    if (response_.need_eof()) return hang_up();
    response_ = {};
    wait_for_request();
}

void Connection::hang_up() {
    ErrorCode ignored;
    stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
    stream_.expires_after(discarding);
    discard_input();
}

void Connection::discard_input() {
    buffer_.clear();
    stream_.async_read_some(buffer_.prepare(chunk),
                            [self = shared_from_this()](ErrorCode error, std::size_t size) {
                                self->discarded_ += size;
                                if (!error && self->discarded_ < max_discarded) self->discard_input();
                            });
}

void Connection::end_slow_page() {
    if (std::exchange(has_slow_page_, false)) --site_.slow_pages;
}

}  // namespace camdir::http
