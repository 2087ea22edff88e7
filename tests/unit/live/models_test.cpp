#include "live/models.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "live/map_contents.hpp"
#include "scene/load.hpp"
#include "support/freespace_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::live {
namespace {

// A tetrahedron that is the source of a baked square.
class Library {
  public:
    Library() {
        const std::string text = "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
        EXPECT_TRUE(write_file(folder_ / "room.obj", text));
        source = (folder_ / "room.obj").string();
        load(scene::hash_source(source).value());
    }

    void load(std::uint64_t source_hash) {
        auto contents = test::square_contents();
        contents.metadata.source_hash = source_hash;
        contents.metadata.metres_per_unit = 1.0F;  // as of the source
        contents.spawn_points = {{Vec3f(1.0F, 1.0F, 1.0F), 0.0F}};
        contents.fixed_shots = {{Vec3f(10.0F, 20.0F, 5.0F), 0.5F, -0.25F, 0}};
        contents.movers = {mover()};
        maps.set_ready("room", test::make_freespace(contents));
    }

    static freespace::MoverShape mover() {
        freespace::MoverShape door;
        door.name = "*3";
        door.kind = "func_door";
        door.balls = {{Vec3f(1.0F, 2.0F, 3.0F), 0.5F}};
        freespace::ConvexHull cube;
        for (int axis = 0; axis < 3; ++axis)
            for (const float side : {1.0F, -1.0F})
                cube.half_spaces.push_back({side * Vec3f::Unit(axis), 2.0F});
        cube.bounds = Box3f(Vec3f::Constant(-2.0F), Vec3f::Constant(2.0F));
        door.hulls = {cube};
        return door;
    }

    director::MapLibrary maps;
    std::string source;

  private:
    test::TemporaryFolder folder_;
};

TEST(Models, ShowsTheObstaclesOfAMapWhoseSourceIsThere) {
    Library library;
    Models models(library.maps);
    models.set_source("room", library.source);
    const auto answer = models.find("room", ModelKind::obstacles);
    ASSERT_TRUE(answer.model) << answer.reason;
    EXPECT_EQ(answer.model->gzip.substr(0, 2), "\x1f\x8b");
    EXPECT_EQ(models.find("room", ModelKind::obstacles).model, answer.model) << "made once";
}

TEST(Models, ShowsTheMeshWithoutASource) {
    const Library library;
    Models models(library.maps);
    EXPECT_TRUE(models.find("room", ModelKind::mesh).model);
    const auto answer = models.find("room", ModelKind::obstacles);
    EXPECT_FALSE(answer.model);
    EXPECT_EQ(answer.failure, Models::Failure::no_source);
}

TEST(Models, SaysWhatIsInAMapAndWhatMovesThere) {
    const Library library;
    Models models(library.maps);
    EXPECT_TRUE(models.find("room", ModelKind::contents).model);
    const auto contents = nlohmann::json::parse(map_contents(*library.maps.find("room")->freespace));
    EXPECT_EQ(contents["version"], 1);
    EXPECT_EQ(contents["fixed_cameras"],
              nlohmann::json::parse(
                  R"([{"position": [10, 20, 5], "yaw": 0.5, "pitch": -0.25, "spawn_point": 0}])"));
    EXPECT_EQ(contents["movers"], nlohmann::json::parse(R"([{"name": "*3", "kind": "func_door", "hulls": [[
        [1, 0, 0, 2], [-1, 0, 0, 2], [0, 1, 0, 2], [0, -1, 0, 2], [0, 0, 1, 2], [0, 0, -1, 2]]],
        "balls": [[1, 2, 3, 0.5]]}])"));
}

TEST(Models, NamesNoFileToViewers) {
    Library library;
    Models models(library.maps);
    library.source += ".gone";
    models.set_source("room", library.source);
    const auto answer = models.find("room", ModelKind::obstacles);
    EXPECT_EQ(answer.failure, Models::Failure::no_source);
    EXPECT_EQ(answer.reason.find('/'), std::string::npos) << answer.reason;
}

TEST(Models, AreTriedAgainAfterAMinute) {
    Library library;
    Models models(library.maps);
    models.set_source("room", library.source + ".gone");
    const auto begin = Models::Clock::now();
    EXPECT_FALSE(models.find("room", ModelKind::obstacles, begin).model);
    models.set_source("room", library.source);
    EXPECT_FALSE(models.find("room", ModelKind::obstacles, begin + std::chrono::seconds(59)).model);
    const auto later = begin + std::chrono::seconds(61);
    EXPECT_TRUE(models.find("room", ModelKind::obstacles, later).model);
    EXPECT_TRUE(models.find("room", ModelKind::obstacles, later + std::chrono::hours(1)).model);
}

TEST(Models, DoesNotShowObstaclesThatTheMapWasNotBakedFrom) {
    Library library;
    Models models(library.maps);
    models.set_source("room", library.source);
    library.load(1234);
    EXPECT_EQ(models.find("room", ModelKind::obstacles).failure, Models::Failure::no_source);
}

TEST(Models, AreNewWhenTheMapIs) {
    Library library;
    Models models(library.maps);
    const auto before = models.find("room", ModelKind::mesh).model;
    library.load(7);
    EXPECT_NE(models.find("room", ModelKind::mesh).model, before);
}

TEST(Models, OfUnknownMapsThereAreNone) {
    const Library library;
    Models models(library.maps);
    EXPECT_EQ(models.find("hall", ModelKind::mesh).failure, Models::Failure::no_map);
    EXPECT_EQ(models.find("../../etc/passwd", ModelKind::obstacles).failure, Models::Failure::no_map);
}

}  // namespace
}  // namespace camdir::live
