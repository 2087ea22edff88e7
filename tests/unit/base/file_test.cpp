#include "base/file.hpp"
#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

namespace camdir {
namespace {

namespace fs = std::filesystem;

class FileTest : public testing::Test {
  protected:
    [[nodiscard]] std::size_t entries() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
    }

    test::TemporaryFolder folder_;
};

std::string text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST_F(FileTest, WrittenContentIsReadBack) {
    const fs::path path = folder_ / "a";
    ASSERT_TRUE(write_file(path, std::string("first")));
    ASSERT_TRUE(write_file(path, std::string("second, longer")));
    EXPECT_EQ(text(read_file(path).value()), "second, longer");
    EXPECT_EQ(entries(), 1U) << "no temporary file stays";
}

TEST_F(FileTest, EmptyFileIsEmpty) {
    const fs::path path = folder_ / "empty";
    ASSERT_TRUE(write_file(path, std::string()));
    EXPECT_TRUE(read_file(path).value().empty());
}

TEST_F(FileTest, LinksKeepTheirPlaceAndDevicesTheirKind) {
    const fs::path target = folder_ / "target";
    const fs::path link = folder_ / "link";
    fs::create_symlink(target, link);
    ASSERT_TRUE(write_file(link, std::string("through")));
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(text(read_file(target).value()), "through");
    const fs::path device = folder_ / "device";
    fs::create_symlink("/dev/full", device);
    EXPECT_THAT(write_file(device, std::string("x")).error().message, testing::HasSubstr("No space left"));
    EXPECT_TRUE(fs::is_character_file(device));
}

TEST_F(FileTest, ErrorsNameThePathAndTheReason) {
    const fs::path missing = folder_ / "missing";
    EXPECT_THAT(read_file(missing).error().message, testing::HasSubstr(missing.string()));
    EXPECT_THAT(read_file(missing).error().message, testing::HasSubstr("No such file"));
    EXPECT_THAT(read_file(folder_.path()).error().message, testing::HasSubstr("not a regular file"));
    const fs::path nowhere = folder_ / "no" / "such" / "folder";
    EXPECT_THAT(write_file(nowhere, std::string("x")).error().message, testing::HasSubstr(nowhere.string()));
}

TEST_F(FileTest, NamedPipeIsRefusedAtOnce) {
    const fs::path pipe = folder_ / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THAT(read_file(pipe).error().message, testing::HasSubstr("not a regular file"));
}

TEST_F(FileTest, FailedReplacementKeepsWhatWasThere) {
    const fs::path target = folder_ / "target";
    fs::create_directory(target);  // a rename over a folder fails after the temporary file was written
    std::ofstream(target / "inside") << "kept";
    EXPECT_FALSE(write_file(target, std::string("x")));
    EXPECT_TRUE(fs::exists(target / "inside"));
    EXPECT_EQ(entries(), 1U);
}

TEST_F(FileTest, PendingFileAppearsWhenItIsFinished) {
    const fs::path path = folder_ / "made";
    ASSERT_TRUE(write_file(path, std::string("older, and longer than what follows")));
    {
        auto pending = PendingFile::begin(path).value();
        ASSERT_TRUE(pending);
        EXPECT_EQ(text(read_file(path).value()).substr(0, 5), "older");
        ASSERT_TRUE(std::move(*pending).finish(std::as_bytes(std::span(std::string_view("newer")))));
    }
    EXPECT_EQ(text(read_file(path).value()), "newer");
    EXPECT_EQ(entries(), 1U);
}

TEST_F(FileTest, AbandonedPendingFileLeavesNothing) {
    { ASSERT_TRUE(PendingFile::begin(folder_ / "made").value()); }
    EXPECT_EQ(entries(), 0U);
}

TEST_F(FileTest, PendingFileKeepsASymbolicLink) {
    const fs::path link = folder_ / "link";
    fs::create_symlink("made", link);
    auto pending = PendingFile::begin(link).value();
    ASSERT_TRUE(pending);
    EXPECT_FALSE(PendingFile::begin(folder_ / "made").value()) << "the same file";
    ASSERT_TRUE(std::move(*pending).finish(std::as_bytes(std::span(std::string_view("new")))));
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(text(read_file(folder_ / "made").value()), "new");
}

TEST_F(FileTest, PendingFileIsMadeByOneAtATime) {
    const fs::path path = folder_ / "made";
    auto first = PendingFile::begin(path).value();
    ASSERT_TRUE(first);
    EXPECT_FALSE(PendingFile::begin(path).value()) << "locked";
    EXPECT_TRUE(PendingFile::begin(folder_ / "other").value());
    first.reset();
    EXPECT_TRUE(PendingFile::begin(path).value()) << "free again";
}

TEST_F(FileTest, PendingFileTakesOverWhatAKilledProcessLeft) {
    const fs::path path = folder_ / "made";
    ASSERT_TRUE(write_file(path.string() + ".part", std::string("half of something longer")));
    auto pending = PendingFile::begin(path).value();
    ASSERT_TRUE(pending);
    ASSERT_TRUE(std::move(*pending).finish(std::as_bytes(std::span(std::string_view("whole")))));
    pending.reset();
    EXPECT_EQ(text(read_file(path).value()), "whole");
    EXPECT_EQ(entries(), 1U);
}

TEST_F(FileTest, PendingFileErrorsNameThePathAndTheReason) {
    const fs::path nowhere = folder_ / "no" / "such" / "folder";
    EXPECT_THAT(PendingFile::begin(nowhere).error().message,
                testing::AllOf(testing::HasSubstr(nowhere.string()), testing::HasSubstr("No such file")));
    const fs::path folder = folder_ / "folder";
    fs::create_directory(folder);
    auto pending = PendingFile::begin(folder).value();
    ASSERT_TRUE(pending);
    const auto finished = std::move(*pending).finish({});
    EXPECT_THAT(finished.error().message, testing::HasSubstr(folder.string()));
    pending.reset();
    EXPECT_EQ(entries(), 1U);
}

}  // namespace
}  // namespace camdir
