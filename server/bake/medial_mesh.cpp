#include "bake/medial_mesh.hpp"

#include <cassert>

namespace camdir::bake {

void keep_triangles(MedialMesh& mesh, const std::vector<char>& keep) {
    assert(keep.size() == mesh.triangles.size());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < keep.size(); ++i)
        if (keep[i] != 0) mesh.triangles[kept++] = mesh.triangles[i];
    mesh.triangles.resize(kept);
}

}  // namespace camdir::bake
