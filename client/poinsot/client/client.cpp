#include "poinsot/client/client.h"

#include <algorithm>
#include <array>
#include <random>
#include <thread>
#include <utility>

#include "poinsot/base/error.h"
#include "poinsot/client/link.h"
#include "poinsot/client/loss_counter.h"
#include "poinsot/client/scene_book.h"
#include "poinsot/wire/participant.h"

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
// Longest wait before a requested stop is noticed.
constexpr auto kStopSlice = 100ms;
// A run that is slow by its time scale may be silent for so many frames [-], but no longer [s].
constexpr double kSilentFrames = 3;
constexpr double kLongestSilence = 3600;

BusOptions bus_options(const ClientOptions& options) {
  BusOptions bus;
  bus.domain = options.domain;
  bus.lan = options.lan;
  bus.partition = options.partition;
  bus.discovery_server = options.discovery_server;
  bus.shared_memory = options.shared_memory;
  return bus;
}

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

bool is_long(const WrenchCommand&) {
  return false;
}

bool is_long(const RunControl& control) {
  return control.action == ControlAction::step || control.action == ControlAction::run_until ||
         (control.action == ControlAction::save && control.on_disk);
}

}  // namespace

struct Client::Impl {
  explicit Impl(const ClientOptions& client_options)
      : options(client_options),
        participant(bus_options(options)),
        settled_at(Clock::now() + kDiscovery) {
    if (!options.world.empty()) open(options.world);
  }

