// The page that `evaluate --report` writes, of a match of four seconds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>

#include "hall_match.hpp"
#include "support/child_process.hpp"

namespace camdir {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string text_of(const std::string& file) {
    const Bytes bytes = read_file(file).value();
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// The first element that is not closed in its turn; nothing where all are. Attributes are in quotation marks
// or have no value.
std::optional<std::string> markup_error(const std::string& html) {
    std::vector<std::string> open;
    const auto ends_at = [&](const std::string& text, std::size_t from) {
        const std::size_t at = html.find(text, from);
        return at == std::string::npos ? html.size() : at;
    };
    for (std::size_t at = html.find('<'); at < html.size(); at = ends_at("<", at)) {
        const std::size_t end = ends_at(">", at);
        const std::string tag = html.substr(at + 1, end - at - 1);
        at = end;
        if (tag.starts_with("!DOCTYPE") || tag.starts_with("meta ") || tag.ends_with('/')) continue;
        const std::string name = tag.substr(0, tag.find(' '));
        if (tag.starts_with('/')) {
            if (open.empty() || "/" + open.back() != tag) return "<" + tag + ">";
            open.pop_back();
            continue;
        }
        if (std::ranges::count(tag, '"') % 2 != 0 || tag.find('<') != std::string::npos) return tag;
        open.push_back(name);
        if (name == "script" || name == "style") at = ends_at("</" + name, at);
    }
    return open.empty() ? std::nullopt : std::optional(open.back());
}

// Every value of `attribute`.
std::vector<std::string> values_of(const std::string& html, const std::string& attribute) {
    std::vector<std::string> values;
    const std::string begin = ' ' + attribute + "=\"";
    for (std::size_t at = html.find(begin); at != std::string::npos; at = html.find(begin, at)) {
        at += begin.size();
        values.push_back(html.substr(at, html.find('"', at) - at));
    }
    return values;
}

// The table's value of the page's own camera, null where nothing was measured.
json figure_in(const std::string& html, const std::string& name) {
    const std::size_t row = html.find("<tr id=\"" + name + "\">");
    if (row == std::string::npos) return "no row " + name;
    const std::string begin = "<data value=\"";
    const std::size_t at = html.find(begin, row) + begin.size();
    const std::string value = html.substr(at, html.find('"', at) - at);
    return value.empty() ? json() : json::parse(value);
}

class EvaluateReport : public HallMatch {
  protected:
    // `evaluate` of the match with these options more; the page that it writes.
    std::string page_of(const std::vector<std::string>& options, const std::string& trace) {
        const std::string file = folder_ / "report.html";
        std::vector<std::string> command = {CAMERA_DIRECTOR, "evaluate", "--map",    map_,
                                            "--trace",       trace,      "--report", file};
        command.insert(command.end(), options.begin(), options.end());
        test::ChildProcess process(command);
        EXPECT_EQ(process.wait(), 0) << process.errors();
        return text_of(file);
    }
};

TEST_F(EvaluateReport, IsOneWellFormedFileWithTheFiguresOfTheMatch) {
    const std::string metrics = folder_ / "metrics.json";
    const std::string html =
        page_of({vfs_, "--events", events_, "--json", metrics, "--look-ahead", "0.5"}, trace_);
    EXPECT_EQ(markup_error(html), std::nullopt);
    EXPECT_LT(html.size(), 5'000'000U);

    // Nothing comes from elsewhere.
    EXPECT_THAT(html, Not(testing::ContainsRegex("https?:|@import|url\\(|<link|<iframe|src=")));
    for (const std::string& reference : values_of(html, "href"))
        EXPECT_TRUE(reference.starts_with('#') || reference.starts_with("data:image/png;base64,"))
            << reference.substr(0, 80);

    for (const char* section : {"figures", "moments", "plan", "series", "distributions"})
        EXPECT_THAT(html, HasSubstr("<section id=\"" + std::string(section) + "\">"));
    EXPECT_THAT(html, HasSubstr("<th>planner 0.5 s ahead</th><th>paper 0.5 s ahead</th><th>rigid</th>"));
    EXPECT_THAT(html, HasSubstr("bench-cameras " + vfs_ + ',' + map_ + ',' + trace_));

    const json figures = json::parse(text_of(metrics));
    ASSERT_GT(figures.size(), 20U);
    for (const auto& [name, value] : figures.items()) {
        if (!value.is_object())
            EXPECT_EQ(figure_in(html, name), value) << name;
        else
            for (const auto& [key, part] : value.items())
                EXPECT_EQ(figure_in(html, name + '.' + key), part) << name << '.' << key;
    }

    const auto players = values_of(html, "data-player");
    EXPECT_THAT(players, AllOf(testing::Contains("0"), testing::Contains("1")));
    EXPECT_THAT(html, AllOf(HasSubstr("<svg class=\"plan\""), HasSubstr("<div class=\"strip\">")));
}

TEST_F(EvaluateReport, IsOfJudgedCamerasToo) {
    const std::string cameras = folder_ / "<my> cameras & more.csv";
    const std::string trace = folder_ / "match of \"ours\".csv";
    std::filesystem::copy_file(trace_, trace);
    test::ChildProcess rigid({CAMERA_DIRECTOR, "evaluate", "--map", map_, "--trace", trace, "--camera",
                              "rigid", "--cameras", cameras});
    ASSERT_EQ(rigid.wait(), 0) << rigid.errors();
    const std::string html = page_of({"--judge", cameras}, trace);
    EXPECT_EQ(markup_error(html), std::nullopt);
    EXPECT_THAT(html, HasSubstr("<th>&lt;my&gt; cameras &amp; more.csv</th><th>rigid</th>"));
    EXPECT_THAT(html, HasSubstr("match of &quot;ours&quot;.csv"));
    EXPECT_THAT(html, Not(HasSubstr("bench-cameras")));
}

TEST_F(EvaluateReport, SaysBeforeTheWorkWhatIsWrong) {
    const std::string metrics = folder_ / "metrics.json";
    const auto run = [&](const std::string& report, const std::string& json_file) {
        test::ChildProcess process({CAMERA_DIRECTOR, "evaluate", vfs_, "--map", map_, "--trace", trace_,
                                    "--report", report, "--json", json_file});
        const int code = process.wait();
        return std::pair(code, process.errors());
    };
    const auto nowhere = run(folder_ / "none" / "report.html", metrics);
    EXPECT_EQ(nowhere.first, 1);
    EXPECT_THAT(nowhere.second, HasSubstr("report.html: cannot write into the folder"));
    EXPECT_EQ(run(metrics, metrics).first, 1);
    EXPECT_EQ(run("-", "-").first, 2);
    EXPECT_FALSE(std::filesystem::exists(metrics));
    for (const std::string& input : {vfs_, map_, trace_}) {
        const auto size = std::filesystem::file_size(input);
        const auto onto_input = run(input, metrics);
        EXPECT_EQ(onto_input.first, 1);
        EXPECT_THAT(onto_input.second, HasSubstr(input + ": is read, too"));
        EXPECT_EQ(std::filesystem::file_size(input), size);
    }
}

}  // namespace
}  // namespace camdir
