#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "base/file.hpp"
#include "scene/load.hpp"
#include "scene/source.hpp"
#include "support/q3_maps.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::scene {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class SourceTest : public testing::Test {
  protected:
    std::string write(const std::string& name, const Bytes& bytes) const {
        const fs::path path = folder_ / name;
        EXPECT_TRUE(write_file(path, bytes));
        return path.string();
    }

    test::TemporaryFolder folder_;
};

Bytes room() {
    return test::encode(test::room_map(Box3d(Vec3d::Zero(), Vec3d(128.0, 128.0, 128.0))));
}

TEST_F(SourceTest, FileAndArchiveMemberGiveTheSameScene) {
    const std::string file = write("arena.bsp", room());
    const std::string archive = write("pack.pk3", test::zip_of("maps/arena.bsp", room()));
    const Scene from_file = load(file).value();
    const Scene from_archive = load(archive + ":maps/arena.bsp").value();
    EXPECT_EQ(from_file.name, "arena");
    EXPECT_EQ(from_archive.name, "arena");
    EXPECT_EQ(from_archive.source, archive + ":maps/arena.bsp");
    EXPECT_EQ(from_file.source_hash, from_archive.source_hash);
    EXPECT_EQ(from_file.vertices.size(), from_archive.vertices.size());
    EXPECT_EQ(hash_source(file).value(), from_file.source_hash);
    EXPECT_EQ(hash_source(archive + ":maps/arena.bsp").value(), from_file.source_hash);
}

TEST_F(SourceTest, ColonsInNamesAreNoArchives) {
    fs::create_directory(folder_ / "a:b");
    EXPECT_TRUE(load(write("a:b/c:d.bsp", room())));
    const std::string archive = write("a:b/pack:1.pk3", test::zip_of("maps/e:f.bsp", room()));
    EXPECT_EQ(load(archive + ":maps/e:f.bsp").value().name, "e:f");
}

TEST_F(SourceTest, ErrorsNameFileMemberAndAnExample) {
    const std::string archive = write("pack.pk3", test::zip_of("maps/arena.bsp", room()));
    EXPECT_THAT(load(archive).error().message, HasSubstr(archive + ":maps/arena.bsp"));
    EXPECT_THAT(load(archive + ":maps/other.bsp").error().message,
                testing::AllOf(HasSubstr("maps/other.bsp"), HasSubstr("maps/arena.bsp")));
    EXPECT_THAT(load((folder_ / "none.pk3:maps/a.bsp").string()).error().message, HasSubstr("No such file"));
    EXPECT_THAT(load(folder_.path().string()).error().message, HasSubstr("not a regular file"));
    const std::string text = write("text", Bytes(100, std::byte{'x'}));
    EXPECT_THAT(load(text).error().message, HasSubstr("unknown format"));
    EXPECT_THAT(load(text + ":maps/a.bsp").error().message, HasSubstr("cannot open as a zip archive"));
    EXPECT_THAT(load(write("empty.bsp", {})).error().message, HasSubstr("unknown format"));
}

TEST_F(SourceTest, ZipBombIsRefusedByTheStatedLimit) {
    const std::string archive =
        write("bomb.pk3", test::zip_of("maps/bomb.bsp", Bytes(max_member_bytes + 1, std::byte{0})));
    ASSERT_LT(fs::file_size(archive), 1U << 20U);
    EXPECT_THAT(load(archive + ":maps/bomb.bsp").error().message,
                HasSubstr(std::to_string(max_member_bytes) + " bytes"));
}

TEST_F(SourceTest, DamagedMemberIsAnError) {
    Bytes archive = test::zip_of("maps/arena.bsp", room());
    for (std::size_t i = 60; i < 160; ++i) {
        archive[i] ^= std::byte{0x55};
    }
    EXPECT_THAT(load(write("damaged.pk3", archive) + ":maps/arena.bsp").error().message,
                HasSubstr("cannot unpack"));
    archive.resize(archive.size() / 2);
    EXPECT_FALSE(load(write("half.pk3", archive) + ":maps/arena.bsp"));
}

}  // namespace
}  // namespace camdir::scene
