#include "report/frame.hpp"

#include "report/markup.hpp"
#include "report/style.hpp"

namespace camdir::report {

std::string head(const std::string& title, std::span<const Fact> facts) {
    const std::string escaped = escape(title);
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width,initial-scale=1\"><title>" +
        escaped + "</title><style>" + style + "</style></head><body>\n<header><h1>" + escaped + "</h1><dl>";
    for (const Fact& fact : facts)
        html += "<dt>" + escape(fact.name) + "</dt><dd>" + escape(fact.value) + "</dd>";
    return html + "</dl></header>\n";
}

std::string section(const std::string& id, const std::string& title, const std::string& content) {
    return "<section id=\"" + id + "\"><h2>" + title + "</h2>\n" + content + "</section>\n";
}

}  // namespace camdir::report
