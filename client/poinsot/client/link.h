// The endpoints of a client in one world. Private to the client's library.

#pragma once

#include <optional>
#include <string>

#include "poinsot/wire/publisher.h"
#include "poinsot/wire/stream_name.h"
#include "poinsot/wire/subscriber.h"

namespace poinsot {

// What every client has.
struct Link {
  Link(Participant& participant, const std::string& world, const std::optional<PoseFilter>& filter)
      : report(participant, world),
        reply(participant, world),
        wrench(participant, world),
        control(participant, world) {
    if (filter) {
      poses.emplace(participant, world, stream_suffix(*filter));
      poses_wait.attach(*poses);
    }
    report_wait.attach(report);
    reply_wait.attach(reply);
  }

  // From now on the scene is received: for who asks for it only, because the daemon sends it whole,
  // body by body.
  void join_scene(Participant& participant, const std::string& world) {
    scene.emplace(participant, world);
    scene_wait.attach(*scene);
    scene_wait.attach(report);
  }

  bool has_poses() const { return !poses || poses->writers() > 0; }
  bool has_the_rest() const {
    return report.writers() > 0 && reply.writers() > 0 && wrench.readers() > 0 &&
           control.readers() > 0;
  }
  bool is_matched() const { return has_poses() && has_the_rest(); }

  std::optional<Subscriber<PoseSnapshot>> poses;
  std::optional<Subscriber<BodyInfo>> scene;
  Subscriber<RunReport> report;
  Subscriber<Reply> reply;
  Publisher<WrenchCommand> wrench;
  Publisher<RunControl> control;
  Waiter poses_wait, scene_wait, report_wait, reply_wait;
};

// A topic that a daemon writes only for those who read it: joined when it is first asked for.
template <class Message>
struct Tap {
  Tap(Participant& participant, const std::string& world) : subscriber(participant, world) {
    wait.attach(subscriber);
  }

  Subscriber<Message> subscriber;
  Waiter wait;
};

}  // namespace poinsot
