#include "http/pages.hpp"

#include <prometheus/text_serializer.h>

#include <algorithm>
#include <cstring>
#include <string_view>

namespace camdir::http {
namespace {

using boost::beast::http::field;
using boost::beast::http::verb;

Content plain(Status status, std::string text) {
    return {status, "text/plain; charset=utf-8", std::move(text)};
}

Content health(const Sources& sources, std::string_view /*below*/) {
    if (sources.healthy()) return plain(Status::ok, "ok\n");
    return plain(Status::service_unavailable,
                 "a worker, the housekeeping or the reception does not respond\n");
}

Content readiness(const Sources& sources, std::string_view /*below*/) {
    const auto missing = sources.missing();
    if (missing.empty()) return plain(Status::ok, "ready\n");
    std::string text;
    for (const std::string& what : missing)
        text += what + "\n";
    return plain(Status::service_unavailable, text);
}

Content metrics(const Sources& sources, std::string_view /*below*/) {
    return {Status::ok, "text/plain; version=0.0.4; charset=utf-8",
            prometheus::TextSerializer().Serialize(sources.metrics())};
}

Content status(const Sources& sources, std::string_view /*below*/) {
    return {Status::ok, "application/json", sources.status()};
}

Content hand_over(const Sources& sources, std::string_view /*below*/) {
    const HandOver done = sources.hand_over();
    const std::string count = std::to_string(done.led - done.kept) + " of " + std::to_string(done.led) +
                              " matches that this director led";
    if (done.kept == 0) return plain(Status::ok, "handed over: " + count + "\n");
    return plain(Status::conflict, "handed over: " + count +
                                       "; for the others no standby has cameras: start one with the same "
                                       "maps, or wait until it has loaded them\n");
}

Content broadcast(const Sources& sources, std::string_view below) {
    const auto resource = sources.broadcast(below);
    Content content = plain(Status::not_found, "Not Found\n");
    content.cache_control = "public, max-age=1";  // it may come to be
    if (!resource) return content;
    if (!resource->tag.empty()) content.cache_control = "public, max-age=31536000, immutable";
    return {Status::ok, resource->type, resource->content, content.cache_control, resource->tag};
}

constexpr Page pages[] = {{"/-/healthy", false, false, true, true, health},
                          {"/-/ready", false, false, true, true, readiness},
                          {"/metrics", false, false, false, false, metrics},
                          {"/status", false, false, false, false, status},
                          {"/broadcast", true, false, false, false, broadcast},
                          {"/hand-over", false, true, false, false, hand_over}};

std::string_view view(boost::beast::string_view text) {
    return {text.data(), text.size()};
}

std::string_view path_of(const Request& request) {
    const std::string_view target = view(request.target());
    return target.substr(0, target.find('?'));
}

// The client may name several tags, or * for any.
bool client_has(const Request& request, const std::string& tag) {
    const std::string_view known = view(request[field::if_none_match]);
    return known == "*" || known.find(tag) != std::string_view::npos;
}

}  // namespace

const Page* find_page(const Request& request) {
    const std::string_view path = path_of(request);
    const auto* found = std::find_if(std::begin(pages), std::end(pages), [&](const Page& page) {
        if (!path.starts_with(page.path)) return false;
        const std::string_view rest = path.substr(std::strlen(page.path));
        return rest.empty() || (page.has_parts && rest.front() == '/');
    });
    return found == std::end(pages) ? nullptr : found;
}

std::string_view below(const Page& page, const Request& request) {
    return path_of(request).substr(std::strlen(page.path));
}

Response answer(const Request& request, Content content) {
    Response response(content.status, request.version());
    response.set(field::content_type, content.type);
    response.set(field::cache_control, content.cache_control);
    response.set("X-Content-Type-Options", "nosniff");
    response.keep_alive(request.keep_alive());
    if (!content.tag.empty()) {
        const std::string tag = '"' + content.tag + '"';
        response.set(field::etag, tag);
        if (client_has(request, tag)) response.result(Status::not_modified);
    }
    if (response.result() != Status::not_modified) response.body() = std::move(content.text);
    response.prepare_payload();
    if (request.method() == verb::head) response.body().clear();
    return response;
}

Response refusal(const Request& request, Status status) {
    const auto reason = boost::beast::http::obsolete_reason(status);
    return answer(request, plain(status, std::string(reason) + "\n"));
}

std::optional<Response> check(const Request& request, const Page* page, const Access& access) {
    const bool reads = request.method() == verb::get || request.method() == verb::head;
    if (request.version() >= 11 && request.count(field::host) != 1)
        return refusal(request, Status::bad_request);
    if (!access.allows(reads, page != nullptr && page->open, view(request[field::authorization]))) {
        Response response = refusal(request, Status::unauthorized);
        response.set(field::www_authenticate, "Bearer");
        return response;
    }
    if (page == nullptr) return refusal(request, Status::not_found);
    if (page->acts ? request.method() != verb::post : !reads) {
        Response response = refusal(request, Status::method_not_allowed);
        response.set(field::allow, page->acts ? "POST" : "GET, HEAD");
        return response;
    }
    if (page->acts && !access.demands_token())
        return answer(request, plain(Status::forbidden,
                                     "changes need a token: name its file in /http/token_file of the "
                                     "configuration, and restart\n"));
    return std::nullopt;
}

}  // namespace camdir::http
