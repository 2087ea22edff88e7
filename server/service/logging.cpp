#include "service/logging.hpp"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "base/log_limit.hpp"
#include "base/utf8.hpp"

namespace camdir::service {
namespace {

constexpr const char* time_pattern = "%Y-%m-%dT%H:%M:%S.%eZ";
constexpr std::uint64_t max_lines_per_second = 200;

// 2026-01-02T03:04:05.678Z info: message
// Names from outside cannot start a new line of the log, and whatever reads it finds UTF-8.
class TextLines final : public spdlog::formatter {
  public:
    void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& line) override {
        head_.format(message, line);
        const std::string text = printable({message.payload.data(), message.payload.size()});
        line.append(text.data(), text.data() + text.size());
        line.push_back('\n');
    }

    [[nodiscard]] std::unique_ptr<spdlog::formatter> clone() const override {
        return std::make_unique<TextLines>();
    }

  private:
    spdlog::pattern_formatter head_{std::string(time_pattern) + " %l: ", spdlog::pattern_time_type::utc, ""};
};

// {"time":"2026-01-02T03:04:05.678Z","level":"info","message":"..."}
class JsonLines final : public spdlog::formatter {
  public:
    void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& line) override {
        spdlog::memory_buf_t time;
        time_.format(message, time);
        const auto level = spdlog::level::to_string_view(message.level);
        const nlohmann::ordered_json object = {
            {"time", std::string(time.data(), time.size())},
            {"level", std::string(level.data(), level.size())},
            {"message", std::string(message.payload.data(), message.payload.size())}};
        const std::string text = object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
        line.append(text.data(), text.data() + text.size());
    }

    [[nodiscard]] std::unique_ptr<spdlog::formatter> clone() const override {
        return std::make_unique<JsonLines>();
    }

  private:
    spdlog::pattern_formatter time_{time_pattern, spdlog::pattern_time_type::utc, ""};
};

// Other processes can provoke lines. Critical ones, with which the process ends, are never left out.
class LimitedLines final : public spdlog::sinks::stderr_sink_mt {
  public:
    void log(const spdlog::details::log_msg& message) override {
        const bool vital = message.level == spdlog::level::critical;
        const auto left_out = budget_.take(std::chrono::steady_clock::now(), vital);
        if (!left_out) return;
        if (*left_out > 0) tell(*left_out, message.level);
        stderr_sink::log(message);
    }

  private:
    // With the level of a line that is wanted.
    void tell(std::uint64_t left_out, spdlog::level::level_enum level) {
        const std::string text = std::to_string(left_out) + " lines left out: more than " +
                                 std::to_string(max_lines_per_second) + " in a second";
        stderr_sink::log({spdlog::string_view_t(), level, text});
    }

    LogBudget budget_{max_lines_per_second};
};

}  // namespace

void start_logging(const config::Log& config) {
    auto logger = std::make_shared<spdlog::logger>("", std::make_shared<LimitedLines>());
    if (config.format == "json")
        logger->set_formatter(std::make_unique<JsonLines>());
    else
        logger->set_formatter(std::make_unique<TextLines>());
    spdlog::set_default_logger(logger);
    set_log_level(config);
}

void set_log_level(const config::Log& config) {
    spdlog::set_level(spdlog::level::from_str(config.level));
}

}  // namespace camdir::service
