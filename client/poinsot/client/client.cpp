#include "poinsot/client/client.h"

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <thread>
#include <utility>

#include "poinsot/base/error.h"
#include "poinsot/wire/participant.h"
#include "poinsot/wire/publisher.h"
#include "poinsot/wire/subscriber.h"

namespace poinsot {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kResendAfter = 250ms;
constexpr auto kPoll = 2ms;
// Daemons that run are discovered within this time after joining: they announce themselves four
// times a second.
constexpr auto kDiscovery = 400ms;
// On a busy machine it takes longer: all that are there have been met when none came for so long.
constexpr auto kNoneCame = 300ms;

std::uint64_t random_id() {
  std::random_device random;
  std::uint64_t id = 0;
  while (id == 0) id = (std::uint64_t{random()} << 32) | random();
  return id;
}

std::uint64_t nanoseconds_since_1970() {
  const auto time = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(std::chrono::nanoseconds(time).count());
}

std::string seconds(Client::Duration duration) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g s", std::chrono::duration<double>(duration).count());
  return text.data();
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// A point in time that does not overflow for "for ever".
Clock::time_point deadline(Client::Duration timeout) {
  return Clock::now() + std::clamp<Client::Duration>(timeout, 0ns, std::chrono::hours(24 * 365));
}

// The endpoints of one world.
struct Link {
  Link(Participant& participant, const std::string& world)
      : poses(participant, world),
        scene(participant, world),
        report(participant, world),
        reply(participant, world),
        wrench(participant, world),
        control(participant, world) {
    poses_wait.attach(poses);
    scene_wait.attach(scene);
    report_wait.attach(report);
    reply_wait.attach(reply);
  }

  bool is_matched() const {
    return poses.writers() > 0 && scene.writers() > 0 && report.writers() > 0 &&
           reply.writers() > 0 && wrench.readers() > 0 && control.readers() > 0;
  }

  Subscriber<PoseSnapshot> poses;
  Subscriber<BodyInfo> scene;
  Subscriber<RunReport> report;
  Subscriber<Reply> reply;
  Publisher<WrenchCommand> wrench;
  Publisher<RunControl> control;
  Waiter poses_wait, scene_wait, report_wait, reply_wait;
};

// Apart from the others: a daemon writes impacts only for those who ask.
struct EventsLink {
  EventsLink(Participant& participant, const std::string& world) : events(participant, world) {
    wait.attach(events);
  }

  Subscriber<ImpactNotice> events;
  Waiter wait;
};

using Bodies = std::map<std::uint32_t, BodyInfo>;  // by place in the scene file

bool is_complete(const Bodies& bodies, std::uint32_t count) {
  return !bodies.empty() && bodies.size() == count;
}

}  // namespace

struct Client::Impl {
  explicit Impl(const ClientOptions& client_options)
      : options(client_options),
        participant({.domain = options.domain, .lan = options.lan}),
        settled_at(Clock::now() + kDiscovery) {
    if (!options.world.empty()) open(options.world);
  }

  void open(const std::string& name) {
    world = name;
    link = std::make_unique<Link>(participant, world);
  }

  Link& opened() {
    if (!link) throw NoAnswer("no world is named: wait_for_server() finds it");
    return *link;
  }

  std::string nobody(Duration timeout) const { return nobody(" within " + seconds(timeout)); }

  std::string nobody(const std::string& after = {}) const {
    const std::vector<std::string> worlds = participant.worlds();
    const std::string domain = "domain " + std::to_string(options.domain);
    if (worlds.empty()) return "no daemon found on " + domain + after;
    if (world.empty()) return "no daemon answered on " + domain + after;
    if (std::find(worlds.begin(), worlds.end(), world) != worlds.end())
      return "world '" + world + "' on " + domain + " did not answer" + after;
    return "world '" + world + "' not found on " + domain + after + "; there is: " + joined(worlds);
  }

  void find_the_only_world(Clock::time_point until) {
    std::vector<std::string> worlds;
    while (true) {
      worlds = participant.worlds();
      if (worlds != std::exchange(met, worlds))
        settled_at = std::max(settled_at, Clock::now() + kNoneCame);
      if (!worlds.empty() && Clock::now() >= settled_at) break;
      if (Clock::now() >= until) return;  // the first one met need not be the only one
      std::this_thread::sleep_for(kPoll);
    }
    if (worlds.size() > 1)
      throw SeveralWorlds("several worlds on domain " + std::to_string(options.domain) +
                          ", name one of them: " + joined(worlds));
    open(worlds.front());
  }

  // The next sample into `spare`. A frame is written again when somebody joins a paused run: who
  // has it does not get it twice.
  bool take_poses() {
    while (link->poses.take(spare)) {
      const PoseKey key{spare.session, spare.epoch, spare.frame};
      if (std::exchange(last_taken, key) != key) return true;
    }
    return false;
  }

  // The bodies of the daemon that the client looks at: the one whose poses or report it read last,
  // or else whose scene came last.
  const Bodies& current_scene() const {
    const auto looked_at = scenes.find(session != 0 ? session : scene_session);
    return looked_at == scenes.end() ? no_bodies : looked_at->second;
  }

  void take_scene() {
    BodyInfo body;
    while (link->scene.take(body)) {
      if (body.removed) {
        std::erase_if(scenes[scene_session],
                      [&](const auto& entry) { return entry.second.id == body.id; });
        continue;
      }
      scene_session = body.session;
      scenes[body.session][body.index] = std::move(body);
      // A daemon that is gone is looked at a little longer than it lives; older ones are not.
      std::erase_if(scenes, [&](const auto& entry) {
        return entry.first != scene_session && entry.first != session;
      });
    }
  }

  void take_reports() {
    while (link->report.take(spare_report)) {
      std::swap(newest_report, spare_report);
      report_is_new = true;
    }
  }

