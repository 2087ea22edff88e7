// The figures of all methods as Markdown, one column a method.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace camdir::paper {

// `report`: what bench-paper --json prints.
[[nodiscard]] std::string table_of(const nlohmann::ordered_json& report);

}  // namespace camdir::paper
