#include "maps/memory.hpp"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "bake/geometry/triangle.hpp"
#include "bake/shell.hpp"

namespace camdir::maps {
namespace {

double area_of(const scene::Scene& scene) {
    double sum = 0.0;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i)
        sum += bake::area(scene::corners(scene, i));
    return sum;
}

// The line "0::/path" of the process's control groups; "/" where there is none.
std::filesystem::path control_group() {
    std::ifstream groups("/proc/self/cgroup");
    for (std::string line; std::getline(groups, line);)
        if (line.starts_with("0::/")) return line.substr(3);
    return "/";
}

std::uint64_t page_size() {
    return static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

// Of this process.
std::uint64_t resident_memory() {
    std::ifstream pages("/proc/self/statm");
    std::uint64_t all = 0;
    std::uint64_t resident = 0;
    pages >> all >> resident;
    return resident * page_size();
}

// The machine's, or the limit of this process's control groups where that is less.
std::uint64_t total_memory() {
    std::uint64_t memory = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * page_size();
    for (std::filesystem::path group = control_group();; group = group.parent_path()) {
        // "max" where there is no limit.
        std::ifstream file("/sys/fs/cgroup" + group.string() + "/memory.max");
        if (std::uint64_t limit = 0; file >> limit) memory = std::min(memory, limit);
        if (!group.has_relative_path()) return memory;
    }
}

}  // namespace

std::uint64_t estimate_memory(const scene::Scene& scene, double d0) {
    constexpr double fixed = 48.0 * 1024.0 * 1024.0;
    constexpr double bytes_of_a_sample = 1500.0;
    constexpr double samples_on_square = 1.5;
    constexpr double most = 1e15;  // no sum of estimates overflows
    const double around = scene.brushes.empty() ? bake::max_shell_samples : 0.0;
    const double samples = samples_on_square * area_of(scene) / (d0 * d0) +
                           static_cast<double>(scene.vertices.size() + scene.points.size()) + around;
    return static_cast<std::uint64_t>(std::min(fixed + bytes_of_a_sample * samples, most));
}

std::uint64_t available_memory() {
    ::malloc_trim(0);  // what is free is not held
    const std::uint64_t total = total_memory();
    return total - std::min(total - 1, resident_memory());
}

}  // namespace camdir::maps
