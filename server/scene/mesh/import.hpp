// Assimp, restricted to four formats and to files in memory.
#pragma once

#include <memory>

#include "scene/mesh/read_scene.hpp"

namespace camdir::scene {

// What Assimp read; owns it.
class Imported {
  public:
    Imported();
    Imported(Imported&&) noexcept;
    Imported& operator=(Imported&&) noexcept;
    ~Imported();

    [[nodiscard]] const aiScene* scene() const;

  private:
    friend Result<Imported> import_mesh(std::span<const std::byte> bytes, MeshFormat format,
                                        const Companions& companions);
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

// Polygons come back as triangles, each mesh with its node. Errors are Assimp's messages.
[[nodiscard]] Result<Imported> import_mesh(std::span<const std::byte> bytes, MeshFormat format,
                                           const Companions& companions);

}  // namespace camdir::scene
