#include "poinsot/client/client.h"

#include <atomic>
#include <map>
#include <signal.h>
#include <thread>

#include <gtest/gtest.h>

#include "bus/roles.h"
#include "poinsot/wire/publisher.h"
#include "poinsot/wire/subscriber.h"
#include "support/child_process.h"
#include "support/protocol_equality.h"
#include "support/protocol_samples.h"
#include "support/test_domain.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;
using Names = std::vector<std::string>;

// The daemon's side of one world, as far as the bus sees it. Answers a command when it has received
// it for the `deaf`th time and one more; first_frame of the reply counts the receptions.
class FakeDaemon {
 public:
  explicit FakeDaemon(const std::string& world, int deaf = 0, std::uint32_t missing_bodies = 0)
      : participant_({.domain = test_domain()}),
        poses(participant_, world),
        report(participant_, world),
        events(participant_, world),
        scene(participant_, world),
        contacts(participant_, world),
        held(participant_, world),
        reply_(participant_, world),
        wrench_(participant_, world),
        control_(participant_, world),
        deaf_(deaf) {
    for (std::uint32_t i = kBodies; i > missing_bodies; --i)
      scene.write(sample::body_info(i - 1, kRevision));
    report.write(report_of(kBodies, kRevision));
    waiter_.attach(wrench_);
    waiter_.attach(control_);
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
  }
  ~FakeDaemon() {
    thread_.request_stop();
    waiter_.wake();
  }

  static constexpr std::uint32_t kBodies = 3, kRevision = 3;

  // Of the session that the bodies are of.
  static RunReport report_of(std::uint32_t bodies, std::uint32_t revision) {
    RunReport report = sample::report();
    report.session = sample::body_info(0, 1).session;
    report.scene_bodies = bodies;
    report.scene_revision = revision;
    return report;
  }

 private:
  Participant participant_;

 public:
  Publisher<PoseSnapshot> poses;
  Publisher<RunReport> report;
  Publisher<ImpactNotice> events;
  Publisher<BodyInfo> scene;
  Publisher<ContactSnapshot> contacts;
  Publisher<HeldList> held;

 private:
  void serve(const std::stop_token& stop) {
    WrenchCommand command;
    RunControl control;
    while (!stop.stop_requested()) {
      waiter_.wait(1s);
      while (wrench_.take(command)) answer(command.client, command.seq);
      while (control_.take(control)) answer(control.client, control.seq);
    }
  }

  void answer(std::uint64_t client, std::uint64_t seq) {
    const int times = ++received_[{client, seq}];
    // Replies to others come in between.
    reply_.write({.client = client + 1, .seq = seq, .message = "another client's"});
    reply_.write({.client = client, .seq = seq + 1000, .message = "another command's"});
    if (times <= deaf_) return;
    reply_.write({.client = client,
                  .seq = seq,
                  .message = "yours",
                  .first_frame = static_cast<std::uint64_t>(times)});
  }

  Publisher<Reply> reply_;
  Subscriber<WrenchCommand> wrench_;
  Subscriber<RunControl> control_;
  Waiter waiter_;
  int deaf_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, int> received_;
  std::jthread thread_;
};

std::string text_of_no_answer(const std::function<void()>& call) {
  try {
    call();
  } catch (const NoAnswer& error) {
    return error.what();
  }
  ADD_FAILURE() << "answered";
  return {};
}

ClientOptions on_test_domain(const std::string& world) {
  return {.world = world, .domain = test_domain()};
}

TEST(ClientTest, GetsTheReplyToItsOwnCommand) {
  FakeDaemon daemon("replies");
  Client client(on_test_domain("replies"));
  client.wait_for_server(kPatience);
  EXPECT_EQ(client.apply({.body_name = "box"}, kPatience).message, "yours");
  const Reply reply = client.control({.action = ControlAction::pause}, kPatience);
  EXPECT_EQ(reply.message, "yours");
  EXPECT_EQ(reply.seq, 2u);  // commands and controls are counted together
}

