/* A client of another vendor:
 *
 *   poinsot_cyclone_peer DOMAIN WORLD BODY FX FY FZ SECONDS FRAMES
 *
 * meets the daemon that simulates WORLD, reads its scene, pushes BODY at its centre of mass with
 * the force (FX, FY, FZ) [N, in W] for SECONDS of simulated time, resumes the run, follows FRAMES
 * frames, pauses it again, and prints a line for all that it received and sent:
 *
 *   report STATE FRAME BODIES                    the first one
 *   body INDEX SLOT GENERATION KIND MASS NAME
 *   sent wrench|control CLIENT SEQ TEXT
 *   reply CLIENT SEQ CODE FIRST LAST HASH TEXT   to this client
 *   pose FRAME HASH BODIES VX VY VZ              velocity of BODY [m/s in W]
 *   event FRAME TIME IX IY IZ                    impulse [N s in W]
 *   contacts FRAME POINTS FX FY FZ               of all contacts, added up [N in W]
 *   held FRAME ITEMS                             wrenches that are held
 *   summary poses N gaps N scene N reports N events N contacts N held N replies N
 *
 * Exit status 0: all of it came; 1: something did not within 20 s.
 */

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "endpoints.h"
#include "messages.h"

#define PATIENCE DDS_SECS(20)
#define RESEND_AFTER DDS_MSECS(250)
#define MAX_TAKEN 64

typedef struct Peer {
  Endpoints bus;
  uint64_t client, seq;
  const char* body_name;
  BodyDescription body;  /* what BODY is; generation 0 until known */
  uint32_t scene_bodies; /* that the scene has */
  uint64_t replied;      /* seq of the newest reply to us */
  uint64_t first_frame, last_frame;
  uint64_t frame; /* newest */
  unsigned poses, gaps, scene, reports, events, contacts, held, replies;
} Peer;

/* Takes what `reader` has and hands each valid sample to `use`. */
static void take_all(Peer* peer, dds_entity_t reader, void (*use)(Peer*, const void*)) {
  void* samples[MAX_TAKEN] = {NULL}; /* lent by the reader */
  dds_sample_info_t infos[MAX_TAKEN];
  const int count = checked(dds_take(reader, samples, infos, MAX_TAKEN, MAX_TAKEN), "take");
  for (int i = 0; i < count; ++i)
    if (infos[i].valid_data) use(peer, samples[i]);
  if (count > 0) checked(dds_return_loan(reader, samples, count), "return of a loan");
}

static void use_report(Peer* peer, const void* sample) {
  const RunStatus* status = sample;
  peer->scene_bodies = status->scene_bodies;
  if (peer->reports++ == 0)
    printf("report %d %" PRIu64 " %u\n", (int)status->state, status->frame_index, status->bodies);
}

static void use_body(Peer* peer, const void* sample) {
  const BodyDescription* body = sample;
  printf("body %u %u %u %d %.17g %s\n", body->scene_index, body->slot, body->generation,
         (int)body->kind, body->mass, body->name);
  if (strcmp(body->name, peer->body_name) == 0) peer->body = *body; /* numbers only are used */
  ++peer->scene;
}

static void use_poses(Peer* peer, const void* sample) {
  const PoseFrame* frame = sample;
  if (peer->poses > 0 && frame->frame_index == peer->frame) return; /* shown again to newcomers */
  if (peer->poses > 0 && frame->frame_index != peer->frame + 1) ++peer->gaps;
  ++peer->poses;
  peer->frame = frame->frame_index;
  for (uint32_t i = 0; i < frame->bodies._length; ++i) {
    const BodyMotion* motion = &frame->bodies._buffer[i];
    if (motion->body.slot != peer->body.slot || motion->body.generation != peer->body.generation)
      continue;
    printf("pose %" PRIu64 " %" PRIu64 " %u %.17g %.17g %.17g\n", frame->frame_index,
           frame->state_hash, frame->bodies._length, motion->linear_velocity.x,
           motion->linear_velocity.y, motion->linear_velocity.z);
  }
}

static void use_event(Peer* peer, const void* sample) {
  const ImpactEvent* event = sample;
  printf("event %" PRIu64 " %.17g %.17g %.17g %.17g\n", event->frame_index, event->time,
         event->impulse.x, event->impulse.y, event->impulse.z);
  ++peer->events;
}

static void use_contacts(Peer* peer, const void* sample) {
  const ContactFrame* frame = sample;
  double force[3] = {0, 0, 0};
  for (uint32_t i = 0; i < frame->contacts._length; ++i) {
    force[0] += frame->contacts._buffer[i].force.x;
    force[1] += frame->contacts._buffer[i].force.y;
    force[2] += frame->contacts._buffer[i].force.z;
  }
  printf("contacts %" PRIu64 " %u %.17g %.17g %.17g\n", frame->frame_index, frame->contacts._length,
         force[0], force[1], force[2]);
  ++peer->contacts;
}

static void use_held(Peer* peer, const void* sample) {
  const HeldWrenches* held = sample;
  printf("held %" PRIu64 " %u\n", held->frame_index, held->items._length);
  ++peer->held;
}

