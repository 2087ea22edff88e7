#include "http/server.hpp"

#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <filesystem>
#include <thread>
#include <utility>

#include "http/connection.hpp"
#include "http/metrics.hpp"

namespace camdir::http {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds beat_period{200};
constexpr std::chrono::milliseconds retry_delay{50};  // of accepting, when the system refused
// Files that the rest of the process may open: maps, sockets of DDS.
constexpr rlim_t reserved_files = 256;
constexpr rlim_t min_connections = 16;

Limits within_open_files(Limits limits) {
    rlimit files{};
    if (::getrlimit(RLIMIT_NOFILE, &files) != 0) return limits;
    const rlim_t left = std::max(files.rlim_cur, reserved_files + min_connections) - reserved_files;
    limits.connections = std::min<rlim_t>(limits.connections, left);
    return limits;
}

Result<tcp::endpoint> resolve(const config::Http& config) {
    asio::io_context io;
    boost::system::error_code error;
    const auto found =
        tcp::resolver(io).resolve(config.address, std::to_string(config.port), tcp::resolver::passive, error);
    if (error) return fail("http: /http/address: \"" + config.address + "\": " + error.message());
    return found.begin()->endpoint();
}

// A program that was copied without its files serves all but the page.
Result<Files> read_files(const config::Http& config) {
    if (config.page.empty() && !std::filesystem::exists(default_page_folder())) return Files();
    auto files = Files::read(config.page.empty() ? default_page_folder() : std::filesystem::path(config.page),
                             three_of_debian());
    if (!files) return fail("http: /http/page: " + files.error().message);
    return files;
}

void warn_of_missing(const Files& files) {
    if (files.find("/") == nullptr)
        spdlog::warn("http: there is no page at /: {} is missing", default_page_folder().string());
    else if (files.three_missing())
        spdlog::warn("http: the page at / draws nothing: {} is missing: install libjs-three",
                     three_of_debian().string());
}

}  // namespace

struct Server::Listener {
    ~Listener();
    void start_threads();
    void accept();
    void accept_waiting();
    void take(tcp::socket socket);
    void accept_later();
    void close_oldest(Bound bound);
    // Shows again and again that the thread goes on.
    void beat();

    const config::Http config;
    Site site;
    tcp::acceptor acceptor{site.io};
    asio::steady_timer retry{site.io};
    asio::steady_timer beats{site.io};
    std::atomic<Clock::time_point> next_beat{Clock::now()};
    tcp::endpoint endpoint{};
    std::thread thread{};
    std::thread maker{};
};

Server::Listener::~Listener() {
    site.io.stop();
    site.makers.stop();
    for (std::thread* one : {&thread, &maker})
        if (one->joinable()) one->join();
    site.makers.join();
}

void Server::Listener::start_threads() {
    thread = std::thread([this] { site.io.run(); });
    maker = std::thread([this] { site.makers.attach(); });
}

void Server::Listener::accept() {
    acceptor.async_accept([this](boost::system::error_code error, tcp::socket socket) {
        if (error) return accept_later();
        take(std::move(socket));
        accept_waiting();
        accept();
    });
}

// A probe is not to wait until the thread has turned to each of a crowd that came before it.
void Server::Listener::accept_waiting() {
    constexpr int most = 128;  // the system keeps few more
    for (int i = 0; i < most; ++i) {
        boost::system::error_code none;
        tcp::socket socket(site.io);
        acceptor.accept(socket, none);
        if (none) return;
        take(std::move(socket));
    }
}

void Server::Listener::take(tcp::socket socket) {
    if (site.connections.size() >= site.limits.connections) close_oldest(Bound::connections);
    std::make_shared<Connection>(std::move(socket), site)->wait_for_request();
}

// The process has no file or memory left: a connection gives its own back, once those that have come are
// answered.
void Server::Listener::accept_later() {
    retry.expires_after(retry_delay);
    retry.async_wait([this](boost::system::error_code) {
        close_oldest(Bound::files);
        accept();
    });
}

void Server::Listener::close_oldest(Bound bound) {
    if (site.connections.close_oldest()) site.bounds_reached->add(bound);
}

void Server::Listener::beat() {
    next_beat = Clock::now() + beat_period;
    beats.expires_after(beat_period);
    beats.async_wait([this](boost::system::error_code) { beat(); });
}

Result<std::unique_ptr<Server>> Server::start(const config::Http& config, Sources sources,
                                              const Limits& limits) {
    const auto endpoint = resolve(config);
    if (!endpoint) return tl::unexpected(endpoint.error());
    auto access = Access::load(config, endpoint->address().is_loopback());
    if (!access) return tl::unexpected(access.error());
    auto files = read_files(config);
    if (!files) return tl::unexpected(files.error());
    warn_of_missing(*files);
    const auto bounds_reached = std::make_shared<BoundCounters>();
    sources.metrics = [others = std::move(sources.metrics), bounds_reached] {
        auto families = others();
        families.push_back(bound_metrics(*bounds_reached));
        return families;
    };
    std::unique_ptr<Listener> listener(new Listener{config,
                                                    {std::move(sources), within_open_files(limits),
                                                     std::move(*files), std::move(*access), bounds_reached}});
    try {
        tcp::acceptor& acceptor = listener->acceptor;
        acceptor.open(endpoint->protocol());
        acceptor.set_option(tcp::acceptor::reuse_address(true));
        acceptor.bind(*endpoint);
        acceptor.listen();
        acceptor.non_blocking(true);
        listener->endpoint = acceptor.local_endpoint();
    } catch (const boost::system::system_error& error) {
        return fail("http: cannot listen on " + config.address + " port " + std::to_string(config.port) +
                    ": " + error.code().message());
    }
    listener->accept();
    listener->beat();
    listener->start_threads();
    return std::unique_ptr<Server>(new Server(std::move(listener)));
}

Result<void> Server::check(const config::Http& config) {
    const auto endpoint = resolve(config);
    if (!endpoint) return tl::unexpected(endpoint.error());
    const auto access = Access::load(config, endpoint->address().is_loopback());
    if (!access) return tl::unexpected(access.error());
    const auto files = read_files(config);
    if (!files) return tl::unexpected(files.error());
    return {};
}

Server::Server(std::unique_ptr<Listener> listener) : listener_(std::move(listener)) {}

Server::~Server() = default;

Result<void> Server::reload() {
    auto access = Access::load(listener_->config, listener_->endpoint.address().is_loopback());
    if (!access) return tl::unexpected(access.error());
    asio::post(listener_->site.io,
               [&site = listener_->site, access = std::move(*access)] { site.access = access; });
    return {};
}

std::uint16_t Server::port() const {
    return listener_->endpoint.port();
}

bool Server::responsive(std::chrono::nanoseconds limit) const {
    return Clock::now() - listener_->next_beat.load() <= limit;
}

}  // namespace camdir::http
