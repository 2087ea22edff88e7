// The frame of every page: its head and its sections.
#pragma once

#include <span>
#include <string>

#include "report/subject.hpp"

namespace camdir::report {

// From the document's begin to the end of its header: title and facts, which are escaped.
[[nodiscard]] std::string head(const std::string& title, std::span<const Fact> facts);

// `content` is markup, `title` too.
[[nodiscard]] std::string section(const std::string& id, const std::string& title,
                                  const std::string& content);

}  // namespace camdir::report