  template <class Message>
  Reply ask(Publisher<Message>& publisher, Message message, Duration timeout) {
    message.client = id;
    message.seq = ++seq;
    const Clock::time_point until = deadline(timeout);
    Reply reply;
    while (true) {
      if (!publisher.write(message))
        throw Error("the command does not fit on the bus (body_name: at most 127 bytes of UTF-8)");
      const Clock::time_point resend = std::min(until, Clock::now() + kResendAfter);
      do {
        while (link->reply.take(reply))
          if (reply.client == id && reply.seq == message.seq) return reply;
        link->reply_wait.wait(resend - Clock::now());
      } while (Clock::now() < resend);
      if (Clock::now() >= until) throw NoAnswer(nobody(timeout));
    }
  }

  ClientOptions options;
  Participant participant;
  std::vector<std::string> met;  // worlds
  Clock::time_point settled_at;  // no others are expected after it
  std::uint64_t id = options.client != 0 ? options.client : random_id();
  // Who shares an identity must not use a number twice; the time never stands still between them.
  std::uint64_t seq = options.client != 0 ? nanoseconds_since_1970() : 0;
  std::string world;
  std::unique_ptr<Link> link;
  std::unique_ptr<EventsLink> events;
  ImpactNotice spare_impact;                     // received into
  using PoseKey = std::array<std::uint64_t, 3>;  // session, epoch, frame
  PoseKey last_taken{};
  PoseSnapshot spare;  // received into, then swapped: a refused sample spoils nothing
  RunReport newest_report, spare_report;
  bool report_is_new = false;              // not returned yet
  std::uint64_t session = 0;               // of the poses or report read last
  std::uint64_t scene_session = 0;         // of the body received last
  std::map<std::uint64_t, Bodies> scenes;  // by session
  const Bodies no_bodies;
};

std::vector<std::string> find_worlds(int domain, bool lan, std::chrono::nanoseconds wait) {
  const Participant participant({.domain = domain, .lan = lan});
  std::this_thread::sleep_for(wait);
  return participant.worlds();
}

Client::Client(const ClientOptions& options) : impl_(std::make_unique<Impl>(options)) {}
Client::~Client() = default;
Client::Client(Client&&) noexcept = default;
Client& Client::operator=(Client&&) noexcept = default;

void Client::wait_for_server(Duration timeout) {
  const Clock::time_point until = deadline(timeout);
  if (!impl_->link) impl_->find_the_only_world(until);
  while (!impl_->link || !impl_->link->is_matched()) {
    if (!impl_->link || Clock::now() >= until) throw NoAnswer(impl_->nobody());
    std::this_thread::sleep_for(kPoll);
  }
}

const std::string& Client::world() const {
  return impl_->world;
}

bool Client::next_poses(PoseSnapshot& snapshot, Duration timeout) {
  Link& link = impl_->opened();
  const Clock::time_point until = deadline(timeout);
  while (!impl_->take_poses()) {
    const Duration left = until - Clock::now();
    if (left <= 0ns) return false;
    link.poses_wait.wait(left);
  }
  std::swap(snapshot, impl_->spare);
  impl_->session = snapshot.session;
  return true;
}

bool Client::latest_poses(PoseSnapshot& snapshot) {
  impl_->opened();
  bool any = false;
  for (; impl_->take_poses(); any = true) std::swap(snapshot, impl_->spare);
  if (any) impl_->session = snapshot.session;
  return any;
}

bool Client::next_impact(ImpactNotice& impact, Duration timeout) {
  impl_->opened();
  if (!impl_->events)
    impl_->events = std::make_unique<EventsLink>(impl_->participant, impl_->world);
  const Clock::time_point until = deadline(timeout);
  while (!impl_->events->events.take(impl_->spare_impact)) {
    const Duration left = until - Clock::now();
    if (left <= 0ns) return false;
    impl_->events->wait.wait(left);
  }
  impact = impl_->spare_impact;
  return true;
}

std::vector<BodyInfo> Client::scene(Duration timeout) {
  Link& link = impl_->opened();
  const Clock::time_point until = deadline(timeout);
  std::uint32_t count = 0;
  while (true) {
    impl_->take_scene();
    impl_->take_reports();
    count = impl_->newest_report.scene_bodies;
    if (is_complete(impl_->current_scene(), count)) break;
    const Duration left = until - Clock::now();
    if (left <= 0ns)
      throw NoAnswer(impl_->current_scene().empty()
                         ? impl_->nobody(timeout)
                         : "the scene of world '" + impl_->world + "' is incomplete: " +
                               std::to_string(impl_->current_scene().size()) + " of " +
                               std::to_string(count) + " bodies within " + seconds(timeout));
    link.scene_wait.wait(std::min<Duration>(left, 50ms));  // a report may complete it as well
  }
  std::vector<BodyInfo> bodies;
  for (const auto& [index, body] : impl_->current_scene()) bodies.push_back(body);
  return bodies;
}

RunReport Client::report(Duration timeout) {
  Link& link = impl_->opened();
  const Clock::time_point until = deadline(timeout);
  while (impl_->take_reports(), !impl_->report_is_new) {
    const Duration left = until - Clock::now();
    if (left <= 0ns) throw NoAnswer(impl_->nobody(timeout));
    link.report_wait.wait(left);
  }
  impl_->report_is_new = false;
  impl_->session = impl_->newest_report.session;
  return impl_->newest_report;
}

Reply Client::apply(WrenchCommand command, Duration timeout) {
  return impl_->ask(impl_->opened().wrench, std::move(command), timeout);
}

Reply Client::control(RunControl control, Duration timeout) {
  return impl_->ask(impl_->opened().control, control, timeout);
}

}  // namespace poinsot
