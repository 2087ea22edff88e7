#include "dds/waiting_matches.hpp"

namespace camdir::dds {

namespace {

auto is_of(const std::string& match_id, WriterHandle writer) {
    return [&match_id, writer](const Ownership::Claim& claim) {
        return claim.info.match_id == match_id && claim.writer == writer;
    };
}

}  // namespace

bool WaitingMatches::keep(Ownership::Claim claim) {
    const auto known = std::ranges::find_if(claims_, is_of(claim.info.match_id, claim.writer));
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

bool WaitingMatches::has(const std::string& match_id, WriterHandle writer) const {
    return std::ranges::any_of(claims_, is_of(match_id, writer));
}

void WaitingMatches::remove(const std::string& match_id, WriterHandle writer) {
    std::erase_if(claims_, is_of(match_id, writer));
}

void WaitingMatches::retain(std::span<const WriterHandle> matched) {
    std::erase_if(claims_, [&](const Ownership::Claim& claim) {
        return !std::ranges::binary_search(matched, claim.writer);
    });
}

}  // namespace camdir::dds
