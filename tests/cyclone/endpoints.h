/* One participant with the readers and writers of a world, under the quality of service that
   idl/README.md asks for. Whatever fails ends the program with a message. */

#pragma once

#include "dds/dds.h"

typedef struct Endpoints {
  dds_entity_t participant;
  dds_entity_t poses, scene, report, events, contacts, held, reply; /* readers */
  dds_entity_t wrench, control;                                     /* writers */
} Endpoints;

Endpoints join(dds_domainid_t domain, const char* world);

/* Endpoints of others that this reader or writer has met. */
unsigned met(dds_entity_t endpoint);

/* `result`, or the end of the program if it is an error of `what`. */
dds_return_t checked(dds_return_t result, const char* what);
