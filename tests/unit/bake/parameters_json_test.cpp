#include "bake/parameters_json.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace camdir::bake {
namespace {

using nlohmann::json;

double any_finite() {
    return *rc::gen::suchThat(rc::gen::arbitrary<double>(),
                              [](double value) { return std::isfinite(value); });
}

Vec3d any_point() {
    const double x = any_finite();
    const double y = any_finite();
    return {x, y, any_finite()};
}

scene::ReadOptions any_read_options() {
    scene::ReadOptions options;
    if (*rc::gen::arbitrary<bool>()) options.metres_per_unit = any_finite();
    if (*rc::gen::arbitrary<bool>()) options.up = *rc::gen::element(scene::UpAxis::y, scene::UpAxis::z);
    if (*rc::gen::arbitrary<bool>()) options.origin = any_point();
    const int seeds = *rc::gen::inRange(0, 4);
    for (int i = 0; i < seeds; ++i)
        options.seeds.push_back(any_point());
    return options;
}

RC_GTEST_PROP(ParametersJson, WhatIsWrittenIsRead, ()) {
    Parameters parameters;
    parameters.d0 = any_finite();
    parameters.coarsest = any_finite();
    parameters.loss = any_finite();
    parameters.triangles = *rc::gen::arbitrary<std::uint64_t>();
    parameters.sampling = *rc::gen::element(Sampling::adaptive, Sampling::uniform);
    const scene::ReadOptions options = any_read_options();
    const json read = json::parse(to_json(parameters, options, "mesh (\"OBJ\")"));
    RC_ASSERT(read_options_in(read) == options);
    RC_ASSERT(read.at("kind") == "mesh (\"OBJ\")");
    RC_ASSERT(read.at("d0").get<double>() == parameters.d0);
    RC_ASSERT(read.at("coarsest").get<double>() == parameters.coarsest);
    RC_ASSERT(read.at("loss").get<double>() == parameters.loss);
    RC_ASSERT(read.at("triangles").get<std::uint64_t>() == parameters.triangles);
    RC_ASSERT(sampling_named(read.at("sampling").get<std::string>()) == parameters.sampling);
}

// Files of earlier bakes are compared with these texts.
TEST(ParametersJson, TheTextNeverChanges) {
    EXPECT_EQ(to_json({}, {}),
              R"({"d0": 0, "sampling": "adaptive", "coarsest": 8, "loss": 16, "triangles": 0})");
    Parameters parameters;
    parameters.d0 = 12.5;
    parameters.loss = 0.1;
    parameters.triangles = 100'000;
    parameters.sampling = Sampling::uniform;
    scene::ReadOptions options;
    options.metres_per_unit = 1e-5;
    options.up = scene::UpAxis::y;
    options.origin = {100'000.0, -0.25, 3.0};
    options.seeds = {{1.0, 2.0, 3.0}, {0.0, 1e6, 123'456.5}};
    EXPECT_EQ(
        to_json(parameters, options, "mesh (glTF)"),
        R"json({"kind": "mesh (glTF)", "d0": 12.5, "sampling": "uniform", "coarsest": 8, "loss": 0.1, )json"
        R"json("triangles": 100000, "metres_per_unit": 1e-05, "up": "y", )json"
        R"json("origin": [1e+05, -0.25, 3], "seeds": [[1, 2, 3], [0, 1e+06, 123456.5]]})json");
}

TEST(ParametersJson, OtherTypesAreReadAsTheDefault) {
    for (const char* text : {"null", "[]", "3", "{}", R"({"up": "x"})", R"({"up": 1})",
                             R"({"origin": [1, 2]})", R"({"origin": [1, 2, "3"]})", R"({"seeds": {}})",
                             R"({"seeds": [1, [1, 2], null]})", R"({"metres_per_unit": "1"})"})
        EXPECT_EQ(read_options_in(json::parse(text)), scene::ReadOptions()) << text;
}

}  // namespace
}  // namespace camdir::bake
