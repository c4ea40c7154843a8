#include "endpoints.h"

#include <stdio.h>
#include <stdlib.h>

#include "messages.h"

enum { FOR_LATE_JOINERS = 1 };

dds_return_t checked(dds_return_t result, const char* what) {
  if (result >= 0) return result;
  fprintf(stderr, "poinsot_cyclone_peer: %s: %s\n", what, dds_strretcode(-result));
  exit(1);
}

static dds_entity_t make_topic(dds_entity_t participant, const dds_topic_descriptor_t* type,
                               const char* world, const char* name) {
  char full[160];
  snprintf(full, sizeof full, "poinsot/%s/%s", world, name);
  return checked(dds_create_topic(participant, type, full, NULL, NULL), full);
}

static dds_qos_t* make_qos(int late_joiners, int depth) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_durability(qos, late_joiners ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, depth);
  return qos;
}

static dds_entity_t make_reader(dds_entity_t participant, const dds_topic_descriptor_t* type,
                                const char* world, const char* name, int late_joiners, int depth) {
  dds_qos_t* qos = make_qos(late_joiners, depth);
  const dds_entity_t topic = make_topic(participant, type, world, name);
  const dds_entity_t reader = checked(dds_create_reader(participant, topic, qos, NULL), name);
  dds_delete_qos(qos);
  return reader;
}

static dds_entity_t make_writer(dds_entity_t participant, const dds_topic_descriptor_t* type,
                                const char* world, const char* name) {
  dds_qos_t* qos = make_qos(0, 256);
  const dds_entity_t topic = make_topic(participant, type, world, name);
  const dds_entity_t writer = checked(dds_create_writer(participant, topic, qos, NULL), name);
  dds_delete_qos(qos);
  return writer;
}

Endpoints join(dds_domainid_t domain, const char* world) {
  Endpoints bus;
  const dds_entity_t us = checked(dds_create_participant(domain, NULL, NULL), "participant");
  bus.participant = us;
  bus.poses = make_reader(us, &POSES_TYPE, world, "poses", 0, 60);
  bus.scene = make_reader(us, &SCENE_TYPE, world, "scene", FOR_LATE_JOINERS, 1);
  bus.report = make_reader(us, &REPORT_TYPE, world, "report", FOR_LATE_JOINERS, 1);
  bus.events = make_reader(us, &EVENTS_TYPE, world, "events", 0, 1000);
  bus.contacts = make_reader(us, &CONTACTS_TYPE, world, "contacts", 0, 60);
  bus.held = make_reader(us, &HELD_TYPE, world, "held", 0, 60);
  bus.reply = make_reader(us, &REPLY_TYPE, world, "reply", 0, 1024);
  bus.wrench = make_writer(us, &WRENCH_TYPE, world, "wrench");
  bus.control = make_writer(us, &CONTROL_TYPE, world, "control");
  return bus;
}

unsigned met(dds_entity_t endpoint) {
  dds_subscription_matched_status_t reader;
  if (dds_get_subscription_matched_status(endpoint, &reader) == DDS_RETCODE_OK)
    return reader.current_count;
  dds_publication_matched_status_t writer;
  checked(dds_get_publication_matched_status(endpoint, &writer), "matched");
  return writer.current_count;
}
