// The endpoints of all matches, by match id.
#pragma once

#include <memory>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "dds/match_endpoints.hpp"

namespace camdir::dds {

// Thread-safe. Removed endpoints live until their last user releases them.
class MatchTable {
  public:
    using Endpoints = std::shared_ptr<MatchEndpoints>;

    void add(Endpoints endpoints) {
        const std::unique_lock lock(mutex_);
        const std::string& match_id = endpoints->match_id();
        matches_[match_id] = std::move(endpoints);
    }
    void remove(const std::string& match_id) {
        const std::unique_lock lock(mutex_);
        matches_.erase(match_id);
    }
    // Null when there is none.
    [[nodiscard]] Endpoints find(const std::string& match_id) const {
        const std::shared_lock lock(mutex_);
        const auto found = matches_.find(match_id);
        return found == matches_.end() ? nullptr : found->second;
    }
    [[nodiscard]] std::vector<Endpoints> all() const {
        const std::shared_lock lock(mutex_);
        std::vector<Endpoints> endpoints;
        for (const auto& [id, match] : matches_)
            endpoints.push_back(match);
        return endpoints;
    }
    void clear() {
        const std::unique_lock lock(mutex_);
        matches_.clear();
    }

  private:
    mutable std::shared_mutex mutex_;
    std::unordered_map<std::string, Endpoints> matches_;
};

}  // namespace camdir::dds
