#include "scene/mesh/import.hpp"

#include <assimp/BaseImporter.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>

#include <algorithm>
#include <array>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <exception>
#include <sstream>

namespace camdir::scene {
namespace {

// The importers that are kept, by an extension of each.
constexpr std::array<const char*, 5> kept_extensions = {"obj", "ply", "stl", "gltf", "glb"};

std::string main_name(MeshFormat format) {
    return std::string("map.") + kept_extensions[static_cast<std::size_t>(format)];
}

// The mesh's file and its companions, and nothing else.
class MemoryFiles : public Assimp::IOSystem {
  public:
    explicit MemoryFiles(Companions files) : files_(std::move(files)) {}

    bool Exists(const char* name) const override { return files_.count(name) > 0; }
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* name, const char* mode) override {
        const auto found = files_.find(name);
        if (found == files_.end() || mode[0] != 'r') return nullptr;
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(found->second.data());
        return new Assimp::MemoryIOStream(bytes, found->second.size());
    }
    void Close(Assimp::IOStream* stream) override { delete stream; }

  private:
    Companions files_;
};

// Several importers may read an extension: glTF has one for each version.
bool is_kept(const Assimp::Importer& importer, std::size_t index) {
    std::istringstream extensions(importer.GetImporterInfo(index)->mFileExtensions);
    std::string extension;
    while (extensions >> extension)
        if (std::find(kept_extensions.begin(), kept_extensions.end(), extension) != kept_extensions.end())
            return true;
    return false;
}

std::unique_ptr<Assimp::Importer> make_importer() {
    auto importer = std::make_unique<Assimp::Importer>();
    std::vector<Assimp::BaseImporter*> unwanted;
    for (std::size_t i = 0; i < importer->GetImporterCount(); ++i)
        if (!is_kept(*importer, i)) unwanted.push_back(importer->GetImporter(i));
    for (Assimp::BaseImporter* one : unwanted) {
        importer->UnregisterLoader(one);
        delete one;
    }
    return importer;
}

std::string one_line(std::string text) {
    for (char& c : text)
        if (c == '\n' || c == '\r') c = ' ';
    return text;
}

}  // namespace

struct Imported::Parts {
    std::unique_ptr<Assimp::Importer> importer = make_importer();
};

Imported::Imported() : parts_(std::make_unique<Parts>()) {}
Imported::Imported(Imported&&) noexcept = default;
Imported& Imported::operator=(Imported&&) noexcept = default;
Imported::~Imported() = default;

const aiScene* Imported::scene() const {
    return parts_->importer->GetScene();
}

Result<Imported> import_mesh(std::span<const std::byte> bytes, MeshFormat format,
                             const Companions& companions) {
    Imported imported;
    Assimp::Importer& importer = *imported.parts_->importer;
    Companions files = companions;
    files[main_name(format)] = bytes;
    importer.SetIOHandler(new MemoryFiles(std::move(files)));
    try {
        if (importer.ReadFile(main_name(format), aiProcess_Triangulate) == nullptr)
            return fail(one_line(importer.GetErrorString()));
    } catch (const std::exception& error) {
        return fail(one_line(error.what()));
    }
    return imported;
}

}  // namespace camdir::scene
