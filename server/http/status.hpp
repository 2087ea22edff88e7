// What runs, as JSON: for operators, and for viewers.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "director/map_library.hpp"
#include "director/view.hpp"

namespace camdir::http {

// `leads`: whether this director leads the match of an id.
[[nodiscard]] std::string status_page(const director::View& view,
                                      const std::map<std::string, director::MapEntry>& maps,
                                      const std::function<bool(const std::string&)>& leads);

// What there is to watch: what observers know, and nothing of them. `broadcasts`: whether there may be
// something at /broadcast, too.
[[nodiscard]] std::string live_page(const director::View& view, bool broadcasts);

}  // namespace camdir::http
