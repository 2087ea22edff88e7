// A domain in which the test process is the director at the well-known port.
#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <string>

#include "support/test_domain.hpp"

namespace camdir::test {

// Joins a free domain as participant 0.
class DirectorsDomain {
  public:
    DirectorsDomain() {
        const char* xml =
            "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\"/></Interfaces>"
            "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>0</"
            "ParticipantIndex>"
            "</Discovery></Domain></CycloneDDS>";
        for (number_ = first_director_domain; number_ <= last_director_domain; ++number_) {
            domain_ = dds_create_domain(number_, xml);
            // Another test has the port: try the next domain.
            if (domain_ > 0) return;
        }
    }
    DirectorsDomain(const DirectorsDomain&) = delete;
    DirectorsDomain& operator=(const DirectorsDomain&) = delete;
    ~DirectorsDomain() { dds_delete(DDS_CYCLONEDDS_HANDLE); }

    [[nodiscard]] bool joined() const { return domain_ > 0; }
    [[nodiscard]] std::uint32_t number() const { return number_; }
    [[nodiscard]] std::string text() const { return std::to_string(number_); }

  private:
    std::uint32_t number_ = 0;
    dds_entity_t domain_ = 0;
};

}  // namespace camdir::test
