#include "config/json_text.hpp"

#include <set>
#include <vector>

namespace camdir::config {
namespace {

using nlohmann::json;

constexpr int deepest = 16;

// Sees the parser's events and remembers the first thing that is wrong.
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
                    note("the key " + parsed.dump() + " is there twice in one object");
                break;
            default:
                break;
        }
        if (depth > deepest) note("nested deeper than " + std::to_string(deepest) + " levels");
        return depth <= deepest;  // what is deeper is not kept
    }

    [[nodiscard]] const std::string& problem() const { return problem_; }

  private:
    void note(std::string problem) {
        if (problem_.empty()) problem_ = std::move(problem);
    }

    std::vector<std::set<std::string>> keys_;
    std::string problem_;
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
    if (!checker.problem().empty()) return fail(checker.problem());
    return parsed;
}

}  // namespace camdir::config
