// The locks by which tests of several users share the DDS domains of a machine.
#include "support/test_domain.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <set>
#include <string>

#include "support/temporary_folder.hpp"

namespace camdir::test {
namespace {

mode_t mode_of(const std::filesystem::path& path) {
    struct stat status {};
    EXPECT_EQ(::stat(path.c_str(), &status), 0);
    return status.st_mode & 07777;
}

TEST(TestDomain, EveryUserCanTakeALockButNotReplaceOne) {
    const TemporaryFolder folder;
    const mode_t mask = ::umask(077);
    const TestDomain domain(folder / "locks");
    ::umask(mask);
    EXPECT_EQ(mode_of(folder / "locks"), 01777U);
    EXPECT_EQ(mode_of(folder / "locks" / std::to_string(domain.id())), 0644U);
}

TEST(TestDomain, NothingIsCreatedThroughALink) {
    const TemporaryFolder folder;
    const auto locks = folder / "locks";
    std::filesystem::create_directory(locks);
    for (int id = 1; id <= 79; ++id)
        std::filesystem::create_symlink(folder / "target", locks / std::to_string(id));
    EXPECT_EQ(TestDomain(locks).id(), 80U);
    EXPECT_FALSE(std::filesystem::exists(folder / "target"));
}

TEST(TestDomain, DomainsDiffer) {
    const TemporaryFolder folder;
    const TestDomain a(folder / "locks"), b(folder / "locks"), c(folder / "locks");
    EXPECT_EQ((std::set{a.id(), b.id(), c.id()}).size(), 3U);
}

}  // namespace
}  // namespace camdir::test
