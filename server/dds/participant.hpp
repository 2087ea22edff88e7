// This process's presence in a DDS domain: the network configuration and the topics.
#pragma once

#include <array>
#include <string>

#include "base/error.hpp"
#include "config/config.hpp"
#include "dds/entity.hpp"
#include "dds/qos.hpp"

namespace camdir::dds {

// The Cyclone DDS configuration for `config`: its `xml` where that is set, else made from the other keys.
[[nodiscard]] std::string domain_xml(const config::Dds& config);

// One a process: its end ends all of DDS in the process, because Cyclone's threads must not outlive main.
// Open it before anything that uses many file descriptors: Cyclone cannot use those from 1024 on.
class Participant {
  public:
    // Joins the domain. The environment's Cyclone configuration is not looked at.
    [[nodiscard]] static Result<Participant> open(const config::Dds& config);
    Participant(Participant&& other) noexcept;
    Participant& operator=(Participant&&) = delete;
    ~Participant();

    [[nodiscard]] dds_entity_t handle() const { return participant_.handle(); }
    [[nodiscard]] dds_entity_t topic(Topic topic) const {
        return topics_[static_cast<std::size_t>(topic)].handle();
    }

  private:
    Participant() = default;

    bool open_ = true;
    Entity domain_;
    Entity participant_;
    std::array<Entity, topic_count> topics_;
};

}  // namespace camdir::dds
