// camera-director inspect, export, render and evaluate as users of a baked map run them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string_view>

#include "base/file.hpp"
#include "freespace/freespace.hpp"
#include "support/child_process.hpp"
#include "support/q3_maps.hpp"
#include "support/temporary_folder.hpp"

namespace camdir {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ChildProcess;
using testing::HasSubstr;

std::uint32_t u32_at(std::string_view bytes, std::size_t offset) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

// Of a PNG file.
std::uint32_t big_endian_at(std::string_view bytes, std::size_t offset) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << 8U | static_cast<unsigned char>(bytes[offset + i]);
    return value;
}

// A room of 512 x 512 x 256 with a pool, a door and one spawn point, baked at d0 = 32. The door is 8 x 128 x
// 128.
class BakedMap : public testing::Test {
  protected:
    BakedMap() : BakedMap(Box3d(Vec3d(-4.0, -64.0, 0.0), Vec3d(4.0, 64.0, 128.0))) {}
    explicit BakedMap(const Box3d& door) : door_(door) {}

    void SetUp() override {
        map_ = folder_ / "room.bsp";
        baked_ = folder_ / "room.vfs";
        scene::q3::Bsp bsp = test::room_map(Box3d(Vec3d(0.0, 0.0, 0.0), Vec3d(512.0, 512.0, 256.0)));
        test::add_box(bsp, Box3d(Vec3d(0.0, 0.0, 0.0), Vec3d(64.0, 64.0, 16.0)), test::water);
        test::add_spawn_point(bsp, Vec3d(256.0, 256.0, 40.0));
        test::add_entity_model(bsp, "func_door", Vec3d(400.0, 256.0, 0.0));
        test::add_box(bsp, door_, test::stone);
        ASSERT_TRUE(write_file(map_, test::encode(bsp)));
        ChildProcess bake({CAMERA_DIRECTOR, "bake", map_, "-o", baked_, "--d0", "32", "--quiet"});
        ASSERT_EQ(bake.wait(), 0) << bake.errors();
        freespace_.emplace(freespace::Freespace::open(baked_).value());
    }

    // What it printed; it must exit with 0.
    static std::string printed(std::vector<std::string> command) {
        command.insert(command.begin(), CAMERA_DIRECTOR);
        ChildProcess process(command);
        EXPECT_EQ(process.wait(), 0) << process.errors();
        return process.output();
    }

    static void expect_refused(std::vector<std::string> command, const std::string& reason) {
        command.insert(command.begin(), CAMERA_DIRECTOR);
        ChildProcess process(command);
        EXPECT_EQ(process.wait(), 1);
        EXPECT_THAT(process.errors(), HasSubstr(reason));
    }

    const Box3d door_;
    test::TemporaryFolder folder_;
    std::string map_, baked_;
    std::optional<freespace::Freespace> freespace_;
};

// The door divides the room.
class DividedMap : public BakedMap {
  protected:
    DividedMap() : BakedMap(Box3d(Vec3d(-4.0, -256.0, 0.0), Vec3d(4.0, 256.0, 256.0))) {}
};

TEST_F(BakedMap, InspectPrintsWhatTheFileHoldsAndWhatTheBakeSkipped) {
    const json report = json::parse(printed({"inspect", baked_, "--json", "-"}));
    EXPECT_EQ(report.at("map_name"), "room");
    EXPECT_EQ(report.at("source_name"), map_);
    EXPECT_EQ(report.at("d0"), 32.0);
    EXPECT_EQ(report.at("vertices"), freespace_->vertices().size());
    EXPECT_EQ(report.at("triangles"), freespace_->triangles().size());
    EXPECT_EQ(report.at("bytes"), fs::file_size(baked_));
    EXPECT_EQ(report.at("spawn_points").size(), 1U);
    EXPECT_THAT(report.at("counts"),
                testing::Contains(json{{"stage", "left out"}, {"what", "liquid"}, {"value", 6.0}}));
    EXPECT_THAT(report.at("counts"),
                testing::Contains(
                    json{{"stage", "left out"}, {"what", "kept as a mover: func_door"}, {"value", 6.0}}));
    EXPECT_THAT(report.at("counts"),
                testing::Contains(json{{"stage", "movers"}, {"what", "movers"}, {"value", 1.0}}));
    EXPECT_EQ(report.at("movers"), json::parse(R"([{"name": "*1", "kind": "func_door", "hulls": 1, "balls": 0,
                                                    "rest": [400.0, 256.0, 0.0]}])"));
}

