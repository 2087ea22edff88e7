// The command line of camera-director.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>

#include "served.hpp"

namespace camdir::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

TEST(CommandLine, UsageErrorsExitWith2) {
    EXPECT_EQ(run_director({"serve"}).exit_code, 2);
    EXPECT_EQ(run_director({"serve", "--check"}).exit_code, 2);
    EXPECT_EQ(run_director({"serve", "--config"}).exit_code, 2);
    EXPECT_EQ(run_director({"serve", "--config", "x", "--no-such-option"}).exit_code, 2);
}

TEST(CommandLine, AnUnknownCommandIsToldWithWhatThereIs) {
    const Ran ran = run_director({"bakee", "x"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_THAT(ran.errors, AllOf(HasSubstr("unknown command 'bakee', did you mean 'bake'?"),
                                  HasSubstr("Expected one of: bake inspect"), HasSubstr("--help")));
    EXPECT_THAT(run_director({"frobnicate"}).errors, HasSubstr("unknown command 'frobnicate'\n"));
    EXPECT_EQ(run_director({"--help"}).exit_code, 0);
}

TEST(CommandLine, ABadConfigurationExitsWith1AndItsErrors) {
    const Folder folder;
    folder.write("config.json", R"({"dds": {"domain": 999}, "htpp": {}})");
    for (const auto& more : {std::vector<std::string>{}, std::vector<std::string>{"--check"}}) {
        std::vector<std::string> arguments = {"serve", "--config", folder / "config.json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Ran ran = run_director(arguments);
        EXPECT_EQ(ran.exit_code, 1);
        EXPECT_THAT(ran.errors,
                    AllOf(HasSubstr("config.json: /dds/domain: 999: expected an integer from 0 to 230"),
                          HasSubstr("/htpp: unknown key, did you mean \"http\"?")));
        EXPECT_EQ(ran.output, "");
    }
    EXPECT_EQ(run_director({"serve", "--config", folder / "none.json"}).exit_code, 1);
}

TEST(CommandLine, CheckIncludesTheMaps) {
    const Folder folder;
    json config = quiet_config();
    config["maps"] = {{{"name", "square"}, {"file", "square.vfs"}}};
    folder.write("config.json", config.dump());
    const Ran missing = run_director({"serve", "--check", "--config", folder / "config.json"});
    EXPECT_EQ(missing.exit_code, 1);
    EXPECT_THAT(missing.errors, AllOf(HasSubstr("/maps/0: "), HasSubstr("square.vfs: ")));
    folder.write_square("square.vfs");
    const Ran good = run_director({"serve", "--check", "--config", folder / "config.json"});
    EXPECT_EQ(good.exit_code, 0) << good.errors;
    EXPECT_THAT(good.errors, HasSubstr("valid"));
}

TEST(CommandLine, CheckIncludesTheFolderOfRecordings) {
    const Folder folder;
    json config = quiet_config();
    folder.write("file", "in the way");
    for (const char* name : {"file", "file/below"}) {
        config["recording"]["folder"] = name;
        folder.write("config.json", config.dump());
        const Ran ran = run_director({"serve", "--check", "--config", folder / "config.json"});
        EXPECT_EQ(ran.exit_code, 1);
        EXPECT_THAT(ran.errors, AllOf(HasSubstr("/recording/folder: "), HasSubstr("is no folder: expected")))
            << name;
    }
    config["recording"]["folder"] = "new/recordings";
    folder.write("config.json", config.dump());
    EXPECT_EQ(run_director({"serve", "--check", "--config", folder / "config.json"}).exit_code, 0);
    EXPECT_FALSE(std::filesystem::exists(folder / "new")) << "a check makes nothing";
}

TEST(CommandLine, PlainDdsDoesNotLeaveLoopbackUnlessTold) {
    const Folder folder;
    json config = quiet_config();
    config["dds"]["interface"] = "";
    folder.write("config.json", config.dump());
    for (const auto& more : {std::vector<std::string>{}, std::vector<std::string>{"--check"}}) {
        std::vector<std::string> arguments = {"serve", "--config", folder / "config.json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Ran ran = run_director(arguments);
        EXPECT_EQ(ran.exit_code, 1);
        EXPECT_THAT(ran.errors, AllOf(HasSubstr("/dds/interface"), HasSubstr("is not loopback"),
                                      HasSubstr("/dds/security")));
    }
    config["dds"]["insecure"] = true;
    folder.write("config.json", config.dump());
    EXPECT_EQ(run_director({"serve", "--check", "--config", folder / "config.json"}).exit_code, 0);
}

TEST(CommandLine, CheckIncludesTheIdentity) {
    const Folder folder;
    json config = quiet_config();
    config["dds"]["security"] = "identity";
    folder.write("config.json", config.dump());
    const Ran ran = run_director({"serve", "--check", "--config", folder / "config.json"});
    EXPECT_EQ(ran.exit_code, 1);
    EXPECT_THAT(ran.errors, HasSubstr("/dds/security: " + std::string(folder / "identity/identity_ca.pem") +
                                      ": cannot be read"));
}

TEST(CommandLine, PrintsItsSchemaAndReference) {
    const Ran schema = run_director({"serve", "--print-schema"});
    EXPECT_EQ(schema.exit_code, 0);
    EXPECT_TRUE(json::parse(schema.output)["properties"].contains("dds"));
    const Ran reference = run_director({"serve", "--print-reference"});
    EXPECT_EQ(reference.exit_code, 0);
    EXPECT_THAT(reference.output, HasSubstr("| `domain` | integer | `0` | 0 .. 230 |"));
}

// The long options of a command as its help lists them, without --help.
std::set<std::string> options_in_help(const std::string& command) {
    const Ran ran = run_director({command, "--help"});
    EXPECT_EQ(ran.exit_code, 0);
    std::set<std::string> options;
    const std::regex entry("\\n +(?:-\\w,)?(--[a-z0-9-]+)");
    for (std::sregex_iterator found(ran.output.begin(), ran.output.end(), entry), end; found != end; ++found)
        options.insert((*found)[1]);
    options.erase("--help");
    return options;
}

// Those of its usage lines in server/README.md; -o stands for --output.
std::set<std::string> options_in_readme(const std::string& command) {
    std::ifstream readme(CAMERA_DIRECTOR_SERVER_README);
    std::set<std::string> options;
    bool of_command = false;
    const std::regex option("--[a-z0-9-]+");
    for (std::string line; std::getline(readme, line);) {
        const std::string start = "    camera-director ";
        if (line.starts_with(start) || !line.starts_with("    "))
            of_command = line.starts_with(start + command + " ");
        if (!of_command) continue;
        if (line.find(" -o ") != std::string::npos) options.insert("--output");
        for (std::sregex_iterator found(line.begin(), line.end(), option), end; found != end; ++found)
            options.insert(found->str());
    }
    return options;
}

TEST(CommandLine, TheReadmeNamesTheOptionsOfEveryCommand) {
    for (const char* command : {"serve", "bake", "inspect", "verify", "export", "render", "evaluate"})
        EXPECT_EQ(options_in_readme(command), options_in_help(command)) << command;
}

}  // namespace
}  // namespace camdir::test
