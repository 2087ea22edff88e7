// For the tests of DDS Security: participants with any identity and any endpoints.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "idl/topics.hpp"

namespace camdir::test {

inline constexpr std::array<wire::Topic, wire::topic_count> all_topics = {
    wire::Topic::match_info,   wire::Topic::pose_frame,       wire::Topic::match_event,
    wire::Topic::camera_frame, wire::Topic::observer_request, wire::Topic::observer_status,
    wire::Topic::shown_match,  wire::Topic::director_sign,    wire::Topic::mover_info,
    wire::Topic::mover_frame};

// For several identities in one process, of which Cyclone DDS allows one in a domain: its configuration for a
// domain of any number that has this one's number on the wire. Participants of such domains meet over
// loopback, and check each other as those of two hosts do.
[[nodiscard]] std::string apart_xml(std::uint32_t domain, const std::string& participant_index);
// A number for one, that no other in this process has.
[[nodiscard]] std::uint32_t next_domain_apart();

// A participant in such a domain of its own.
class SecurePeer {
  public:
    enum class Access {
        controlled,
        permissive  // its own plugins allow everything
    };

    // identity: its folder; empty for plain DDS. The first one of a domain is found by the others. Throws
    // when DDS refuses.
    SecurePeer(std::uint32_t domain, bool first, const std::string& identity,
               Access access = Access::controlled);
    ~SecurePeer();
    SecurePeer(const SecurePeer&) = delete;
    SecurePeer& operator=(const SecurePeer&) = delete;

    // Creates an endpoint in these partitions. Where its own access control does not allow it, there is none.
    void write(wire::Topic topic, const std::vector<std::string>& partitions);
    void read(wire::Topic topic, const std::vector<std::string>& partitions);
    // Both of every topic.
    void do_everything(const std::vector<std::string>& partitions);

    [[nodiscard]] bool writes(wire::Topic topic) const { return writers_[index(topic)] > 0; }
    [[nodiscard]] bool reads(wire::Topic topic) const { return readers_[index(topic)] > 0; }
    // How many readers of others its writer is matched with now, and how many writers of others its reader.
    [[nodiscard]] std::uint32_t matched_readers(wire::Topic topic) const;
    [[nodiscard]] std::uint32_t matched_writers(wire::Topic topic) const;
    // The sum over all topics.
    [[nodiscard]] std::uint32_t matches() const;

  private:
    [[nodiscard]] static std::size_t index(wire::Topic topic) { return static_cast<std::size_t>(topic); }
    [[nodiscard]] dds_entity_t create_topic(wire::Topic topic) const;

    dds_entity_t domain_ = 0;
    dds_entity_t participant_ = 0;
    std::array<dds_entity_t, wire::topic_count> writers_{}, readers_{};
};

// What Cyclone DDS has to say, instead of on standard error: one at a time.
class DdsLog {
  public:
    DdsLog();
    ~DdsLog();
    DdsLog(const DdsLog&) = delete;
    DdsLog& operator=(const DdsLog&) = delete;

    // Whether a line has all of these parts.
    [[nodiscard]] bool has(const std::vector<std::string>& parts) const;
    [[nodiscard]] std::string text() const;
};

}  // namespace camdir::test
