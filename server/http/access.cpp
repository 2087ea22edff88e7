#include "http/access.hpp"

#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <filesystem>

#include "base/file.hpp"
#include "http/letter_case.hpp"

namespace camdir::http {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t max_file_size = 4096;
constexpr std::string_view scheme = "bearer ";
constexpr std::string_view token_characters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~+/=";

Result<std::string> read_token(const std::string& file) {
    std::error_code error;
    const fs::perms permissions = fs::status(file, error).permissions();
    const std::uintmax_t size = error ? 0 : fs::file_size(file, error);
    if (error) return fail(file + ": cannot read the token: " + error.message());
    if (size > max_file_size)
        return fail(file + ": " + std::to_string(size) + " bytes: expected a token, at most " +
                    std::to_string(max_file_size) + " bytes");
    if ((permissions & fs::perms::others_all) != fs::perms::none)
        return fail(file +
                    ": is open to everyone: expected a token that only the owner and group can read: "
                    "chmod o-rwx");
    const auto bytes = read_file(file);
    if (!bytes) return tl::unexpected(bytes.error());
    std::string token(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    token.erase(token.find_last_not_of("\r\n") + 1);
    if (token.empty() || token.find_first_not_of(token_characters) != std::string::npos)
        return fail(file + ": expected one line with a token of letters, digits and -._~+/=");
    return token;
}

// HOST or HOST:PORT; IPv6 in brackets, which are removed. Empty where it is neither.
std::string_view without_port(std::string_view host) {
    if (!host.starts_with('[')) return host.substr(0, host.find(':'));
    const std::size_t end = host.find(']');
    if (end == std::string_view::npos) return {};
    const std::string_view port = host.substr(end + 1);
    return port.empty() || port.front() == ':' ? host.substr(1, end - 1) : std::string_view();
}

bool is_loopback_name(std::string_view name) {
    constexpr std::string_view local = "localhost";
    constexpr std::string_view below = ".localhost";
    if (equal_without_case(name, local)) return true;
    if (name.size() > below.size() && equal_without_case(name.substr(name.size() - below.size()), below))
        return true;
    boost::system::error_code error;
    const auto address = boost::asio::ip::make_address(std::string(name), error);
    return !error && address.is_loopback();
}

// Takes as long for every `given` of a size, so that nobody finds out how much of it is right.
bool equal_in_constant_time(std::string_view expected, std::string_view given) {
    volatile unsigned difference = expected.size() == given.size() ? 0 : 1;
    for (std::size_t i = 0; i < given.size(); ++i)
        difference = difference | static_cast<unsigned char>(given[i] ^ expected[i % expected.size()]);
    return difference == 0;
}

}  // namespace

Result<Access> Access::load(const config::Http& config, bool on_loopback) {
    std::vector<std::string> hosts = config.hosts;
    hosts.push_back(config.address);
    if (config.token_file.empty()) {
        if (on_loopback) return Access(on_loopback, "", std::move(hosts));
        return fail(
            "http: " + config.address +
            " is not a loopback address: expected /http/token_file to name a file with the token that "
            "requests from other hosts must carry");
    }
    auto token = read_token(config.token_file);
    if (!token) return fail("http: /http/token_file: " + token.error().message);
    return Access(on_loopback, std::move(*token), std::move(hosts));
}

bool Access::allows(bool reads, bool open, std::string_view authorization) const {
    if (token_.empty() || (reads && (open || on_loopback_))) return true;
    const bool bearer = authorization.size() > scheme.size() &&
                        std::equal(scheme.begin(), scheme.end(), authorization.begin(),
                                   [](char of_scheme, char given) { return of_scheme == lower(given); });
    return bearer && equal_in_constant_time(token_, authorization.substr(scheme.size()));
}

bool Access::serves(std::string_view host) const {
    const std::string_view name = without_port(host);
    return !on_loopback_ || is_loopback_name(name) ||
           std::ranges::any_of(hosts_,
                               [&](const std::string& known) { return equal_without_case(known, name); });
}

}  // namespace camdir::http
