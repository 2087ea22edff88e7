#include "support/q3_maps.hpp"

#include <zip.h>

#include <array>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "scene/bsp/solid.hpp"
#include "scene/quake3/read_scene.hpp"
#include "support/bsp_writer.hpp"

namespace camdir::test {
namespace {

q3::Shader shader(const std::string& name, std::int32_t flags, std::int32_t contents) {
    q3::Shader shader{};
    std::memcpy(shader.name.data(), name.data(), name.size());
    shader.surface_flags = flags;
    shader.contents = contents;
    return shader;
}

std::int32_t count(std::size_t size) {
    return static_cast<std::int32_t>(size);
}

std::int32_t add_plane(q3::Bsp& bsp, const Vec3d& normal, double distance) {
    bsp.planes.push_back({floats(normal), static_cast<float>(distance)});
    return count(bsp.planes.size() - 1);
}

// The world's box is the hull of what is in it, as compilers write it.
void grow(q3::Model& model, const Vec3d& point) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto value = static_cast<float>(point[static_cast<Eigen::Index>(axis)]);
        model.mins[axis] = std::min(model.mins[axis], value);
        model.maxs[axis] = std::max(model.maxs[axis], value);
    }
}

std::int32_t add_vertices(q3::Bsp& bsp, const std::vector<Vec3d>& points) {
    const std::int32_t first = count(bsp.vertices.size());
    for (const Vec3d& point : points) {
        bsp.vertices.push_back({floats(point), {}});
        grow(bsp.models.front(), point);
    }
    return first;
}

q3::Face face(std::int32_t type, Shader shader, std::int32_t first_vertex, std::size_t vertices) {
    q3::Face face{};
    face.shader = shader;
    face.effect = -1;
    face.type = type;
    face.first_vertex = first_vertex;
    face.vertex_count = count(vertices);
    return face;
}

// A chain of nodes: in front of the first plane that a point is in front of lies the void, behind all of
// them the room.
void enclose(q3::Bsp& bsp, const Box3d& inside) {
    bsp.leaves = {q3::Leaf{0, {}}, q3::Leaf{-1, {}}};
    bsp.nodes.clear();
    const std::vector<scene::Plane> planes = scene::make_solid(inside).planes;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const bool is_last = i + 1 == planes.size();
        bsp.nodes.push_back(
            {add_plane(bsp, planes[i].normal, planes[i].distance), {-2, is_last ? -1 : count(i + 1)}, {}});
    }
}

}  // namespace

Bytes encode(const q3::Bsp& bsp) {
    BspWriter writer({"IBSP\x2e\0\0\0", 8}, 17);
    writer.lump(0, bsp.entities);
    writer.lump(1, bsp.shaders);
    writer.lump(2, bsp.planes);
    writer.lump(3, bsp.nodes);
    writer.lump(4, bsp.leaves);
    writer.lump(7, bsp.models);
    writer.lump(8, bsp.brushes);
    writer.lump(9, bsp.brush_sides);
    writer.lump(10, bsp.vertices);
    writer.lump(11, bsp.indices);
    writer.lump(13, bsp.faces);
    return writer.take();
}

Bytes zip_of(const std::string& member, const Bytes& content) {
    zip_source_t* archive_bytes = zip_source_buffer_create(nullptr, 0, 0, nullptr);
    zip_t* archive = zip_open_from_source(archive_bytes, ZIP_TRUNCATE, nullptr);
    if (archive == nullptr) throw std::runtime_error("cannot make an archive");
    zip_source_keep(archive_bytes);
    zip_source_t* source = zip_source_buffer(archive, content.data(), content.size(), 0);
    if (zip_file_add(archive, member.c_str(), source, 0) < 0 || zip_close(archive) < 0)
        throw std::runtime_error("cannot write the archive");
    zip_source_open(archive_bytes);
    zip_source_seek(archive_bytes, 0, SEEK_END);
    Bytes bytes(static_cast<std::size_t>(zip_source_tell(archive_bytes)));
    zip_source_seek(archive_bytes, 0, SEEK_SET);
    zip_source_read(archive_bytes, bytes.data(), bytes.size());
    zip_source_close(archive_bytes);
    zip_source_free(archive_bytes);
    return bytes;
}

q3::Bsp empty_map() {
    q3::Bsp bsp{};
    bsp.entities = "{\n\"classname\" \"worldspawn\"\n}\n";
    bsp.shaders = {shader("test/stone", 0, 1), shader("test/sky", 4, 0), shader("test/clip", 0, 0x10000),
                   shader("test/water", 0, 32), shader("test/ghost", 0x4000, 0)};
    bsp.models.push_back({});
    bsp.leaves = {q3::Leaf{0, {}}};
    bsp.nodes = {{add_plane(bsp, Vec3d::UnitX(), 0.0), {-1, -1}, {}}};
    return bsp;
}

