// What the bake has counted.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "bake/bake.hpp"

namespace camdir::bake {

inline double count_of(const Baked& baked, const std::string& stage, const std::string& what) {
    for (const freespace::Count& count : baked.contents.metadata.counts)
        if (count.stage == stage && count.what == what) return count.value;
    ADD_FAILURE() << "nothing counted as " << stage << ": " << what;
    return 0.0;
}

}  // namespace camdir::bake
