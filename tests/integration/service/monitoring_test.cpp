// What deploy/monitoring/ says about the server is true of a real one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "served.hpp"

namespace camdir::test {
namespace {

using nlohmann::json;
using Labels = std::map<std::string, std::string>;
using Series = std::multimap<std::string, Labels>;  // by the name of the metric

std::string monitoring_file(const std::string& name) {
    std::ifstream file(CAMERA_DIRECTOR_MONITORING "/" + name);
    if (!file) throw std::runtime_error("cannot read " CAMERA_DIRECTOR_MONITORING "/" + name);
    return {std::istreambuf_iterator<char>(file), {}};
}

// The first group of every match.
std::set<std::string> all(const std::string& text, const char* pattern) {
    const std::regex regex(pattern);
    std::set<std::string> found;
    for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
        found.insert((*match)[1]);
    return found;
}

Series scraped() {
    const Folder folder;
    folder.write_square("square.vfs");
    json config = quiet_config();
    config["maps"] = {{{"name", "square"}, {"file", "square.vfs"}}};
    Served served(folder, config);

    static const std::regex series(R"re((\w+)(?:\{(.*)\})? \S+)re"), label(R"re((\w+)="([^"]*)")re");
    Series result;
    std::istringstream lines(served.get("/metrics"));
    for (std::string line; std::getline(lines, line);) {
        std::smatch parts;
        if (line.starts_with('#') || !std::regex_match(line, parts, series)) continue;
        const std::string inside = parts[2];
        Labels labels;
        for (std::sregex_iterator one(inside.begin(), inside.end(), label), end; one != end; ++one)
            labels[(*one)[1]] = (*one)[2];
        result.emplace(parts[1], labels);
    }
    return result;
}

// Every label whose values are the server's own is one of those that the matchers want.
bool fits(const Labels& labels, const std::string& matchers) {
    static const std::regex matcher(R"re((\w+)=(~?)"([^"]*)")re");
    static const std::set<std::string> of_others = {"job", "instance", "map"};
    for (std::sregex_iterator one(matchers.begin(), matchers.end(), matcher), end; one != end; ++one) {
        if (of_others.contains((*one)[1])) continue;
        const auto label = labels.find((*one)[1]);
        if (label == labels.end()) return false;
        const std::string wanted = (*one)[3];
        if (!((*one)[2].length() == 0 ? label->second == wanted
                                      : std::regex_match(label->second, std::regex(wanted))))
            return false;
    }
    return true;
}

// For each selector of metrics in the text there is a series.
void expect_series(const Series& series, const std::string& text) {
    static const std::regex selector(R"re((camera_director_\w+)(?:\{([^}]*)\})?)re");
    std::size_t count = 0;
    for (std::sregex_iterator one(text.begin(), text.end(), selector), end; one != end; ++one, ++count) {
        const auto [first, last] = series.equal_range((*one)[1]);
        EXPECT_TRUE(std::any_of(first, last, [&](const auto& s) { return fits(s.second, (*one)[2]); }))
            << "no series of the server fits " << one->str();
    }
    EXPECT_GT(count, 10U);
}

// The texts of all members of this name, at any depth.
std::string texts(const json& value, const std::string& name) {
    std::string result;
    for (const auto& [key, member] : value.items()) {
        if (member.is_structured())
            result += texts(member, name);
        else if (value.is_object() && key == name && member.is_string())
            result += member.get<std::string>() + "\n";
    }
    return result;
}

TEST(Monitoring, AlertsAndDashboardNameSeriesOfTheServer) {
    const Series series = scraped();
    const json dashboard = json::parse(monitoring_file("dashboard.json"));
    expect_series(series, monitoring_file("alerts.yml"));
    expect_series(series, monitoring_file("alerts.test.yml"));
    expect_series(series, texts(dashboard, "expr") + texts(dashboard, "query"));
}

TEST(Monitoring, EveryAlertHasItsPageOfTheRunbookAndATestThatItFires) {
    const std::string rules = monitoring_file("alerts.yml"), tests = monitoring_file("alerts.test.yml");
    const auto alerts = all(rules, R"re(- alert: (\w+))re");
    EXPECT_GT(alerts.size(), 10U);
    EXPECT_EQ(alerts, all("\n" + monitoring_file("runbook.md"), R"re(\n## (\w+)\n)re"));
    std::set<std::string> anchors;
    for (std::string alert : alerts) {
        std::transform(alert.begin(), alert.end(), alert.begin(), [](char c) { return std::tolower(c); });
        anchors.insert(alert);
    }
    EXPECT_EQ(anchors, all(rules, R"re( runbook: runbook.md#(\w+))re"));
    EXPECT_EQ(anchors, all(tests, R"re( runbook: runbook.md#(\w+))re")) << "expected of an alert that fires";
}

TEST(Monitoring, TheDashboardAsksForItsDataSource) {
    const json dashboard = json::parse(monitoring_file("dashboard.json"));
    std::set<std::string> variables;
    for (const json& variable : dashboard.at("templating").at("list"))
        variables.insert(variable.at("type").get<std::string>() + " " +
                         variable.at("name").get<std::string>());
    EXPECT_THAT(variables, testing::Contains("datasource datasource"));

    const json source = {{"type", "prometheus"}, {"uid", "${datasource}"}};
    std::set<int> ids;
    for (const json& panel : dashboard.at("panels")) {
        EXPECT_TRUE(ids.insert(panel.at("id").get<int>()).second) << panel["title"];
        if (panel.at("type") == "row") continue;
        EXPECT_EQ(panel.at("datasource"), source) << panel["title"];
        EXPECT_FALSE(panel.at("targets").empty()) << panel["title"];
        for (const json& target : panel["targets"])
            EXPECT_EQ(target.at("datasource"), source) << panel["title"];
    }
}

}  // namespace
}  // namespace camdir::test
