#include "config/json_text.hpp"

#include <set>
#include <vector>

namespace camdir::config {
namespace {

using nlohmann::json;

constexpr int deepest = 16;

// Receives the parser's events and keeps the first error.
class Checker {
  public:
    bool operator()(int depth, json::parse_event_t event, const json& parsed) {
        switch (event) {
            case json::parse_event_t::object_start:
                keys_.emplace_back();
                break;
            case json::parse_event_t::object_end:
                keys_.pop_back();
                break;
            case json::parse_event_t::key:
                if (!keys_.back().insert(parsed.get<std::string>()).second)
                    note("duplicate key " + parsed.dump());
                break;
            default:
                break;
        }
        if (depth > deepest) note("nested deeper than " + std::to_string(deepest) + " levels");
        return depth <= deepest;  // deeper values are discarded
    }

    [[nodiscard]] const std::string& error() const { return error_; }

  private:
    void note(std::string error) {
        if (error_.empty()) error_ = std::move(error);
    }

    std::vector<std::set<std::string>> keys_;
    std::string error_;
};

// nlohmann::json's messages begin with "[json.exception.parse_error.101] parse error ".
std::string without_prefix(const std::string& message) {
    const std::size_t end = message.find("] ");
    return end == std::string::npos ? message : message.substr(end + 2);
}

}  // namespace

Result<json> parse_json(const std::string& text) {
    Checker checker;
    json parsed;
    try {
        parsed = json::parse(text, std::ref(checker));
    } catch (const json::exception& error) {
        return fail(without_prefix(error.what()));
    }
    if (!checker.error().empty()) return fail(checker.error());
    return parsed;
}

std::string format_json(const nlohmann::ordered_json& value) {
    return value.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace camdir::config