TEST(ClientTest, ResendsUntilItIsAnswered) {
  FakeDaemon daemon("deaf", 2);
  Client client(on_test_domain("deaf"));
  client.wait_for_server(kPatience);
  EXPECT_EQ(client.apply({.body_name = "box"}, kPatience).first_frame, 3u);
}

TEST(ClientTest, ASilentDaemonIsNoAnswer) {
  FakeDaemon daemon("silent", 1000);
  Client client(on_test_domain("silent"));
  client.wait_for_server(kPatience);
  const std::string text = text_of_no_answer([&] { client.apply({.body_name = "box"}, 400ms); });
  EXPECT_EQ(text, "world 'silent' on domain " + std::to_string(test_domain()) +
                      " did not answer within 0.4 s");
}

TEST(ClientTest, ACommandThatDoesNotFitIsAnError) {
  FakeDaemon daemon("fit");
  Client client(on_test_domain("fit"));
  EXPECT_ANY_THROW(client.apply({.body_name = std::string(1000, 'a')}, kPatience));
}

TEST(ClientTest, FindsTheOnlyWorldByItself) {
  FakeDaemon daemon("only");
  Client client(on_test_domain(""));
  PoseSnapshot poses;
  EXPECT_THROW(client.latest_poses(poses), NoAnswer);
  client.wait_for_server(kPatience);
  EXPECT_EQ(client.world(), "only");
  EXPECT_EQ(client.apply({.body_name = "box"}, kPatience).message, "yours");
}

TEST(ClientTest, ListsTheWorldsIfThereAreSeveral) {
  FakeDaemon first("one");
  FakeDaemon second("two");
  first.report.write(sample::report());
  Client unnamed(on_test_domain(""));
  EXPECT_EQ(
      text_of_no_answer([&] { unnamed.wait_for_server(kPatience); }),
      "several worlds on domain " + std::to_string(test_domain()) + ", name one of them: one, two");
  EXPECT_EQ(find_worlds(on_test_domain(""), 500ms), (Names{"one", "two"}));
  Client wrong(on_test_domain("three"));
  EXPECT_EQ(text_of_no_answer([&] { wrong.wait_for_server(500ms); }),
            "world 'three' not found on domain " + std::to_string(test_domain()) +
                "; there is: one, two");
}

TEST(ClientTest, SaysThatNobodyIsThere) {
  Client client(on_test_domain(""));
  EXPECT_EQ(text_of_no_answer([&] { client.wait_for_server(300ms); }),
            "no daemon found on domain " + std::to_string(test_domain()));
}

TEST(ClientTest, ReadsFramesInOrderAndTheNewestAtOnce) {
  FakeDaemon daemon("frames");
  Client client(on_test_domain("frames"));
  client.wait_for_server(kPatience);
  ASSERT_TRUE(eventually([&] { return daemon.poses.readers() == 1; }));
  PoseSnapshot poses = sample::poses(77, 2);
  EXPECT_FALSE(client.latest_poses(poses));
  EXPECT_FALSE(client.next_poses(poses, 10ms));
  expect_same(poses, sample::poses(77, 2));  // left alone
  for (std::uint64_t frame = 1; frame <= 20; ++frame) daemon.poses.write(sample::poses(frame, 2));
  for (std::uint64_t frame = 1; frame <= 10; ++frame) {
    ASSERT_TRUE(client.next_poses(poses, kPatience));
    expect_same(poses, sample::poses(frame, 2));
  }
  ASSERT_TRUE(eventually([&] { return client.latest_poses(poses) && poses.frame == 20; }));
  EXPECT_FALSE(client.latest_poses(poses));
}

TEST(ClientTest, KnowsTheSceneOnceItIsComplete) {
  FakeDaemon daemon("scene");
  Client client(on_test_domain("scene"));
  const std::vector<BodyInfo> bodies = client.scene(kPatience);
  ASSERT_EQ(bodies.size(), FakeDaemon::kBodies);
  for (std::uint32_t i = 0; i < FakeDaemon::kBodies; ++i)
    expect_same(bodies[i], sample::body_info(i, FakeDaemon::kRevision));
  EXPECT_EQ(client.scene(0s).size(), FakeDaemon::kBodies);
}

