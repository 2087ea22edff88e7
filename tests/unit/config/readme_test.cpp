// The README's configuration reference is the one that the table of keys makes.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "config/config.hpp"

namespace camdir::config {
namespace {

TEST(Readme, HoldsTheReferenceOfTheTableOfKeys) {
    std::ifstream file(CAMERA_DIRECTOR_README);
    const std::string readme((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    EXPECT_NE(readme.find(reference()), std::string::npos)
        << "replace the section by the output of: camera-director serve --print-reference";
}

}  // namespace
}  // namespace camdir::config
