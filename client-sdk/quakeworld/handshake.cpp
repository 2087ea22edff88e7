#include "handshake.hpp"

#include <algorithm>

namespace camdir::qtv {
namespace {

constexpr std::string_view greeting = "QTVSV ";
constexpr std::size_t longest_answer = 4096;  // bytes

bool can_be_carried(std::string_view value) {
    return std::ranges::none_of(value, [](char sign) {
        return static_cast<unsigned char>(sign) < ' ' || sign == '"' || sign == '\x7f';
    });
}

std::string printable(std::string_view text) {
    std::string shown(text);
    std::ranges::replace_if(
        shown, [](char sign) { return sign < ' ' || sign > '~'; }, '?');
    return shown;
}

// Takes a line without its end out of `rest`.
std::string_view take_line(std::string_view& rest) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    return line;
}

// "reason" of "ERROR: reason".
std::string reason_of(std::string_view line) {
    line.remove_prefix(std::min(line.size(), line.find(':')));
    line.remove_prefix(line.empty() ? 0 : 1);
    line.remove_prefix(std::min(line.size(), line.find_first_not_of(' ')));
    return line.empty() ? "no reason given" : printable(line);
}

Result<Answer> answer_in(std::string_view lines) {
    take_line(lines);  // the greeting
    while (!lines.empty()) {
        const std::string_view line = take_line(lines);
        const std::string_view key = line.substr(0, line.find(':'));
        if (key == "BEGIN") return Answer{};
        if (key == "PERROR") return Answer{Answer::Kind::refused, reason_of(line)};
        if (key == "ERROR" || key == "TERROR") return Answer{Answer::Kind::busy, reason_of(line)};
    }
    return fail("byte 0: the server's answer begins no stream; expected a line BEGIN or the reason why not");
}

}  // namespace

Result<void> check(const StreamRequest& request) {
    if (!can_be_carried(request.source))
        return fail("the source has a quotation mark or a control character");
    if (!can_be_carried(request.password))
        return fail("the password has a quotation mark or a control character");
    return {};
}

std::string text_of(const StreamRequest& request) {
    std::string text = "QTV\nVERSION: 1\n";
    if (!request.source.empty()) text += "SOURCE: " + request.source + "\n";
    if (!request.password.empty()) text += "AUTH: PLAIN\nPASSWORD: \"" + request.password + "\"\n";
    return text + "\n";
}

Result<std::optional<Answer>> read_answer(std::span<const std::byte> sent) {
    const std::string_view text(reinterpret_cast<const char*>(sent.data()), sent.size());
    if (text.size() < greeting.size()) return std::nullopt;
    if (!text.starts_with(greeting))
        return fail("byte 0: '" + printable(text.substr(0, greeting.size())) + "', expected '" +
                    std::string(greeting) + "' of a QTV server");
    constexpr std::string_view end = "\n\n";
    const std::size_t lines = text.substr(0, longest_answer).find(end);
    if (lines == std::string_view::npos) {
        if (text.size() < longest_answer) return std::nullopt;
        return fail("byte 0: the server's answer has no end, expected an empty line within " +
                    std::to_string(longest_answer) + " bytes");
    }
    auto answer = answer_in(text.substr(0, lines));
    if (!answer) return tl::unexpected(answer.error());
    answer->size = lines + end.size();
    return std::optional(std::move(*answer));
}

}  // namespace camdir::qtv
