#include "service/logging.hpp"

#include <poll.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/log_limit.hpp"
#include "base/utf8.hpp"

namespace camdir::service {
namespace {

using namespace std::chrono_literals;

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

// <6>... : as a line is, with its priority before it, which systemd's journal takes off.
class JournalLines final : public spdlog::formatter {
  public:
    explicit JournalLines(std::unique_ptr<spdlog::formatter> lines) : lines_(std::move(lines)) {}

    void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& line) override {
        for (const char c : {'<', priority_of(message.level), '>'})
            line.push_back(c);
        lines_->format(message, line);
    }

    [[nodiscard]] std::unique_ptr<spdlog::formatter> clone() const override {
        return std::make_unique<JournalLines>(lines_->clone());
    }

  private:
    // Of syslog.
    static char priority_of(spdlog::level::level_enum level) {
        switch (level) {
            case spdlog::level::critical:
                return '2';
            case spdlog::level::err:
                return '3';
            case spdlog::level::warn:
                return '4';
            case spdlog::level::info:
                return '6';
            default:
                return '7';
        }
    }

    std::unique_ptr<spdlog::formatter> lines_;
};

// Whether systemd's journal reads standard error: it names its stream by device and inode.
bool is_journal() {
    const char* const stream = std::getenv("JOURNAL_STREAM");
    struct stat standard_error {};
    return stream != nullptr && ::fstat(STDERR_FILENO, &standard_error) == 0 &&
           std::to_string(standard_error.st_dev) + ":" + std::to_string(standard_error.st_ino) == stream;
}

// Whether standard error takes a line of PIPE_BUF bytes without a wait: not a pipe that nobody reads.
bool can_write(std::chrono::milliseconds patience) {
    pollfd standard_error{STDERR_FILENO, POLLOUT, 0};
    return ::poll(&standard_error, 1, static_cast<int>(patience.count())) > 0;
}

// Other processes can provoke lines, and no camera waits for whoever reads them. Critical ones, with which
// the process ends, do not count, and are waited for a little.
class LimitedLines final : public spdlog::sinks::stderr_sink_mt {
  public:
    void log(const spdlog::details::log_msg& message) override {
        const bool vital = message.level == spdlog::level::critical;
        const auto left_out = budget_.take(std::chrono::steady_clock::now(), vital);
        if (!left_out) return;
        const std::lock_guard lock(one_writer_);
        untold_ += *left_out;
        if (!write(message, vital ? longest_wait : 0ms)) ++untold_;
    }

  private:
    static constexpr std::chrono::milliseconds longest_wait = 1s;

    bool write(const spdlog::details::log_msg& message, std::chrono::milliseconds patience) {
        if (!can_write(patience)) return false;
        if (untold_ > 0) {
            tell(std::exchange(untold_, 0), message.level);
            if (!can_write(patience)) return false;
        }
        stderr_sink::log(message);
        return true;
    }

    // With the level of a line that is wanted.
    void tell(std::uint64_t left_out, spdlog::level::level_enum level) {
        const std::string text = std::to_string(left_out) + " lines left out: more than " +
                                 std::to_string(max_lines_per_second) + " in a second, or nobody read them";
        stderr_sink::log({spdlog::string_view_t(), level, text});
    }

    LogBudget budget_{max_lines_per_second};
    std::mutex one_writer_;
    std::uint64_t untold_ = 0;  // lines that were left out since the last that was written
};

}  // namespace

void start_logging(const config::Log& config) {
    auto logger = std::make_shared<spdlog::logger>("", std::make_shared<LimitedLines>());
    std::unique_ptr<spdlog::formatter> lines;
    if (config.format == "json")
        lines = std::make_unique<JsonLines>();
    else
        lines = std::make_unique<TextLines>();
    if (is_journal()) lines = std::make_unique<JournalLines>(std::move(lines));
    logger->set_formatter(std::move(lines));
    spdlog::set_default_logger(logger);
    set_log_level(config);
}

void set_log_level(const config::Log& config) {
    spdlog::set_level(spdlog::level::from_str(config.level));
}

}  // namespace camdir::service