static void use_reply(Peer* peer, const void* sample) {
  const CommandReply* reply = sample;
  if (reply->client != peer->client || reply->seq <= peer->replied) return;
  printf("reply %" PRIu64 " %" PRIu64 " %u %" PRIu64 " %" PRIu64 " %" PRIu64 " %s\n", reply->client,
         reply->seq, reply->code, reply->first_frame, reply->last_frame, reply->state_hash,
         reply->text);
  peer->replied = reply->seq;
  peer->first_frame = reply->first_frame;
  peer->last_frame = reply->last_frame;
  ++peer->replies;
}

static int has_scene(const Peer* peer) {
  return peer->reports > 0 && peer->scene > 0 && peer->scene == peer->scene_bodies;
}

static void receive(Peer* peer) {
  take_all(peer, peer->bus.report, use_report);
  take_all(peer, peer->bus.scene, use_body);
  if (has_scene(peer)) take_all(peer, peer->bus.poses, use_poses); /* bodies are known by it */
  take_all(peer, peer->bus.events, use_event);
  take_all(peer, peer->bus.contacts, use_contacts);
  take_all(peer, peer->bus.held, use_held);
  take_all(peer, peer->bus.reply, use_reply);
  fflush(stdout);
}

/* Receives until `done` or `deadline`; whether it is done. */
static int receive_until(Peer* peer, int (*done)(const Peer*), dds_time_t deadline) {
  while (!done(peer) && dds_time() < deadline) {
    dds_sleepfor(DDS_MSECS(2));
    receive(peer);
  }
  return done(peer);
}

static void need(Peer* peer, int (*done)(const Peer*), const char* what) {
  if (receive_until(peer, done, dds_time() + PATIENCE)) return;
  fprintf(stderr, "poinsot_cyclone_peer: %s did not come\n", what);
  exit(1);
}

static int is_met(const Peer* peer) {
  return met(peer->bus.wrench) > 0 && met(peer->bus.control) > 0 && met(peer->bus.reply) > 0 &&
         met(peer->bus.poses) > 0 && met(peer->bus.events) > 0;
}

static int has_poses(const Peer* peer) {
  return peer->poses > 0;
}

static int has_reply(const Peer* peer) {
  return peer->replied == peer->seq;
}

/* A command is sent again until it is answered: the daemon knows it by (client, seq). */
static void send_until_answered(Peer* peer, dds_entity_t writer, const void* command,
                                const char* what) {
  const dds_time_t deadline = dds_time() + PATIENCE;
  printf("sent %s %" PRIu64 " %" PRIu64 "\n", what, peer->client, peer->seq);
  do {
    checked(dds_write(writer, command), what);
  } while (!receive_until(peer, has_reply, dds_time() + RESEND_AFTER) && dds_time() < deadline);
  need(peer, has_reply, what);
}

static void push(Peer* peer, double x, double y, double z, double seconds) {
  BodyWrench wrench;
  memset(&wrench, 0, sizeof wrench);
  wrench.client = peer->client;
  wrench.seq = ++peer->seq;
  wrench.body.slot = peer->body.slot;
  wrench.body.generation = peer->body.generation;
  wrench.kind = WRENCH_FORCE;
  wrench.force.x = x;
  wrench.force.y = y;
  wrench.force.z = z;
  wrench.axes = AXES_WORLD;
  wrench.point_kind = POINT_CENTER_OF_MASS;
  wrench.hold = HOLD_DURATION;
  wrench.duration_ns = (int64_t)(seconds * 1e9);
  send_until_answered(peer, peer->bus.wrench, &wrench, "wrench");
}

static void control(Peer* peer, int action) {
  RunRequest request;
  memset(&request, 0, sizeof request);
  request.client = peer->client;
  request.seq = ++peer->seq;
  request.action = action;
  send_until_answered(peer, peer->bus.control, &request, "control");
}

static uint64_t random_client(void) {
  return (uint64_t)dds_time() * 6364136223846793005u ^ (uint64_t)getpid();
}

int main(int argc, char** argv) {
  if (argc != 9) {
    fprintf(stderr, "usage: poinsot_cyclone_peer DOMAIN WORLD BODY FX FY FZ SECONDS FRAMES\n");
    return 2;
  }
  static Peer peer;
  peer.client = random_client();
  peer.body_name = argv[3];
  peer.bus = join((dds_domainid_t)atoi(argv[1]), argv[2]);
  need(&peer, is_met, "a daemon");
  need(&peer, has_scene, "the whole scene");
  need(&peer, has_poses, "a frame");

  push(&peer, atof(argv[4]), atof(argv[5]), atof(argv[6]), atof(argv[7]));
  control(&peer, CONTROL_RESUME);
  const uint64_t last = peer.frame + strtoull(argv[8], NULL, 10);
  const dds_time_t deadline = dds_time() + PATIENCE;
  while (peer.frame < last && dds_time() < deadline) {
    dds_sleepfor(DDS_MSECS(2));
    receive(&peer);
  }
  control(&peer, CONTROL_PAUSE);
  printf("summary poses %u gaps %u scene %u reports %u events %u contacts %u held %u replies %u\n",
         peer.poses, peer.gaps, peer.scene, peer.reports, peer.events, peer.contacts, peer.held,
         peer.replies);
  checked(dds_delete(peer.bus.participant), "leaving");
  return peer.frame >= last ? 0 : 1;
}
