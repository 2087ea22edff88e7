// The status page: what runs, as JSON.
#pragma once

#include <map>
#include <string>

#include "director/map_library.hpp"
#include "director/view.hpp"

namespace camdir::http {

[[nodiscard]] std::string status_page(const director::View& view,
                                      const std::map<std::string, director::MapEntry>& maps);

}  // namespace camdir::http