TEST_F(BakedMap, InspectPrintsUnitsAndPointsAsOptionsTakeThem) {
    ChildProcess process({CAMERA_DIRECTOR, "inspect", baked_});
    EXPECT_EQ(process.wait(), 0);
    EXPECT_THAT(process.errors(), HasSubstr("d0                0.8128 m, 32 units\n"));
    EXPECT_THAT(process.errors(), testing::ContainsRegex("spawn point       256,256,[0-9.]+ units, yaw "));
    EXPECT_THAT(process.errors(), HasSubstr(" at 400,256,0 units\n"));
}

// The rigid camera stands 120 units behind a player at 256, 256 who looks along x.
TEST_F(BakedMap, EvaluateJudgesCamerasAgainstMovers) {
    std::string trace = "t_ms,player,x,y,z,pitch,yaw,roll,vx,vy,vz,viewheight,team,teleport_bit,alive\n";
    for (int t = 0; t <= 1000; t += 100)
        trace += std::to_string(t) + ",0,256,256,40,0,0,0,0,0,0,26,0,0,1\n";
    ASSERT_TRUE(write_file(folder_ / "trace.csv", trace));
    const auto figures_with = [&](const std::string& x) {
        const std::string header = "t_ms,mover,x,y,z,pitch,yaw,roll\n";
        EXPECT_TRUE(write_file(folder_ / "movers.csv", header + "0,1," + x + ",256,0,0,0,0\n"));
        return json::parse(printed({"evaluate", "--map", map_, "--trace", folder_ / "trace.csv", "--camera",
                                    "rigid", "--movers", folder_ / "movers.csv", "--json", "-"}));
    };
    const json beyond = figures_with("400");
    EXPECT_EQ(beyond.at("mover_frames_inside"), 0);
    EXPECT_EQ(beyond.at("mover_seen_through"), 0);
    const json between = figures_with("200");
    EXPECT_EQ(between.at("mover_frames_inside"), 0);
    EXPECT_EQ(between.at("mover_passages"), 0);
    EXPECT_EQ(between.at("mover_seen_through"), 5) << "of 600 .. 1000 ms";
    EXPECT_EQ(figures_with("136").at("mover_frames_inside"), 5);
    const json without = json::parse(printed(
        {"evaluate", "--map", map_, "--trace", folder_ / "trace.csv", "--camera", "rigid", "--json", "-"}));
    EXPECT_FALSE(without.contains("mover_passages"));
    EXPECT_EQ(without.at("visible_head"), between.at("visible_head"));
}

// Player 0 looks along x at player 1 and kills them; the door is between them, or beyond both.
TEST_F(DividedMap, DirectSeesNobodyThroughAClosedDoor) {
    std::string trace = "t_ms,player,x,y,z,pitch,yaw,roll,vx,vy,vz,viewheight,team,teleport_bit,alive\n";
    for (int t = 0; t <= 4000; t += 50)
        trace += std::to_string(t) + ",0,200,256,40,0,0,0,0,0,0,26,0,0,1\n" + std::to_string(t) +
                 ",1,420,256,40,0,0,0,0,0,0,26,0,0,1\n";
    ASSERT_TRUE(write_file(folder_ / "trace.csv", trace));
    ASSERT_TRUE(write_file(folder_ / "events.csv", "t_ms,event,player,other\n2000,kill,0,1\n"));
    const std::vector<std::string> command = {"direct",   baked_,
                                              "--map",    map_,
                                              "--trace",  folder_ / "trace.csv",
                                              "--events", folder_ / "events.csv",
                                              "--delay",  "2",
                                              "--json",   "-"};
    const auto figures_with_door_at = [&](const std::string& x) {
        EXPECT_TRUE(write_file(folder_ / "movers.csv",
                               "t_ms,mover,x,y,z,pitch,yaw,roll\n0,1," + x + ",256,0,0,0,0\n"));
        std::vector<std::string> with_movers = command;
        with_movers.insert(with_movers.end(), {"--movers", folder_ / "movers.csv"});
        return json::parse(printed(with_movers));
    };
    const json without = json::parse(printed(command));
    const json closed = figures_with_door_at("360");
    EXPECT_EQ(closed.at("kills_seen"), 1);
    for (const char* other : {"", "/running", "/random", "/hltv", "/quakeworld", "/bound"}) {
        const json::json_pointer figure(std::string(other) + "/kills_seen_both");
        EXPECT_GT(without.at(figure), 0) << other;
        EXPECT_EQ(closed.at(figure), 0) << other;
    }
    EXPECT_EQ(figures_with_door_at("500"), without);
}

