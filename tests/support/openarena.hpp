// The maps of the Debian packages openarena-081-maps and openarena-088-data, where they are installed.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace camdir::test {

// A source for scene::load of the version that the recorded traces were played on; none when the package
// is missing: skip with needs_openarena_map() then.
[[nodiscard]] std::optional<std::string> openarena_map(const std::string& name);

// The message of a test that is skipped for want of it.
[[nodiscard]] std::string needs_openarena_map(const std::string& name);

// Maps with recorded traces.
[[nodiscard]] const std::vector<std::string>& traced_maps();

}  // namespace camdir::test
