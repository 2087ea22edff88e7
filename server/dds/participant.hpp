// This process's DDS participant: network configuration and topics.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "config/config.hpp"
#include "dds/entity.hpp"
#include "dds/identity.hpp"
#include "dds/qos.hpp"

namespace camdir::dds {

// The Cyclone DDS configuration: config.xml if set, otherwise made from the other keys.
[[nodiscard]] std::string domain_xml(const config::Dds& config);

// One per process: its destructor shuts down all of DDS in the process, because Cyclone's threads must not
// outlive main. Open it before anything that uses many file descriptors: Cyclone cannot use 1024 and above.
class Participant {
  public:
    // Joins the domain, with DDS Security if config.security is set. Fails when check_protection() does.
    // CYCLONEDDS_URI is ignored.
    [[nodiscard]] static Result<Participant> open(const config::Dds& config);
    Participant(Participant&& other) noexcept;
    Participant& operator=(Participant&&) = delete;
    ~Participant();

    // None: plain DDS.
    [[nodiscard]] const std::optional<Identity>& identity() const { return identity_; }
    [[nodiscard]] dds_entity_t handle() const { return participant_.handle(); }
    [[nodiscard]] dds_entity_t topic(Topic topic) const {
        return topics_[static_cast<std::size_t>(topic)].handle();
    }

    // False where the identity is of an authority that knew no movers yet.
    [[nodiscard]] bool has_movers() const {
        return topic(Topic::mover_info) > 0 && topic(Topic::mover_frame) > 0;
    }

  private:
    Participant() = default;
    [[nodiscard]] Result<void> create_topic(Topic topic, const std::string& where);

    bool open_ = true;
    std::optional<Identity> identity_;
    Entity domain_;
    Entity participant_;
    std::array<Entity, topic_count> topics_;
};

}  // namespace camdir::dds