// Behind player 1 there is room for a camera only where the door is not.
TEST_F(DividedMap, CamerasOfADirectedMatchAndOfAGroupKeepOutOfADoor) {
    std::string trace = "t_ms,player,x,y,z,pitch,yaw,roll,vx,vy,vz,viewheight,team,teleport_bit,alive\n";
    for (int t = 0; t <= 4000; t += 50)
        trace += std::to_string(t) + ",1,420,256,40,0,0,0,0,0,0,26,0,0,1\n" + std::to_string(t) +
                 ",2,440,200,40,0,0,0,0,0,0,26,0,0,1\n";
    ASSERT_TRUE(write_file(folder_ / "trace.csv", trace));
    ASSERT_TRUE(write_file(folder_ / "events.csv", "t_ms,event,player,other\n2000,kill,1,2\n"));
    ASSERT_TRUE(write_file(folder_ / "config.json", R"({"direction": {"fixed_shots": false}})"));
    ASSERT_TRUE(write_file(folder_ / "movers.csv", "t_ms,mover,x,y,z,pitch,yaw,roll\n0,1,390,256,0,0,0,0\n"));
    const auto smallest_x = [&](std::vector<std::string> command, bool with_movers) {
        const std::string file = folder_ / "cameras.csv";
        command.insert(command.begin() + 1, {baked_, "--map", map_, "--trace", folder_ / "trace.csv",
                                             "--config", folder_ / "config.json", "--cameras", file});
        if (with_movers) command.insert(command.end(), {"--movers", folder_ / "movers.csv"});
        printed(command);
        const Bytes bytes = read_file(file).value();
        std::istringstream rows({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        std::string row;
        std::getline(rows, row);
        double smallest = 1e9;
        while (std::getline(rows, row)) {
            const std::size_t x = row.find(',', row.find(',') + 1) + 1;
            smallest = std::min(smallest, std::stod(row.substr(x)));
        }
        return smallest;
    };
    const std::vector<std::string> direct = {"direct", "--events", folder_ / "events.csv"};
    EXPECT_LT(smallest_x(direct, false), 386.0);
    EXPECT_GT(smallest_x(direct, true), 394.0);
    const std::vector<std::string> group = {"evaluate", "--group", "1,2"};
    EXPECT_LT(smallest_x(group, false), 386.0);
    EXPECT_GT(smallest_x(group, true), 394.0);
}

// Of shots that are preferred to be short, one is fixed, which shows both players.
TEST_F(DividedMap, ADirectedMatchShowsNoFixedShotThatADoorIsOver) {
    std::string trace = "t_ms,player,x,y,z,pitch,yaw,roll,vx,vy,vz,viewheight,team,teleport_bit,alive\n";
    for (int t = 0; t <= 8000; t += 50)
        trace += std::to_string(t) + ",1,256,40,40,0,90,0,0,0,0,26,1,0,1\n" + std::to_string(t) +
                 ",2,256,470,40,0,270,0,0,0,0,26,2,0,1\n";
    ASSERT_TRUE(write_file(folder_ / "trace.csv", trace));
    ASSERT_TRUE(write_file(folder_ / "events.csv", "t_ms,event,player,other\n4000,kill,1,2\n"));
    ASSERT_TRUE(write_file(folder_ / "config.json", R"({"direction": {"preferred_shot_s": 4}})"));
    // Frames from each fixed camera, by its x.
    const auto fixed_with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> command = {"direct",    baked_,
                                            "--map",     map_,
                                            "--trace",   folder_ / "trace.csv",
                                            "--events",  folder_ / "events.csv",
                                            "--config",  folder_ / "config.json",
                                            "--delay",   "5",
                                            "--cameras", "-"};
        command.insert(command.end(), more.begin(), more.end());
        std::istringstream rows(printed(command));
        std::map<double, int> frames;
        for (std::string row; std::getline(rows, row);)
            if (row.find("fixed") != std::string::npos)
                ++frames[std::stod(row.substr(row.find(',', row.find(',') + 1) + 1))];
        return frames;
    };
    const auto without = fixed_with({});
    ASSERT_FALSE(without.empty());
    const double x = without.begin()->first;
    ASSERT_TRUE(write_file(folder_ / "movers.csv",
                           "t_ms,mover,x,y,z,pitch,yaw,roll\n0,1," + std::to_string(x) + ",256,0,0,0,0\n"));
    EXPECT_FALSE(fixed_with({"--movers", folder_ / "movers.csv"}).contains(x));
}

TEST_F(BakedMap, AnotherFileIsRefusedWithTheReason) {
    const std::string picture = folder_ / "x.png";
    for (const std::vector<std::string>& command : {std::vector<std::string>{"inspect", map_},
                                                    {"export", map_, "--ply", folder_ / "x.ply"},
                                                    {"render", map_, "--map", map_, "-o", picture}})
        expect_refused(command, map_);
    EXPECT_FALSE(fs::exists(picture));
    EXPECT_FALSE(fs::exists(folder_ / "x.ply"));
}

TEST_F(BakedMap, ExportedGltfHoldsTheMeshTheRoadmapAndTheSpawnPoint) {
    const std::string glb = printed({"export", baked_, "--glb", "-"});
    ASSERT_GT(glb.size(), 28U);
    EXPECT_EQ(glb.substr(0, 4), "glTF");
    EXPECT_EQ(u32_at(glb, 4), 2U);
    EXPECT_EQ(u32_at(glb, 8), glb.size());
    const std::size_t text_size = u32_at(glb, 12);
    const json gltf = json::parse(glb.substr(20, text_size));
    const std::string_view buffer = std::string_view(glb).substr(28 + text_size);
    ASSERT_EQ(gltf.at("buffers").at(0).at("byteLength"), buffer.size());

    const json& accessors = gltf.at("accessors");
    const auto element = [&](const json& accessor, std::size_t index, std::size_t size) {
        const json& view = gltf.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
        return buffer.substr(view.at("byteOffset").get<std::size_t>() + index * size, size);
    };
    const json& mesh = gltf.at("meshes").at(0).at("primitives").at(0);
    const json& position = accessors.at(mesh.at("attributes").at("POSITION").get<std::size_t>());
    const json& distance = accessors.at(mesh.at("attributes").at("_FREE_DISTANCE").get<std::size_t>());
    const json& index = accessors.at(mesh.at("indices").get<std::size_t>());
    ASSERT_EQ(position.at("count"), freespace_->vertices().size());
    ASSERT_EQ(index.at("count"), 3 * freespace_->triangles().size());
    for (std::size_t v = 0; v < freespace_->vertices().size(); ++v) {
        const freespace::Vertex& vertex = freespace_->vertices()[v];
        const std::array<float, 3> expected{vertex.x, vertex.y, vertex.z};
        EXPECT_EQ(std::memcmp(element(position, v, 12).data(), expected.data(), 12), 0);
        EXPECT_EQ(std::memcmp(element(distance, v, 4).data(), &vertex.free_distance, 4), 0);
    }
    for (std::size_t t = 0; t < freespace_->triangles().size(); ++t) {
        const freespace::Triangle& triangle = freespace_->triangles()[t];
        const std::array<std::uint32_t, 3> expected{triangle.a, triangle.b, triangle.c};
        EXPECT_EQ(std::memcmp(element(index, 3 * t, 4).data(), expected.data(), 12), 0);
    }

    const json& roadmap = gltf.at("meshes").at(1).at("primitives").at(0);
    EXPECT_EQ(roadmap.at("mode"), 1) << "lines";
    const json& nodes = gltf.at("nodes");
    EXPECT_TRUE(std::any_of(nodes.begin(), nodes.end(), [](const json& node) {
        return node.at("name") == "spawn point 0" && node.at("translation").at(0) == 256.0;
    }));
}

TEST_F(BakedMap, ExportedPlyHoldsAllVerticesAndTriangles) {
    const std::string ply = printed({"export", baked_, "--ply", "-"});
    EXPECT_THAT(ply, testing::StartsWith("ply\nformat binary_little_endian 1.0\n"));
    EXPECT_THAT(ply, HasSubstr("element vertex " + std::to_string(freespace_->vertices().size()) + "\n"));
    EXPECT_THAT(ply, HasSubstr("element face " + std::to_string(freespace_->triangles().size()) + "\n"));
}

TEST_F(BakedMap, RenderDrawsAPngOfTheRequestedSizeFromEachViewpoint) {
    std::vector<std::string> pictures;
    for (const std::string view : {"plan", "auto", "100,100,100,45,-10"}) {
        const std::string picture =
            printed({"render", baked_, "--map", map_, "-o", "-", "--size", "320x240", "--view", view});
        ASSERT_GT(picture.size(), 24U) << view;
        EXPECT_EQ(picture.substr(0, 8), "\x89PNG\r\n\x1a\n");
        EXPECT_EQ(big_endian_at(picture, 16), 320U);
        EXPECT_EQ(big_endian_at(picture, 20), 240U);
        EXPECT_THAT(pictures, testing::Not(testing::Contains(picture))) << view;
        pictures.push_back(picture);
    }
}

}  // namespace
}  // namespace camdir
