// Deletes DDS entities so that nothing of them stays in the process, for the server and the client library.
#pragma once

#include <dds/dds.h>

#ifdef __cplusplus
extern "C" {
#endif

// As dds_delete(). Also takes back what Cyclone DDS 0.10 keeps of each reader and writer until its domain is
// deleted: of `entity`, and of its children. Thread-safe, but the domain must outlive the call, and no other
// thread may delete the entity or its parent at the same time; not inside a DDS callback.
void camdir_delete_entity(dds_entity_t entity);

#ifdef __cplusplus
}
#endif
