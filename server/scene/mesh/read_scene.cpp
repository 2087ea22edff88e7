#include "scene/mesh/read_scene.hpp"

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "scene/coordinate_transform.hpp"
#include "scene/mesh/import.hpp"
#include "scene/mesh/obj_text.hpp"
#include "scene/triangle_welder.hpp"

namespace camdir::scene {
namespace {

// Nodes may repeat a mesh any number of times, so that the file's size is no limit.
constexpr std::uint64_t max_triangles = 20'000'000;

const char* name_of(MeshFormat format) {
    constexpr std::array<const char*, 5> names = {"OBJ", "PLY", "STL", "glTF", "glTF binary"};
    return names[static_cast<std::size_t>(format)];
}

bool has_y_up(MeshFormat format) {
    return format == MeshFormat::gltf || format == MeshFormat::glb;
}

// The triangles of all meshes of all nodes.
class MeshBuilder {
  public:
    explicit MeshBuilder(const CoordinateTransform& coordinates)
        : coordinates_(coordinates), welder_(weld_tolerance * coordinates.nominal_unit()) {}

    [[nodiscard]] Result<void> add(const aiMesh& mesh, const aiMatrix4x4& transform);
    [[nodiscard]] Result<Scene> finish();

  private:
    [[nodiscard]] Result<Vec3d> corner(const aiMesh& mesh, unsigned index,
                                       const aiMatrix4x4& transform) const;

    const CoordinateTransform& coordinates_;
    TriangleWelder welder_;
    std::uint64_t triangles_ = 0;
    std::uint64_t flat_ = 0;
    std::uint64_t other_primitives_ = 0;
};

Result<Vec3d> MeshBuilder::corner(const aiMesh& mesh, unsigned index, const aiMatrix4x4& transform) const {
    if (index >= mesh.mNumVertices)
        return fail("mesh '" + std::string(mesh.mName.C_Str()) + "': vertex " + std::to_string(index) +
                    " does not exist; it has " + std::to_string(mesh.mNumVertices));
    const aiVector3D p = transform * mesh.mVertices[index];
    return coordinates_.place_single({p.x, p.y, p.z}, "vertex", index);
}

Result<void> MeshBuilder::add(const aiMesh& mesh, const aiMatrix4x4& transform) {
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        if (face.mNumIndices < 3) {
            ++other_primitives_;
            continue;
        }
        if (++triangles_ > max_triangles)
            return fail("more than " + std::to_string(max_triangles) + " triangles, which is the limit");
        std::array<Vec3d, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            const Result<Vec3d> placed = corner(mesh, face.mIndices[k], transform);
            if (!placed) return tl::unexpected(placed.error());
            corners[k] = *placed;
        }
        if (!welder_.add(corners[0], corners[1], corners[2])) ++flat_;
    }
    return {};
}

Result<Scene> MeshBuilder::finish() {
    Scene scene;
    scene.vertices = welder_.take_vertices();
    scene.triangles = welder_.take_triangles();
    if (scene.triangles.empty())
        return fail("no triangle with an area of its own among its " + std::to_string(triangles_));
    scene.metres_per_unit = coordinates_.metres_per_unit();
    for (const Vec3d& vertex : scene.vertices)
        scene.bounds.extend(vertex);
    const Vec3d margin = Vec3d::Constant(box_margin * coordinates_.nominal_unit());
    scene.bounds = Box3d(scene.bounds.min() - margin, scene.bounds.max() + margin);
    if (flat_ > 0) scene.skipped.push_back({"triangles that are flat or repeated", "", flat_});
    if (other_primitives_ > 0) scene.skipped.push_back({"points and lines", "", other_primitives_});
    return scene;
}

// What Assimp reads instead of the file.
struct ObjText {
    Bytes bytes;
    Vec3d origin;  // still to be subtracted
};

// Nothing for what Assimp reads as it is.
Result<std::optional<ObjText>> obj_text_of(std::span<const std::byte> bytes, MeshFormat format,
                                           const Vec3d& origin) {
    if (format == MeshFormat::obj) {
        if (origin == Vec3d::Zero()) return std::nullopt;
        auto text = subtract_origin_from_obj(bytes, origin);
        if (!text) return tl::unexpected(text.error());
        return ObjText{std::move(*text), Vec3d::Zero()};
    }
    if (format != MeshFormat::ply) return std::nullopt;
    const auto is_precise = keeps_double_precision(bytes);
    if (!is_precise) return tl::unexpected(is_precise.error());
    auto text = ply_to_obj(bytes, *is_precise ? origin : Vec3d::Zero());
    if (!text) return tl::unexpected(text.error());
    return ObjText{std::move(*text), *is_precise ? Vec3d::Zero() : origin};
}

struct PlacedNode {
    const aiNode* node;
    aiMatrix4x4 transform;
};

}  // namespace

Result<Scene> mesh_scene_of(const aiScene& imported, MeshFormat format, const ReadOptions& options) {
    const CoordinateTransform coordinates(options, has_y_up(format) ? UpAxis::y : UpAxis::z);
    MeshBuilder builder(coordinates);
    std::vector<PlacedNode> open;
    if (imported.mRootNode != nullptr) open.push_back({imported.mRootNode, aiMatrix4x4()});
    while (!open.empty()) {
        const auto [node, above] = open.back();
        open.pop_back();
        const aiMatrix4x4 transform = above * node->mTransformation;
        for (unsigned i = 0; i < node->mNumMeshes; ++i) {
            if (node->mMeshes[i] >= imported.mNumMeshes)
                return fail("mesh " + std::to_string(node->mMeshes[i]) + " does not exist");
            const Result<void> added = builder.add(*imported.mMeshes[node->mMeshes[i]], transform);
            if (!added) return tl::unexpected(added.error());
        }
        for (unsigned i = node->mNumChildren; i-- > 0;)
            open.push_back({node->mChildren[i], transform});
    }
    Result<Scene> scene = builder.finish();
    if (scene) scene->kind = std::string("mesh (") + name_of(format) + ")";
    return scene;
}

Result<Scene> read_mesh_scene(std::span<const std::byte> bytes, MeshFormat format,
                              const Companions& companions, const ReadOptions& options) {
    const auto text = obj_text_of(bytes, format, options.origin);
    if (!text) return tl::unexpected(text.error());
    if (!*text) {
        const auto imported = import_mesh(bytes, format, companions);
        if (!imported) return tl::unexpected(imported.error());
        return mesh_scene_of(*imported->scene(), format, options);
    }
    ReadOptions rest = options;
    rest.origin = (*text)->origin;
    const auto imported = import_mesh((*text)->bytes, MeshFormat::obj, {});
    if (!imported) return tl::unexpected(imported.error());
    return mesh_scene_of(*imported->scene(), format, rest);
}

}  // namespace camdir::scene
