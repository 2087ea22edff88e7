#include "dds/waiting_matches.hpp"

namespace camdir::dds {

bool WaitingMatches::keep(Ownership::Claim claim) {
    const auto known = std::ranges::find_if(claims_, [&](const Ownership::Claim& waiting) {
        return waiting.info.match_id == claim.info.match_id && waiting.writer == claim.writer;
    });
    if (known != claims_.end()) {
        *known = std::move(claim);
        return true;
    }
    const auto of_sender =
        static_cast<std::size_t>(std::ranges::count(claims_, claim.sender, &Ownership::Claim::sender));
    if (claims_.size() >= most_ || of_sender >= most_of_sender_) return false;
    claims_.push_back(std::move(claim));
    return true;
}

void WaitingMatches::remove(const std::string& match_id, WriterHandle writer) {
    std::erase_if(claims_, [&](const Ownership::Claim& claim) {
        return claim.info.match_id == match_id && claim.writer == writer;
    });
}

void WaitingMatches::retain(std::span<const WriterHandle> matched) {
    std::erase_if(claims_, [&](const Ownership::Claim& claim) {
        return !std::ranges::binary_search(matched, claim.writer);
    });
}

}  // namespace camdir::dds