  void open(const std::string& name) {
    world = name;
    link = std::make_unique<Link>(participant, world, options.poses);
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

  std::string not_matched() const {
    if (!link || !link->has_the_rest()) return nobody();
    return "world '" + world + "' does not write the poses asked for: it may have too many " +
           "filtered streams";
  }

  void find_the_only_world(Clock::time_point until) {
    std::vector<std::string> worlds;
    while (true) {
      worlds = participant.worlds();
      if (worlds != std::exchange(met, worlds))
        settled_at = std::max(settled_at, Clock::now() + kNoneCame);
      if (!worlds.empty() && Clock::now() >= settled_at) break;
      if (Clock::now() >= until) return;  // the first one met need not be the only one
      nap();
    }
    if (worlds.size() > 1)
      throw SeveralWorlds("several worlds on domain " + std::to_string(options.domain) +
                          ", name one of them: " + joined(worlds));
    open(worlds.front());
  }

  void check_stop() const {
    if (options.stop.stop_requested()) throw Stopped();
  }

  void nap() const {
    check_stop();
    std::this_thread::sleep_for(kPoll);
  }

  void wait(Waiter& waiter, Duration left) const {
    check_stop();
    waiter.wait(options.stop.stop_possible() ? std::min<Duration>(left, kStopSlice) : left);
  }

  // Waits until `ready()`; false on time-out.
  template <class Ready>
  bool wait_until(Waiter& waiter, Clock::time_point until, Ready ready) const {
    while (!ready()) {
      const Duration left = until - Clock::now();
      if (left <= 0ns) return false;
      wait(waiter, left);
    }
    return true;
  }

  // The next sample into `spare`. A frame is written again when somebody joins a paused run: who
  // has it does not get it twice.
  bool take_poses() {
    if (!link->poses) return false;
    while (link->poses->take(spare)) {
      loss.add(spare.session, spare.sequence);
      const PoseKey key{spare.session, spare.epoch, spare.frame, spare.state_hash};
      if (std::exchange(last_taken, key) != key) return true;
    }
    return false;
  }

  void take_scene() {
    BodyInfo body;
    while (link->scene->take(body)) book.add(std::move(body));
  }

  void take_reports() {
    while (link->report.take(spare_report)) {
      std::swap(newest_report, spare_report);
      book.add(newest_report);
      report_is_new = true;
    }
  }

  std::string incomplete_scene(Duration timeout) const {
    if (book.size() == 0) return nobody(timeout);
    std::string text =
        "the scene of world '" + world + "' is incomplete: " + std::to_string(book.size());
    if (book.has_report()) text += " of " + std::to_string(book.expected());
    return text + " bodies within " + seconds(timeout) +
           (book.has_report() ? "" : ", and no report came");
  }

  // The time of silence that a run as slow as this one may need.
  Duration patience(Duration timeout) const {
    const double frames_per_second = newest_report.frame_rate * newest_report.time_scale;
    if (!(frames_per_second > 0)) return timeout;
    const double seconds = std::min(kSilentFrames / frames_per_second, kLongestSilence);
    return std::max(timeout, Duration(static_cast<std::int64_t>(seconds * 1e9)));
  }

  // Whether the run has advanced since the last call.
  bool has_advanced() {
    take_reports();
    const std::array<std::uint64_t, 3> now = {newest_report.session, newest_report.epoch,
                                              newest_report.frame.frame};
    return std::exchange(progress, now) != now;
  }

  template <class Message>
  Reply ask(Publisher<Message>& publisher, Message message, Duration timeout) {
    message.client = id;
    message.seq = ++seq;
    Clock::time_point until = deadline(timeout);
    Reply reply;
    const auto answered = [&] {
      while (link->reply.take(reply))
        if (reply.client == id && reply.seq == message.seq) return true;
      return false;
    };
    while (true) {
      if (!publisher.write(message))
        throw Error("the command does not fit on the bus (body_name: at most 127 bytes of UTF-8)");
      const Clock::time_point resend = std::min(until, Clock::now() + kResendAfter);
      if (wait_until(link->reply_wait, resend, answered)) return reply;
      if (is_long(message) && has_advanced()) until = deadline(patience(timeout));
      if (Clock::now() >= until) throw NoAnswer(nobody(timeout));
    }
  }

  template <class Message>
  Tap<Message>& tap(std::unique_ptr<Tap<Message>>& made) {
    opened();
    if (!made) made = std::make_unique<Tap<Message>>(participant, world);
    return *made;
  }

  // The next sample of a topic that is read from the first call on.
  template <class Message>
  bool next(std::unique_ptr<Tap<Message>>& made, Message& received, Message& out,
            Duration timeout) {
    Tap<Message>& source = tap(made);
    const auto came = [&] { return source.subscriber.take(received); };
    if (!wait_until(source.wait, deadline(timeout), came)) return false;
    std::swap(out, received);
    return true;
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
  std::unique_ptr<Tap<ImpactNotice>> impacts;
  std::unique_ptr<Tap<ContactSnapshot>> contacts;
  std::unique_ptr<Tap<HeldList>> held;
  using PoseKey = std::array<std::uint64_t, 4>;  // session, epoch, frame, hash of the state
  PoseKey last_taken{};
  LossCounter loss;
  // Received into, then swapped: a refused sample spoils nothing.
  PoseSnapshot spare;
  ImpactNotice spare_impact;
  ContactSnapshot spare_contacts;
  HeldList newest_held, spare_held;
  RunReport newest_report, spare_report;
  bool report_is_new = false;               // not returned yet
  std::array<std::uint64_t, 3> progress{};  // session, epoch, frame
  SceneBook book;
};

std::vector<std::string> find_worlds(const ClientOptions& bus, std::chrono::nanoseconds wait) {
  const Participant participant(bus_options(bus));
  const Clock::time_point until = deadline(wait);
  while (Clock::now() < until) {
    if (bus.stop.stop_requested()) throw Stopped();
    std::this_thread::sleep_for(std::min<Client::Duration>(until - Clock::now(), kStopSlice));
  }
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
    if (!impl_->link || Clock::now() >= until) throw NoAnswer(impl_->not_matched());
    impl_->nap();
  }
}

const std::string& Client::world() const {
  return impl_->world;
}

std::uint64_t Client::id() const {
  return impl_->id;
}

bool Client::next_poses(PoseSnapshot& snapshot, Duration timeout) {
  Link& link = impl_->opened();
  const auto came = [this] { return impl_->take_poses(); };
  if (!impl_->wait_until(link.poses_wait, deadline(timeout), came)) return false;
  std::swap(snapshot, impl_->spare);
  impl_->book.add(snapshot);
  return true;
}

bool Client::latest_poses(PoseSnapshot& snapshot) {
  impl_->opened();
  bool any = false;
  for (; impl_->take_poses(); any = true) std::swap(snapshot, impl_->spare);
  if (any) impl_->book.add(snapshot);
  return any;
}

std::uint64_t Client::lost_poses() const {
  return impl_->loss.lost();
}

bool Client::next_impact(ImpactNotice& impact, Duration timeout) {
  return impl_->next(impl_->impacts, impl_->spare_impact, impact, timeout);
}

bool Client::next_contacts(ContactSnapshot& contacts, Duration timeout) {
  return impl_->next(impl_->contacts, impl_->spare_contacts, contacts, timeout);
}

std::vector<BodyInfo> Client::scene(Duration timeout) {
  Link& link = impl_->opened();
  if (!link.scene) {
    impl_->take_reports();
    impl_->book.join();
    link.join_scene(impl_->participant, impl_->world);
  }
  const auto complete = [this] {
    impl_->take_scene();
    impl_->take_reports();
    return impl_->book.is_complete();
  };
  if (!impl_->wait_until(link.scene_wait, deadline(timeout), complete))
    throw NoAnswer(impl_->incomplete_scene(timeout));
  return impl_->book.bodies();
}

std::uint32_t Client::scene_revision() const {
  return impl_->book.revision();
}

RunReport Client::report(Duration timeout) {
  Link& link = impl_->opened();
  const auto came = [this] {
    impl_->take_reports();
    return std::exchange(impl_->report_is_new, false);
  };
  if (!impl_->wait_until(link.report_wait, deadline(timeout), came))
    throw NoAnswer(impl_->nobody(timeout));
  return impl_->newest_report;
}

HeldList Client::held(Duration timeout) {
  Tap<HeldList>& tap = impl_->tap(impl_->held);
  HeldList& newest = impl_->newest_held;
  const auto known = [&] {
    while (tap.subscriber.take(impl_->spare_held)) std::swap(newest, impl_->spare_held);
    return newest.session != 0;
  };
  if (!impl_->wait_until(tap.wait, deadline(timeout), known))
    throw NoAnswer(impl_->nobody(timeout));
  return newest;
}

Reply Client::apply(WrenchCommand command, Duration timeout) {
  return impl_->ask(impl_->opened().wrench, std::move(command), timeout);
}

Reply Client::control(RunControl control, Duration timeout) {
  Link& link = impl_->opened();
  impl_->has_advanced();  // from here on
  return impl_->ask(link.control, std::move(control), timeout);
}

Reply Client::lock_step(Duration patience, Duration timeout) {
  return control({.action = ControlAction::lock_step, .timeout_ns = patience.count()}, timeout);
}

Reply Client::advance(Duration timeout) {
  return control({.action = ControlAction::advance}, timeout);
}

}  // namespace poinsot
