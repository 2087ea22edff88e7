// The movers of a match as they are sent.
#pragma once

#include <camera_director.h>
#include <camera_director/camera_director.h>

#include <cstdint>
#include <span>
#include <vector>

namespace camdir::sdk {

// The parallel arrays of MoverInfo.
class MoverColumns {
  public:
    // Copies what the movers point to. Throws a Failure with CDIR_INVALID_ARGUMENT that says what is wrong
    // with them.
    explicit MoverColumns(std::span<const cdir_mover> movers);

    [[nodiscard]] std::span<const std::uint32_t> ids() const { return ids_; }
    // Without match_id and epoch. It points into the columns.
    [[nodiscard]] camera_director_MoverInfo sample() const;

  private:
    void add(const cdir_mover& mover);
    void add_hulls(const cdir_mover& mover);
    void add_balls(const cdir_mover& mover);

    struct Model {
        char text[sizeof cdir_mover::model];
    };
    struct Kind {
        char text[sizeof cdir_mover::kind];
    };
    std::vector<std::uint32_t> ids_, hulls_, half_spaces_, balls_;
    std::vector<Model> models_;
    std::vector<Kind> kinds_;
    std::vector<float> planes_, spheres_;
};

}  // namespace camdir::sdk
