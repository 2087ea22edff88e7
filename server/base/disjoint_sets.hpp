// Union-find over 0 .. count - 1.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace camdir {

class DisjointSets {
  public:
    explicit DisjointSets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }

    // The smallest member of the set.
    [[nodiscard]] std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    void unite(std::uint32_t i, std::uint32_t j) {
        i = find(i);
        j = find(j);
        if (i < j)
            parent_[j] = i;
        else
            parent_[i] = j;
    }

  private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace camdir
