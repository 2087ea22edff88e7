/* Plugins of DDS Security for an attacker's participant: those of Cyclone DDS, but its access control allows
 * whatever this participant wants to do, and all that others do, and its authentication goes on when its
 * certificate has expired. So only the others are left to refuse it. */
#include <dds/security/dds_security_api.h>

int init_access_control(const char* argument, void** context, struct ddsi_domaingv* gv);
int finalize_access_control(void* context);
int init_permissive_access_control(const char* argument, void** context, struct ddsi_domaingv* gv);
int finalize_permissive_access_control(void* context);
int init_authentication(const char* argument, void** context, struct ddsi_domaingv* gv);
int finalize_authentication(void* context);
int init_permissive_authentication(const char* argument, void** context, struct ddsi_domaingv* gv);
int finalize_permissive_authentication(void* context);

static DDS_Security_boolean create_participant(dds_security_access_control* instance,
                                               DDS_Security_PermissionsHandle permissions,
                                               DDS_Security_DomainId domain, const DDS_Security_Qos* qos,
                                               DDS_Security_SecurityException* ex) {
    (void)instance, (void)permissions, (void)domain, (void)qos, (void)ex;
    return true;
}

static DDS_Security_boolean create_endpoint(dds_security_access_control* instance,
                                            DDS_Security_PermissionsHandle permissions,
                                            DDS_Security_DomainId domain, const DDS_Security_char* topic,
                                            const DDS_Security_Qos* qos,
                                            const DDS_Security_PartitionQosPolicy* partition,
                                            const DDS_Security_DataTags* tags,
                                            DDS_Security_SecurityException* ex) {
    (void)instance, (void)permissions, (void)domain, (void)topic, (void)qos, (void)partition, (void)tags,
        (void)ex;
    return true;
}

static DDS_Security_boolean create_topic(dds_security_access_control* instance,
                                         DDS_Security_PermissionsHandle permissions,
                                         DDS_Security_DomainId domain, const DDS_Security_char* topic,
                                         const DDS_Security_Qos* qos, DDS_Security_SecurityException* ex) {
    (void)instance, (void)permissions, (void)domain, (void)topic, (void)qos, (void)ex;
    return true;
}

static DDS_Security_boolean remote_participant(dds_security_access_control* instance,
                                               DDS_Security_PermissionsHandle permissions,
                                               DDS_Security_DomainId domain,
                                               const DDS_Security_ParticipantBuiltinTopicDataSecure* data,
                                               DDS_Security_SecurityException* ex) {
    (void)instance, (void)permissions, (void)domain, (void)data, (void)ex;
    return true;
}

static DDS_Security_boolean remote_writer(dds_security_access_control* instance,
                                          DDS_Security_PermissionsHandle permissions,
                                          DDS_Security_DomainId domain,
                                          const DDS_Security_PublicationBuiltinTopicDataSecure* data,
                                          DDS_Security_SecurityException* ex) {
    (void)instance, (void)permissions, (void)domain, (void)data, (void)ex;
    return true;
}

static DDS_Security_boolean remote_reader(dds_security_access_control* instance,
                                          DDS_Security_PermissionsHandle permissions,
                                          DDS_Security_DomainId domain,
                                          const DDS_Security_SubscriptionBuiltinTopicDataSecure* data,
                                          DDS_Security_boolean* relay_only,
                                          DDS_Security_SecurityException* ex) {
    (void)instance, (void)permissions, (void)domain, (void)data, (void)ex;
    *relay_only = false;
    return true;
}

int init_permissive_access_control(const char* argument, void** context, struct ddsi_domaingv* gv) {
    const int failed = init_access_control(argument, context, gv);
    if (failed) return failed;
    dds_security_access_control* plugin = *context;
    plugin->check_create_participant = create_participant;
    plugin->check_create_datawriter = create_endpoint;
    plugin->check_create_datareader = create_endpoint;
    plugin->check_create_topic = create_topic;
    plugin->check_remote_participant = remote_participant;
    plugin->check_remote_datawriter = remote_writer;
    plugin->check_remote_datareader = remote_reader;
    return 0;
}

int finalize_permissive_access_control(void* context) {
    return finalize_access_control(context);
}

static DDS_Security_boolean set_no_listener(dds_security_authentication* instance,
                                            const dds_security_authentication_listener* listener,
                                            DDS_Security_SecurityException* ex) {
    (void)instance, (void)listener, (void)ex;
    return true;
}

int init_permissive_authentication(const char* argument, void** context, struct ddsi_domaingv* gv) {
    const int failed = init_authentication(argument, context, gv);
    if (failed) return failed;
    dds_security_authentication* plugin = *context;
    plugin->set_listener = set_no_listener;
    return 0;
}

int finalize_permissive_authentication(void* context) {
    return finalize_authentication(context);
}
