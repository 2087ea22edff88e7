// Who may use the pages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "config/config.hpp"

namespace camdir::http {

// Requests that need a token carry it as `Authorization: Bearer TOKEN` (RFC 6750).
class Access {
  public:
    // Reads the token file when one is configured. Fails when it has no token, is larger than 4 kB or can be
    // read or written by others than its owner and group, and when there is none although the server listens
    // for other hosts.
    [[nodiscard]] static Result<Access> load(const config::Http& config, bool on_loopback);

    // Whether the request needs no token or carries the right one in its header `authorization`. `reads`: it
    // changes nothing; `open`: its page is for everyone. The time that it takes tells nothing of the token.
    [[nodiscard]] bool allows(bool reads, bool open, std::string_view authorization) const;
    // Where none is demanded, nothing that changes the server is allowed: any page that somebody's browser
    // shows could send it.
    [[nodiscard]] bool demands_token() const { return !token_.empty(); }
    // Whether `host`, of a request's header, may be asked for. On loopback, where what is read needs no
    // token, a page of any site could else have its own name resolve to this host and read everything (DNS
    // rebinding).
    [[nodiscard]] bool serves(std::string_view host) const;

  private:
    Access(bool on_loopback, std::string token, std::vector<std::string> hosts)
        : on_loopback_(on_loopback), token_(std::move(token)), hosts_(std::move(hosts)) {}

    bool on_loopback_;
    std::string token_;               // empty: none is demanded
    std::vector<std::string> hosts_;  // that are served on loopback, besides loopback's own names
};

}  // namespace camdir::http
