// The pages and what is answered to requests for them.
#pragma once

#include <boost/beast/http/string_body.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "http/access.hpp"
#include "http/files.hpp"
#include "http/server.hpp"
#include "http/shared_text.hpp"

namespace camdir::http {

using Request = boost::beast::http::request<boost::beast::http::string_body>;
using Response = boost::beast::http::response<SharedText>;
using Status = boost::beast::http::status;

struct Content {
    Status status;
    std::string type;
    Text text;
    std::string cache_control = "no-store";
    std::string tag = {};        // empty: none
    std::string encoding = {};   // of `text`
    bool has_encodings = false;  // other clients get it in another one
};

struct Page {
    const char* path;
    bool has_parts;  // it also answers for the paths below
    bool acts;       // is asked for by POST and changes the server, instead of GET or HEAD
    bool open;       // for everyone, also from other hosts
    bool prompt;     // waits for nothing and is small
    // `below`: what of the path follows the page's own. Null: a stream of WebSocket messages.
    Content (*make)(const Sources& sources, std::string_view below);
};

// Of the request's target.
[[nodiscard]] std::string_view path_of(const Request& request);

// The page that a request names; null: there is none.
[[nodiscard]] const Page* find_page(const Request& request);

// What follows the page's own path in the request's.
[[nodiscard]] std::string_view below(const Page& page, const Request& request);

// The page of every file.
extern const Page file_page;
[[nodiscard]] Content content_of(const File& file, const Request& request);

// The answer that carries `content`, or 304 when the client has what bears its tag; to HEAD, its header.
[[nodiscard]] Response answer(const Request& request, const Content& content);

// The answer to a request that is not served for the reason of `status`.
[[nodiscard]] Response refusal(const Request& request, Status status);

// The same, for what is wrong with the request; nullopt: the page is to be made. `page` may be null.
[[nodiscard]] std::optional<Response> check(const Request& request, const Page* page, const Access& access);

}  // namespace camdir::http
