// The project's own part around Assimp. Of arbitrary bytes the format is detected, the origin is subtracted
// and the buffers of a glTF are listed; they are also the numbers of an imported scene, which becomes a scene
// that keeps its promises, or an error of one line.
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>

#include "scene/format.hpp"
#include "scene/mesh/gltf_buffers.hpp"
#include "scene/mesh/obj_text.hpp"

namespace {

using namespace camdir;

class Input {
  public:
    Input(const std::uint8_t* data, std::size_t size) : rest_(data, size) {}

    template <class T>
    T take() {
        T value{};
        const std::size_t length = std::min(sizeof value, rest_.size());
        if (length > 0) std::memcpy(&value, rest_.data(), length);
        rest_ = rest_.subspan(length);
        return value;
    }

  private:
    std::span<const std::uint8_t> rest_;
};

aiMesh* make_mesh(Input& input) {
    auto* mesh = new aiMesh;
    mesh->mNumVertices = input.take<std::uint8_t>() % 16;
    mesh->mVertices = new aiVector3D[mesh->mNumVertices];
    for (unsigned i = 0; i < mesh->mNumVertices; ++i)
        mesh->mVertices[i] = {input.take<float>(), input.take<float>(), input.take<float>()};
    mesh->mNumFaces = input.take<std::uint8_t>() % 16;
    mesh->mFaces = new aiFace[mesh->mNumFaces];
    for (unsigned i = 0; i < mesh->mNumFaces; ++i) {
        aiFace& face = mesh->mFaces[i];
        face.mNumIndices = input.take<std::uint8_t>() % 5;
        face.mIndices = new unsigned[face.mNumIndices];
        for (unsigned k = 0; k < face.mNumIndices; ++k)
            face.mIndices[k] = input.take<std::uint8_t>() % 24;
    }
    return mesh;
}

aiNode* make_node(Input& input, int depth) {
    auto* node = new aiNode;
    for (unsigned i = 0; i < 3; ++i)
        for (unsigned k = 0; k < 4; ++k)
            node->mTransformation[i][k] = input.take<float>();
    node->mNumMeshes = input.take<std::uint8_t>() % 3;
    node->mMeshes = new unsigned[node->mNumMeshes];
    for (unsigned i = 0; i < node->mNumMeshes; ++i)
        node->mMeshes[i] = input.take<std::uint8_t>() % 3;
    const unsigned children = depth > 0 ? input.take<std::uint8_t>() % 3U : 0U;
    if (children == 0) return node;
    auto** list = new aiNode*[children];
    for (unsigned i = 0; i < children; ++i)
        list[i] = make_node(input, depth - 1);
    node->mChildren = list;
    node->mNumChildren = children;
    return node;
}

void check(const scene::Scene& scene) {
    if (scene.triangles.empty()) std::abort();
    for (const auto& triangle : scene.triangles)
        for (const std::uint32_t corner : triangle)
            if (corner >= scene.vertices.size() || !scene.bounds.contains(scene.vertices[corner]))
                std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = std::as_bytes(std::span(data, size));
    const auto format = scene::format_of(bytes, ".gltf");
    if (!format && format.error().message.empty()) std::abort();
    const auto buffers = scene::gltf_buffers(bytes);
    if (!buffers && buffers.error().message.empty()) std::abort();

    const Vec3d origin(448262.0, 5412345.0, 300.0);
    const auto obj = scene::subtract_origin_from_obj(bytes, origin);
    const auto ply = scene::ply_to_obj(bytes, origin);
    if ((!obj && obj.error().message.empty()) || (!ply && ply.error().message.empty())) std::abort();

    Input input(data, size);
    aiScene imported;
    imported.mMeshes = new aiMesh* [2] { make_mesh(input), make_mesh(input) };
    imported.mNumMeshes = 2;
    imported.mRootNode = make_node(input, 3);
    const auto scene = scene::mesh_scene_of(imported, scene::MeshFormat::gltf, {});
    if (scene)
        check(*scene);
    else if (scene.error().message.empty())
        std::abort();
    return 0;
}