TEST(ClientTest, SaysWhatOfTheSceneIsMissing) {
  FakeDaemon daemon("partial", 0, 1);
  Client client(on_test_domain("partial"));
  client.wait_for_server(kPatience);
  EXPECT_EQ(text_of_no_answer([&] { client.scene(500ms); }),
            "the scene of world 'partial' is incomplete: 2 of 3 bodies within 0.5 s");
}

TEST(ClientTest, FollowsWhatIsSpawnedAndRemoved) {
  FakeDaemon daemon("changes");
  Client client(on_test_domain("changes"));
  ASSERT_EQ(client.scene(kPatience).size(), 3u);
  const BodyInfo spawned = sample::body_info(7, 4);
  daemon.scene.write(spawned);
  daemon.report.write(FakeDaemon::report_of(4, 4));
  ASSERT_TRUE(eventually([&] { return client.scene(kPatience).size() == 4; }));
  EXPECT_EQ(client.scene_revision(), 4u);
  BodyInfo gone = sample::body_info(0, 5);
  gone.removed = true;
  daemon.scene.write(gone);
  daemon.report.write(FakeDaemon::report_of(3, 5));
  ASSERT_TRUE(eventually([&] { return client.scene(kPatience).size() == 3; }));
  EXPECT_EQ(client.scene(kPatience).back().name, spawned.name);
  Client late(on_test_domain("changes"));
  EXPECT_EQ(late.scene(kPatience).size(), 3u);
}

TEST(ClientTest, ReceivesNoPosesIfItWantsNone) {
  FakeDaemon daemon("none");
  ClientOptions options = on_test_domain("none");
  options.poses = std::nullopt;
  Client client(options);
  client.wait_for_server(kPatience);
  EXPECT_EQ(daemon.poses.readers(), 0);
  PoseSnapshot poses;
  EXPECT_FALSE(client.next_poses(poses, 10ms));
}

TEST(ClientTest, CountsThePosesThatDidNotArrive) {
  FakeDaemon daemon("lost");
  Client client(on_test_domain("lost"));
  client.wait_for_server(kPatience);
  ASSERT_TRUE(eventually([&] { return daemon.poses.readers() == 1; }));
  PoseSnapshot poses = sample::poses(1, 2);
  for (const std::uint64_t sequence : {5, 6, 9}) {
    poses.frame = poses.sequence = sequence;
    daemon.poses.write(poses);
    ASSERT_TRUE(client.next_poses(poses, kPatience));
  }
  EXPECT_EQ(client.lost_poses(), 2u);
}

TEST(ClientTest, ReadsContactsAndWhatIsHeldFromTheFirstCallOn) {
  FakeDaemon daemon("taps");
  Client client(on_test_domain("taps"));
  client.wait_for_server(kPatience);
  ContactSnapshot contacts;
  EXPECT_FALSE(client.next_contacts(contacts, 0ms));
  ASSERT_TRUE(eventually([&] { return daemon.contacts.readers() == 1; }));
  const ContactSnapshot sent = sample::contacts();
  daemon.contacts.write(sent);
  ASSERT_TRUE(client.next_contacts(contacts, kPatience));
  EXPECT_EQ(contacts.contacts.size(), sent.contacts.size());

  EXPECT_THROW(client.held(0ms), NoAnswer);
  ASSERT_TRUE(eventually([&] { return daemon.held.readers() == 1; }));
  daemon.held.write(sample::held());
  EXPECT_EQ(client.held(kPatience).items.size(), sample::held().items.size());
  EXPECT_EQ(client.held(0ms).items.size(), sample::held().items.size()) << "it is known";
}

