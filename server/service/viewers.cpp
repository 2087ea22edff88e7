#include "service/viewers.hpp"

namespace camdir::service {

std::optional<http::Resource> viewers_resource(const recording::Broadcast& broadcast, std::string_view path) {
    auto answer = broadcast.get(path);
    if (!answer) return std::nullopt;
    return http::Resource{answer->is_json ? "application/json" : "application/octet-stream",
                          std::move(answer->tag), std::move(answer->content)};
}

}  // namespace camdir::service
