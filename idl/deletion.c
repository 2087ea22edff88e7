// Each endpoint is announced to the domain by a discovery writer, as an instance of a discovery topic with
// the endpoint's GUID as key. When the endpoint is deleted and that instance is unregistered, the writer
// history of Cyclone DDS 0.10 forgets to give back its reference to the instance's key, which has a copy of
// the endpoint's QoS: some 450 bytes. From 0.11 on it gives it back; those versions do not come here. That is
// C, because the headers are.
#include "idl/deletion.h"

#include <dds/version.h>

#if DDS_VERSION_MAJOR == 0 && DDS_VERSION_MINOR == 10

#include <dds/ddsi/ddsi_domaingv.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_tkmap.h>
#include <dds/ddsi/q_rtps.h>
#include <dds/ddsi/q_thread.h>

enum { max_endpoints = 16 };  // a match's publisher or subscriber has at most seven

struct endpoints {
    struct ddsi_domaingv* domain;
    dds_guid_t guids[max_endpoints];
    int count;
};

static bool is_writer(const dds_guid_t* guid) {
    const int kind = guid->v[15] & NN_ENTITYID_KIND_MASK;
    return kind == NN_ENTITYID_KIND_WRITER_WITH_KEY || kind == NN_ENTITYID_KIND_WRITER_NO_KEY;
}

static bool is_reader(const dds_guid_t* guid) {
    const int kind = guid->v[15] & NN_ENTITYID_KIND_MASK;
    return kind == NN_ENTITYID_KIND_READER_WITH_KEY || kind == NN_ENTITYID_KIND_READER_NO_KEY;
}

// A call that looks into the domain of an endpoint leaves it with the calling thread. NULL: it has ended.
static struct ddsi_domaingv* domain_of(dds_entity_t endpoint, const dds_guid_t* guid) {
    const dds_return_t matched = is_writer(guid) ? dds_get_matched_subscriptions(endpoint, NULL, 0)
                                                 : dds_get_matched_publications(endpoint, NULL, 0);
    return matched < 0 ? NULL : ddsrt_atomic_ldvoidp(&lookup_thread_state()->gv);
}

static void add_if_endpoint(struct endpoints* endpoints, dds_entity_t entity) {
    dds_guid_t guid;
    if (endpoints->count == max_endpoints || dds_get_guid(entity, &guid) != DDS_RETCODE_OK) return;
    if (!is_writer(&guid) && !is_reader(&guid)) return;
    struct ddsi_domaingv* domain = domain_of(entity, &guid);
    if (domain == NULL) return;
    endpoints->domain = domain;
    endpoints->guids[endpoints->count++] = guid;
}

static struct endpoints endpoints_of(dds_entity_t entity) {
    struct endpoints endpoints = {.domain = NULL, .count = 0};
    add_if_endpoint(&endpoints, entity);
    dds_entity_t children[max_endpoints];
    const dds_return_t count = dds_get_children(entity, children, max_endpoints);
    for (int i = 0; i < count && i < max_endpoints; ++i)
        add_if_endpoint(&endpoints, children[i]);
    return endpoints;
}

// Of an endpoint that is deleted: nobody but this function and the lost reference knows the key any more. A
// history that still has the instance, as that of a secure discovery writer may, never reads its key again.
static void release_key(const dds_guid_t* guid, struct ddsi_domaingv* domain) {
    const struct ddsi_sertype* type = is_writer(guid) ? domain->sedp_writer_type : domain->sedp_reader_type;
    ddsi_keyhash_t key;
    for (size_t i = 0; i < sizeof key.value; ++i)
        key.value[i] = guid->v[i];
    struct ddsi_serdata* sample = ddsi_serdata_from_keyhash(type, &key);
    if (sample == NULL) return;
    struct ddsi_tkmap_instance* instance = ddsi_tkmap_find(domain->m_tkmap, sample, false);
    if (instance != NULL) {
        const bool is_lost = ddsrt_atomic_ld32(&instance->m_refc) == 2;  // this one, and the lost one
        ddsi_tkmap_instance_unref(domain->m_tkmap, instance);
        if (is_lost) ddsi_tkmap_instance_unref(domain->m_tkmap, instance);
    }
    ddsi_serdata_unref(sample);
}

void camdir_delete_entity(dds_entity_t entity) {
    const struct endpoints endpoints = endpoints_of(entity);
    // Waits until the end of each endpoint is announced.
    if (dds_delete(entity) != DDS_RETCODE_OK || endpoints.count == 0) return;
    struct thread_state* thread = lookup_thread_state();
    thread_state_awake(thread, endpoints.domain);
    for (int i = 0; i < endpoints.count; ++i)
        release_key(&endpoints.guids[i], endpoints.domain);
    thread_state_asleep(thread);
}

#else

void camdir_delete_entity(dds_entity_t entity) {
    dds_delete(entity);
}

#endif
