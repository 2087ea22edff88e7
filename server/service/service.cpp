#include "service/service.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <iterator>
#include <sstream>

#include "http/metrics.hpp"
#include "http/status.hpp"
#include "maps/guarded.hpp"
#include "service/heap.hpp"
#include "service/logging.hpp"
#include "service/recording_metrics.hpp"
#include "service/supervisor.hpp"
#include "service/viewers.hpp"
#include "service/wire_metrics.hpp"

namespace camdir::service {
namespace {

constexpr std::chrono::milliseconds watch_period{200};
constexpr std::chrono::seconds trim_period(10);
constexpr std::chrono::seconds start_extension{60};
constexpr std::chrono::milliseconds max_turn{5000};  // whoever takes longer has hung
constexpr std::chrono::milliseconds view_timeout{500};
constexpr std::chrono::seconds live_list_age{1};          // every viewer asks for it every few seconds
constexpr std::chrono::milliseconds viewers_leave{1000};  // a stop waits so long for them

void log_lines(spdlog::level::level_enum level, const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        spdlog::log(level, "{}", line);
}

std::unique_ptr<recording::Recorder> make_recorder(const config::Recording& config) {
    if (config.folder.empty()) return nullptr;
    recording::RecorderOptions options;
    options.folder = config.folder;
    options.max_bytes = static_cast<std::uint64_t>(config.disk_mib) << 20U;
    options.max_match_bytes = static_cast<std::uint64_t>(config.match_mib) << 20U;
    options.director_version = CAMERA_DIRECTOR_VERSION;
    return std::make_unique<recording::Recorder>(std::move(options));
}

}  // namespace

Result<std::unique_ptr<Service>> Service::open(std::filesystem::path file, std::string shard,
                                               config::Config config) {
    auto gateway = dds::Gateway::open(config.dds, config.limits);
    if (!gateway) return tl::unexpected(gateway.error());
    std::unique_ptr<Service> service(
        new Service(std::move(file), std::move(shard), std::move(config), std::move(*gateway)));
    const config::Http& http = service->config_.http;
    if (http.enabled) {
        if (auto usable = http::Server::check(http); !usable) return tl::unexpected(usable.error());
        auto server = http::Server::start(http, service->sources());
        if (!server)
            return fail(
                server.error().message +
                "; set /http/port or /http/address to another, or stop the program that listens there");
        service->http_ = std::move(*server);
        spdlog::info("http: listening on {} port {}", http.address, service->http_->port());
    }
    return service;
}

Service::Service(std::filesystem::path file, std::string shard, config::Config config,
                 std::unique_ptr<dds::Gateway> gateway)
    : file_(std::move(file)),
      shard_(std::move(shard)),
      config_(std::move(config)),
      gateway_(std::move(gateway)),
      recorder_(make_recorder(config_.recording)),
      models_(maps_),
      relay_(static_cast<std::size_t>(config_.http.viewers)),
      director_(config_, maps_, *gateway_, audiences()),
      loader_(map_sink()),
      live_list_([this] { return http::live_page(director_.view(view_timeout), recorder_ != nullptr); },
                 live_list_age) {
    for (const config::Map& map : config_.maps)
        maps_.add(map.name, map.strict);
}

director::Audiences Service::audiences() {
    director::Audiences audiences;
    if (recorder_) audiences.push_back(recorder_.get());
    if (config_.http.enabled) audiences.push_back(&relay_);
    return audiences;
}

maps::LoaderSink Service::map_sink() {
    maps::LoaderSink sink;
    sink.added = [this](const config::Map& map) {
        maps_.add(map.name, map.strict);
        models_.set_source(map.name, map.source);
        director_.maps_changed();
    };
    sink.removed = [this](const std::string& name) {
        models_.remove_source(name);
        maps_.remove(name);
        director_.maps_changed();
    };
    sink.loading = [this](const std::string& name, const std::string& activity) {
        maps_.set_loading(name, activity);
    };
    sink.ready = [this](const std::string& name, freespace::Freespace freespace, double bake_seconds) {
        maps_.set_ready(name, std::move(freespace), bake_seconds);
        director_.maps_changed();
    };
    sink.failed = [this](const std::string& name, const std::string& reason) {
        maps_.set_failed(name, reason);
        director_.maps_changed();
    };
    return sink;
}

http::Sources Service::sources() {
    http::Sources sources;
    sources.healthy = [this] { return healthy(); };
    sources.missing = [this] { return missing(); };
    sources.metrics = [this] {
        auto families = http::director_metrics(director_.statistics());
        const auto most = static_cast<std::size_t>(config_.http.match_metrics);
        for (auto& more :
             {http::match_metrics(director_.match_statistics(most)), http::map_metrics(maps_.entries()),
              http::config_metrics(refused_, keys_for_restart_),
              wire_metrics(gateway_->counters(), config_.dds.strength, gateway_->identity()),
              recording_metrics(recorder_ ? recorder_->statistics() : recording::RecorderStatistics{}),
              http::live_metrics(relay_.statistics())})
            families.insert(families.end(), more.begin(), more.end());
        return families;
    };
    sources.hand_over = [this] {
        const auto [led, kept] = gateway_->hand_over();
        spdlog::info("http: handed over {} of {} matches", led - kept, led);
        return http::HandOver{led, kept};
    };
    sources.broadcast = [this](std::string_view path) {
        return recorder_ ? viewers_resource(recorder_->broadcast(), path) : std::nullopt;
    };
    sources.status = [this] {
        return http::status_page(director_.view(view_timeout), maps_.entries(),
                                 [this](const std::string& match_id) { return gateway_->leads(match_id); });
    };
    sources.live = [this] { return live_list_.at(http::KeptAnswer::Clock::now()); };
    sources.model = [this](const std::string& map, live::ModelKind kind) { return models_.find(map, kind); };
    sources.join = [this](const std::string& match_id, const std::shared_ptr<live::Viewer>& viewer) {
        return relay_.join(match_id, viewer);
    };
    return sources;
}

bool Service::healthy() const {
    return director_.responsive(max_turn) && gateway_->responsive(max_turn);
}

std::vector<std::string> Service::missing() const {
    std::vector<std::string> missing;
    const bool is_examining = loader_.is_examining();  // before the maps are looked at: they may become stale
    if (draining_) missing.emplace_back("draining");
    const auto& identity = gateway_->identity();
    if (identity && identity->expires <= std::chrono::system_clock::now())
        missing.push_back("identity in " + config_.dds.security +
                          ": its certificate has expired: renew it and restart");
    for (const auto& [name, map] : maps_.entries())
        if (map.state == director::LoadState::loading)
            missing.push_back("map " + name + ": " + (map.reason.empty() ? "loading" : map.reason));
    if (is_examining) missing.emplace_back("maps: their sources are compared with what was baked");
    return missing;
}

void Service::run(Signals& signals) {
    spdlog::info("director {} in DDS domain {}", gateway_->director_id(), config_.dds.domain);
    gateway_->start(director_);
    loader_.load(config_.maps);
    auto trimmed = std::chrono::steady_clock::now();
    for (bool settled = false;;) {
        watch(settled);
        if (const auto now = std::chrono::steady_clock::now(); now - trimmed >= trim_period) {
            trim_heap();  // of what matches and peers that are gone have left free
            trimmed = now;
        }
        const Signal signal = signals.wait(watch_period);
        if (signal == Signal::stop) break;
        if (signal == Signal::reload) {
            reload();
            settled = false;
        }
    }
    drain();
}

// A reload has ended for systemd when its configuration is in effect: no other waits for a bake.
void Service::watch(bool& settled) {
    const bool answers = !http_ || http_->responsive(max_turn);
    if (answers && healthy()) notify_alive();
    if (settled) return;
    const auto waits_for = missing();
    const std::string status = summary(waits_for);
    if (!waits_for.empty()) return started_ ? notify_ready(status) : notify_starting(status, start_extension);
    settled = started_ = true;
    spdlog::info("ready");
    notify_ready(status);
}

std::string Service::summary(const std::vector<std::string>& missing) const {
    const std::string refusal =
        refused_ ? "the configuration file was refused: a restart with it would fail; " : "";
    if (!missing.empty()) return refusal + missing.front();
    const auto maps = maps_.entries();
    const auto usable =
        std::ranges::count_if(maps, [](const auto& map) { return map.second.freespace.has_value(); });
    return refusal + "serving " + std::to_string(usable) + " of " + std::to_string(maps.size()) + " maps";
}

Result<config::Config> Service::load_again() {
    auto loaded = maps::guarded(file_.string(), [&] { return config::load(file_, shard_); });
    // Another file for the token takes effect after a restart.
    if (loaded && http_ && loaded->http.token_file == config_.http.token_file) {
        const auto token = http_->reload();
        if (!token) return tl::unexpected(token.error());
    }
    return loaded;
}

void Service::reload() {
    notify_reloading();
    auto loaded = load_again();
    refused_ = !loaded;
    if (!loaded) {
        spdlog::error(
            "{}: not reloaded, the previous configuration stays in effect; correct it and send SIGHUP "
            "again: a restart with it would fail",
            file_.string());
        log_lines(spdlog::level::err, loaded.error().message);
        return;
    }
    const auto for_restart = config::changes_for_restart(config_, *loaded);
    keys_for_restart_ = for_restart.size();
    for (const std::string& pointer : for_restart)
        spdlog::warn("{}: {} takes effect after a restart", file_.string(), pointer);
    config::reload(config_, std::move(*loaded));
    set_log_level(config_.log);
    director_.reconfigure(config_);
    gateway_->reshard(config_.dds);
    loader_.load(config_.maps);
    spdlog::info("{}: reloaded", file_.string());
}

void Service::drain() {
    spdlog::info("draining");
    notify_stopping();
    draining_ = true;
    gateway_->stop_receiving();
    loader_.stop();
    director_.drain();
    gateway_->close();
    relay_.close(viewers_leave);
    http_.reset();
    recorder_.reset();
    spdlog::info("stopped");
}

}  // namespace camdir::service