void add_brush(q3::Bsp& bsp, const std::vector<scene::Plane>& planes, Shader shader) {
    bsp.brushes.push_back({count(bsp.brush_sides.size()), count(planes.size()), shader});
    for (const scene::Plane& plane : planes) {
        bsp.brush_sides.push_back({add_plane(bsp, plane.normal, plane.distance), shader});
    }
    ++bsp.models.back().brush_count;
}

void add_box(q3::Bsp& bsp, const Box3d& box, Shader shader) {
    add_brush(bsp, scene::make_solid(box).planes, shader);
    grow(bsp.models.front(), box.min());
    grow(bsp.models.front(), box.max());
}

void add_patch(q3::Bsp& bsp, int width, int height, const std::vector<Vec3d>& points, Shader shader) {
    q3::Face patch = face(q3::patch, shader, add_vertices(bsp, points), points.size());
    patch.patch_width = width;
    patch.patch_height = height;
    bsp.faces.push_back(patch);
    ++bsp.models.back().face_count;
}

void add_soup(q3::Bsp& bsp, const std::vector<Vec3d>& corners, Shader shader) {
    q3::Face soup = face(q3::triangle_soup, shader, add_vertices(bsp, corners), corners.size());
    soup.first_index = count(bsp.indices.size());
    soup.index_count = count(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        bsp.indices.push_back(count(i));
    }
    bsp.faces.push_back(soup);
    ++bsp.models.back().face_count;
}

void add_entity_model(q3::Bsp& bsp, const std::string& class_name, const Vec3d& origin) {
    std::ostringstream entity;
    entity << "{ \"classname\" \"" << class_name << "\" \"model\" \"*" << bsp.models.size()
           << "\" \"origin\" \"" << origin.x() << ' ' << origin.y() << ' ' << origin.z() << "\" }\n";
    bsp.entities += entity.str();
    q3::Model model{};
    model.first_brush = count(bsp.brushes.size());
    model.first_face = count(bsp.faces.size());
    bsp.models.push_back(model);
}

void add_spawn_point(q3::Bsp& bsp, const Vec3d& origin, const std::string& class_name) {
    std::ostringstream entity;
    entity << "{ \"classname\" \"" << class_name << "\" \"angle\" \"90\" \"origin\" \"" << origin.x() << ' '
           << origin.y() << ' ' << origin.z() << "\" }\n";
    bsp.entities += entity.str();
}

q3::Bsp room_map(const Box3d& inside) {
    q3::Bsp bsp = empty_map();
    enclose(bsp, inside);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        Box3d low = inside;
        low.max()[axis] = inside.min()[axis];
        low.min()[axis] = inside.min()[axis] - wall;
        add_box(bsp, low, stone);
        Box3d high = inside;
        high.min()[axis] = inside.max()[axis];
        high.max()[axis] = inside.max()[axis] + wall;
        add_box(bsp, high, stone);
    }
    return bsp;
}

q3::Bsp random_map(std::mt19937& random, int obstacles) {
    const Box3d inside(Vec3d(-256.0, -192.0, -128.0), Vec3d(256.0, 192.0, 128.0));
    q3::Bsp bsp = room_map(inside);
    std::uniform_real_distribution<double> size(2.0, 60.0);
    for (int i = 0; i < obstacles; ++i) {
        const Vec3d corner = random_point_in(random, inside);
        const Box3d box(corner, corner + Vec3d(size(random), size(random), size(random)));
        std::vector<scene::Plane> planes = scene::make_solid(box).planes;
        const Vec3d slope = random_point_in(random, Box3d(Vec3d::Constant(-1.0), Vec3d::Constant(1.0)));
        if (i % 2 == 1) planes.push_back({slope.normalized(), slope.normalized().dot(box.center())});
        add_brush(bsp, planes, stone);
    }
    std::vector<Vec3d> corners;
    for (int i = 0; i < 3 * obstacles; ++i) {
        const Vec3d corner = i % 3 == 0 ? random_point_in(random, inside) : corners.back();
        corners.push_back(inside.min().cwiseMax(inside.max().cwiseMin(
            corner + random_point_in(random, Box3d(Vec3d::Constant(-60.0), Vec3d::Constant(60.0))))));
    }
    add_soup(bsp, corners, stone);
    std::vector<Vec3d> controls;
    for (int i = 0; i < 15; ++i) {
        controls.push_back(0.5 * random_point_in(random, inside));
    }
    add_patch(bsp, 5, 3, controls, stone);
    for (;;) {
        const Vec3d origin = random_point_in(random, inside);
        add_spawn_point(bsp, origin);
        if (!scene_of(bsp).spawn_points.empty()) return bsp;
        bsp.entities.resize(bsp.entities.rfind('{'));
    }
}

scene::Scene scene_of(const q3::Bsp& bsp) {
    Result<scene::Scene> scene = scene::read_q3_scene(encode(bsp));
    if (!scene) throw std::runtime_error(scene.error().message);
    return std::move(*scene);
}

Vec3d random_point_in(std::mt19937& random, const Box3d& box) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const double x = share(random);
    const double y = share(random);
    const double z = share(random);
    return box.min() + Vec3d(x, y, z).cwiseProduct(box.sizes());
}

}  // namespace camdir::test
