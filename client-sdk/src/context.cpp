#include "context.hpp"

#include "network.hpp"

namespace camdir::sdk {

Context::Context(const cdir_context_options& options)
    : domain_(options.domain, network_configuration(options)),
      participant_("cannot create a participant in DDS domain " + std::to_string(options.domain),
                   dds_create_participant(options.domain, nullptr, nullptr)),
      topics_(participant_.get()) {}

}  // namespace camdir::sdk