TEST(ClientTest, WaitsForALongControlWhileTheRunAdvances) {
  constexpr int kDeaf = 6;  // times 250 ms
  FakeDaemon daemon("long", kDeaf);
  Client client(on_test_domain("long"));
  client.wait_for_server(kPatience);
  std::jthread run([&](const std::stop_token& stop) {
    RunReport report = FakeDaemon::report_of(3, 3);
    for (; !stop.stop_requested(); ++report.frame.frame) {
      daemon.report.write(report);
      std::this_thread::sleep_for(50ms);
    }
  });
  const Reply reply = client.control({.action = ControlAction::step, .frames = 1000}, 700ms);
  EXPECT_EQ(reply.first_frame, kDeaf + 1u);
  EXPECT_THROW(client.control({.action = ControlAction::pause}, 700ms), NoAnswer)
      << "a short one is not waited for longer";
}

TEST(ClientTest, AStopEndsWhateverWaits) {
  std::stop_source stop;
  ClientOptions options = on_test_domain("stopped");
  options.stop = stop.get_token();
  Client client(options);
  const std::jthread later([&] {
    std::this_thread::sleep_for(50ms);
    stop.request_stop();
  });
  EXPECT_THROW(client.scene(kPatience), Stopped);
  EXPECT_THROW(client.wait_for_server(kPatience), Stopped);
  PoseSnapshot poses;
  EXPECT_THROW(client.next_poses(poses, kPatience), Stopped);
  EXPECT_THROW(client.apply({.body_name = "box"}, kPatience), Stopped);
}

TEST(ClientTest, ReturnsEachReportOnceAndTheNewestOfThem) {
  FakeDaemon daemon("report");
  RunReport report = sample::report();
  daemon.report.write(report);
  Client client(on_test_domain("report"));
  expect_same(client.report(kPatience), report);
  EXPECT_THROW(client.report(10ms), NoAnswer);
  report.frame.frame = 99;
  daemon.report.write(report);
  EXPECT_EQ(client.report(kPatience).frame.frame, 99u);
}

TEST(ClientTest, MeetsADaemonAgainThatWasKilledAndRestarted) {
  auto daemon = std::make_unique<ChildProcess>(role("serve", "restart", 1));
  Client client(on_test_domain("restart"));
  client.wait_for_server(kPatience);
  PoseSnapshot poses;
  for (int restart = 0; restart < 3; ++restart) {
    const auto session = static_cast<std::uint64_t>(daemon->id());
    ASSERT_TRUE(eventually(
        [&] { return client.next_poses(poses, kPatience) && poses.session == session; }));
    EXPECT_EQ(client.scene(kPatience).at(0).session, session);
    EXPECT_EQ(client.apply({.body_name = "box"}, kPatience).code, ResultCode::ok);
    daemon->signal(SIGKILL);
    daemon->wait();
    remove_stale_segments();  // as a daemon does at its start
    daemon = std::make_unique<ChildProcess>(role("serve", "restart", 1000 * (restart + 1)));
    ASSERT_EQ(daemon->read_line(), "ready");
  }
}

TEST(Client, HearsImpactsInOrderFromItsFirstCallOn) {
  FakeDaemon daemon("impacts");
  Client client({.world = "impacts", .domain = test_domain()});
  client.wait_for_server(kPatience);
  EXPECT_EQ(daemon.events.readers(), 0);  // nobody has asked yet
  ImpactNotice impact;
  EXPECT_FALSE(client.next_impact(impact, 0ms));
  ASSERT_TRUE(eventually([&] { return daemon.events.readers() == 1; }));
  ImpactNotice sent = sample::impact();
  for (sent.frame = 1; sent.frame <= 500; ++sent.frame) ASSERT_TRUE(daemon.events.write(sent));
  for (sent.frame = 1; sent.frame <= 500; ++sent.frame) {
    ASSERT_TRUE(client.next_impact(impact, kPatience)) << sent.frame;
    expect_same(impact, sent);
  }
  EXPECT_FALSE(client.next_impact(impact, 0ms));
  EXPECT_EQ(impact.frame, 500u);
}

}  // namespace
}  // namespace poinsot
