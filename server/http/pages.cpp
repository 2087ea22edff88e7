#include "http/pages.hpp"

#include <prometheus/text_serializer.h>

#include <algorithm>
#include <array>
#include <boost/beast/core/string.hpp>
#include <boost/beast/http/rfc7230.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <cstring>
#include <memory>
#include <string_view>

#include "recording/percent.hpp"

namespace camdir::http {
namespace {

using boost::beast::http::field;
using boost::beast::http::verb;

// May be kept, and is asked for again each time.
constexpr const char* kept = "private, no-cache";

Content plain(Status status, std::string text) {
    return {status, "text/plain; charset=utf-8", share(std::move(text))};
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
            share(prometheus::TextSerializer().Serialize(sources.metrics()))};
}

Content status(const Sources& sources, std::string_view /*below*/) {
    return {Status::ok, "application/json", share(sources.status())};
}

Content live(const Sources& sources, std::string_view /*below*/) {
    return {Status::ok, "application/json", share(sources.live())};
}

struct MapFile {
    std::string_view name;
    live::ModelKind kind;
    const char* type;
};
constexpr std::array map_files = {MapFile{"obstacles.glb", live::ModelKind::obstacles, "model/gltf-binary"},
                                  MapFile{"mesh.glb", live::ModelKind::mesh, "model/gltf-binary"},
                                  MapFile{"contents.json", live::ModelKind::contents, "application/json"}};

Content model(const Sources& sources, std::string_view below) {
    using live::Models;
    const auto not_found =
        plain(Status::not_found,
              "expected obstacles.glb, mesh.glb or contents.json of a map: /map/NAME/mesh.glb\n");
    if (below.empty()) return not_found;
    below.remove_prefix(1);
    const std::size_t slash = std::min(below.rfind('/'), below.size());
    const std::string_view file = below.substr(std::min(slash + 1, below.size()));
    const auto map = recording::percent_decoded(below.substr(0, slash));
    const auto* known = std::ranges::find(map_files, file, &MapFile::name);
    if (!map || known == map_files.end()) return not_found;
    const auto answer = sources.model(*map, known->kind);
    if (answer.model)
        // Shares the model's memory.
        return {Status::ok, known->type,       Text(answer.model, &answer.model->gzip),
                kept,       answer.model->tag, "gzip"};
    switch (answer.failure) {
        case Models::Failure::busy:
            return plain(Status::service_unavailable, "another model is being made: ask again\n");
        case Models::Failure::no_source:
            return plain(Status::not_found, answer.reason + "\n");
        case Models::Failure::no_map:
            break;
    }
    return plain(Status::not_found, "no map of this name is loaded\n");
}

Content broadcast(const Sources& sources, std::string_view below) {
    const auto resource = sources.broadcast(below);
    Content content = plain(Status::not_found, "Not Found\n");
    content.cache_control = "public, max-age=1";  // it may come to be
    if (!resource) return content;
    if (!resource->tag.empty()) content.cache_control = "public, max-age=31536000, immutable";
    return {Status::ok, resource->type, share(resource->content), content.cache_control, resource->tag};
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

constexpr Page pages[] = {
    {"/-/healthy", false, false, true, true, health},     {"/-/ready", false, false, true, true, readiness},
    {"/metrics", false, false, false, false, metrics},    {"/status", false, false, false, false, status},
    {"/broadcast", true, false, false, false, broadcast}, {"/live", false, false, false, false, live},
    {"/live", true, false, false, true, nullptr},         {"/map", true, false, false, false, model},
    {"/hand-over", false, true, false, false, hand_over}};

// Everything that the pages use is the server's own.
constexpr const char* content_security_policy =
    "default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; object-src 'none'";

std::string_view view(boost::beast::string_view text) {
    return {text.data(), text.size()};
}

// A browser cannot set the header of a WebSocket. It offers the token as a subprotocol instead.
std::string authorization_of(const Request& request) {
    const std::string_view given = view(request[field::authorization]);
    if (!given.empty() || !boost::beast::websocket::is_upgrade(request)) return std::string(given);
    static constexpr std::string_view mark = "bearer.";
    std::string_view offers = view(request[field::sec_websocket_protocol]);
    while (!offers.empty()) {
        const std::size_t end = std::min(offers.find(','), offers.size());
        std::string_view offer = offers.substr(0, end);
        offers.remove_prefix(std::min(end + 1, offers.size()));
        while (offer.starts_with(' '))
            offer.remove_prefix(1);
        if (!offer.starts_with(mark)) continue;
        return "Bearer " + recording::percent_decoded(offer.substr(mark.size())).value_or("");
    }
    return {};
}

bool accepts_gzip(const Request& request) {
    for (const auto& [coding, parameters] : boost::beast::http::ext_list{request[field::accept_encoding]}) {
        if (!boost::beast::iequals(coding, "gzip")) continue;
        for (const auto& [name, value] : parameters)
            if (boost::beast::iequals(name, "q"))
                return view(value).find_first_of("123456789") != std::string_view::npos;
        return true;
    }
    return false;
}

// The client may name several tags, or * for any.
bool client_has(const Request& request, const std::string& tag) {
    const std::string_view known = view(request[field::if_none_match]);
    return known == "*" || known.find(tag) != std::string_view::npos;
}

}  // namespace

const Page file_page = {"/", true, false, true, true, nullptr};

std::string_view path_of(const Request& request) {
    std::string_view target = view(request.target());
    static constexpr std::string_view scheme = "http://";
    if (boost::beast::iequals({target.data(), std::min(target.size(), scheme.size())},
                              {scheme.data(), scheme.size()})) {
        // As it is asked of a proxy.
        target.remove_prefix(scheme.size());
        target.remove_prefix(std::min(target.find_first_of("/?"), target.size()));
        if (!target.starts_with('/')) return "/";
    }
    return target.substr(0, target.find('?'));
}

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

Content content_of(const File& file, const Request& request) {
    if (!accepts_gzip(request)) return {Status::ok, file.type, file.text, kept, file.tag, "", true};
    return {Status::ok, file.type, file.gzip, kept, file.tag + "-gzip", "gzip", true};
}

Response answer(const Request& request, const Content& content) {
    Response response(content.status, request.version());
    response.set(field::content_type, content.type);
    response.set(field::cache_control, content.cache_control);
    response.set("X-Content-Type-Options", "nosniff");
    response.set("Content-Security-Policy", content_security_policy);
    response.set("Referrer-Policy", "no-referrer");
    if (!content.encoding.empty()) response.set(field::content_encoding, content.encoding);
    if (content.has_encodings) response.set(field::vary, "Accept-Encoding");
    response.keep_alive(request.keep_alive());
    if (!content.tag.empty()) {
        const std::string tag = '"' + content.tag + '"';
        response.set(field::etag, tag);
        if (client_has(request, tag)) response.result(Status::not_modified);
    }
    if (response.result() != Status::not_modified) response.body() = content.text;
    response.prepare_payload();
    if (response.result() == Status::not_modified) response.erase(field::content_length);
    if (request.method() == verb::head) response.body() = nullptr;
    return response;
}

Response refusal(const Request& request, Status status) {
    const auto reason = boost::beast::http::obsolete_reason(status);
    return answer(request, plain(status, std::string(reason) + "\n"));
}

std::optional<Response> check(const Request& request, const Page* page, const Access& access) {
    const bool reads = request.method() == verb::get || request.method() == verb::head;
    const std::size_t hosts = request.count(field::host);
    if (hosts > 1 || (hosts == 0 && request.version() >= 11)) return refusal(request, Status::bad_request);
    if (hosts == 1 && !access.serves(view(request[field::host])))
        return answer(request,
                      plain(Status::misdirected_request,
                            "the Host of this request is no name of this host: ask for localhost; the "
                            "name of a proxy belongs into /http/hosts of the configuration\n"));
    if (!access.allows(reads, page != nullptr && page->open, authorization_of(request))) {
        Response response =
            answer(request, plain(Status::unauthorized,
                                  "Unauthorized: send the header Authorization: Bearer TOKEN; TOKEN is the "
                                  "content of the file that /http/token_file of the configuration names\n"));
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
