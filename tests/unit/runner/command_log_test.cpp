#include "poinsot/runner/command_log.h"

#include <chrono>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
#include <sstream>
#include <string>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "poinsot/runner/log_reader.h"
#include "support/allocation_counter.h"
#include "support/scene_builder.h"
#include "support/temp_path.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;
using State = CommandLogWriter::State;

std::shared_ptr<const Checkpoint> some_checkpoint(std::uint64_t frame) {
  auto checkpoint = std::make_shared<Checkpoint>();
  checkpoint->name = "c";
  checkpoint->epoch = 2;
  checkpoint->frame = frame;
  checkpoint->state_hash = 0xabc;
  checkpoint->scene = std::make_shared<const Scene>(test::empty_scene());
  checkpoint->state = {std::byte{7}};
  return checkpoint;
}

LogStart start(const std::filesystem::path& file, bool replace = false) {
  return {.file = file, .world = "arena", .checkpoint = some_checkpoint(100), .replace = replace};
}

TurnRecord push(std::uint64_t before) {
  TurnRecord turn{.before = before, .epoch = 2, .wrenches = {}, .orders = {}};
  turn.wrenches = {{.client = 1, .seq = before, .body_name = "box", .force = {0.1, 0, 0}}};
  return turn;
}

Order order(ControlAction action, std::string text = {}) {
  Order result;
  result.control.client = 3;
  result.control.seq = 9;
  result.control.action = action;
  result.control.text = std::move(text);
  return result;
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

// A log of three frames, with a push, a spawn and two restores of one checkpoint.
std::filesystem::path sample_log(const std::string& name) {
  const auto file = test::temp_path(name);
  CommandLogWriter log(start(file));
  log.turn(push(101));
  log.frame(101, 0x1111);
  TurnRecord turn{.before = 102, .epoch = 2, .wrenches = {}, .orders = {}};
  turn.orders = {
      order(ControlAction::spawn, "bodies: [{name: ball, density: 1, shape: {sphere: 1}}]"),
      order(ControlAction::restore), order(ControlAction::restore)};
  turn.orders[1].checkpoint = turn.orders[2].checkpoint = some_checkpoint(50);
  log.turn(std::move(turn));
  log.frame(51, 0x2222);
  log.frame(52, 0x3333);
  EXPECT_TRUE(log.close()) << log.failure();
  return file;
}

TEST(CommandLog, ReadsWhatWasWritten) {
  CommandLogReader log(sample_log("whole.log"));
  EXPECT_EQ(log.header().world, "arena");
  EXPECT_EQ(log.header().frame, 100u);
  EXPECT_EQ(log.header().epoch, 2u);
  EXPECT_EQ(log.header().hash, 0xabcu);
  EXPECT_EQ(log.start()->state, some_checkpoint(100)->state);

  const auto first = std::get<TurnRecord>(*log.next());
  EXPECT_EQ(first.before, 101u);
  EXPECT_EQ(first.epoch, 2u);
  ASSERT_EQ(first.wrenches.size(), 1u);
  EXPECT_EQ(first.wrenches[0].force, Vec3(0.1, 0, 0));
  EXPECT_EQ(first.wrenches[0].body_name, "box");
  EXPECT_EQ(std::get<FrameRecord>(*log.next()).hash, 0x1111u);

  const auto second = std::get<TurnRecord>(*log.next());
  ASSERT_EQ(second.orders.size(), 3u);
  EXPECT_EQ(second.orders[0].control.client, 3u);
  ASSERT_NE(second.orders[0].fragment, nullptr);
  EXPECT_EQ(second.orders[0].fragment->at(0).name, "ball");
  ASSERT_NE(second.orders[1].checkpoint, nullptr);
  EXPECT_EQ(second.orders[1].checkpoint->frame, 50u);
  EXPECT_EQ(second.orders[1].checkpoint, second.orders[2].checkpoint);  // written once
  EXPECT_EQ(std::get<FrameRecord>(*log.next()).frame, 51u);
  EXPECT_EQ(std::get<FrameRecord>(*log.next()).frame, 52u);
  EXPECT_FALSE(log.next());
  EXPECT_FALSE(log.is_cut());
}

TEST(CommandLog, CutAnywhereItIsReadToTheLastWholeLine) {
  const std::string text = text_of(sample_log("to_cut.log"));
  const std::size_t first_line = text.find('\n') + 1;
  const auto file = test::temp_path("cut.log");
  for (std::size_t size = 0; size < text.size(); ++size) {
    std::ofstream(file, std::ios::binary) << text.substr(0, size);
    if (size < first_line) {
      ASSERT_THROW(CommandLogReader log(file), Error) << size;
      continue;
    }
    CommandLogReader log(file);
    long entries = 0;
    while (log.next()) ++entries;
    const long lines = std::count(text.begin(), text.begin() + static_cast<long>(size), '\n') - 1;
    // The third line behind the first is a checkpoint, which is no entry.
    ASSERT_EQ(entries, lines >= 3 ? lines - 1 : lines) << size;
    ASSERT_TRUE(log.is_cut()) << size;
  }
}

TEST(CommandLog, AWrongLineIsNamed) {
  const std::string text = text_of(sample_log("to_spoil.log"));
  const std::string head = text.substr(0, text.find('\n') + 1);
  const auto file = test::temp_path("spoilt.log");
  const auto fault_of = [&](const std::string& bytes) -> std::string {
    std::ofstream(file, std::ios::binary) << bytes;
    try {
      CommandLogReader log(file);
      log.start();
      while (log.next()) {
      }
    } catch (const Error& error) {
      return error.what();
    }
    return "no fault";
  };
  const std::string at = file.string() + ":2: ";
  EXPECT_EQ(fault_of(head + "7\n"), at + "a line must be an object");
  EXPECT_EQ(fault_of(head + "{}\n"), at + "a line must have one of before, frame, checkpoint, end");
  EXPECT_EQ(fault_of(head + R"({"frame": 1, "hash": "12"})" + "\n"),
            at + "a hash must be 16 hexadecimal digits");
  EXPECT_EQ(fault_of(head + R"({"before": 1, "epoch": 1, "wrenches": [{"forse": 1}]})" + "\n"),
            at + "a command has a key that is not known");
  EXPECT_EQ(fault_of(head + R"({"before": 1, "epoch": 1, "orders": [{"checkpoint": 1}]})" + "\n"),
            at + "a restore names a checkpoint that is not there");
  EXPECT_EQ(fault_of(head + R"({"checkpoint": 1, "bytes": "AAAA"})" + "\n"),
            at + "checkpoint: is no checkpoint");
  for (const char* line :
       {"{", "{\"frame\": 1}", "{\"frame\": -1, \"hash\": \"0000000000000000\"}", "{\"before\": 1}",
        "\xff\xfe", "{\"before\": 1, \"epoch\": 1, \"orders\": 7}"})
    EXPECT_EQ(fault_of(head + line + "\n").rfind(at, 0), 0u) << line;
  EXPECT_EQ(fault_of("{\"poinsot_log\": 2}\n"),
            file.string() + ":1: is a log of format 2, known is 1");
  EXPECT_EQ(fault_of("{\"a\": 2}\n"), file.string() + ":1: is no command log");
}

// Bits that flip in a log change a value or make a line wrong; nothing worse.
TEST(CommandLog, FlippedBitsDoNoHarm) {
  std::string text = text_of(sample_log("to_flip.log"));
  const auto file = test::temp_path("flipped.log");
  int refused = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char flip = static_cast<char>(1 << k % 8);
    text[k] = static_cast<char>(text[k] ^ flip);
    std::ofstream(file, std::ios::binary) << text;
    try {
      CommandLogReader log(file);
      log.start();
      while (log.next()) {
      }
    } catch (const Error&) {
      ++refused;
    }
    text[k] = static_cast<char>(text[k] ^ flip);
  }
  EXPECT_GT(refused, 0);
}

TEST(CommandLog, AFileThatIsThereIsRefusedUnlessItMayBeReplaced) {
  const auto file = sample_log("there.log");
  const std::string before = text_of(file);
  CommandLogWriter log(start(file));
  EXPECT_FALSE(log.wait_until_open());
  EXPECT_EQ(log.state(), State::failed);
  EXPECT_EQ(log.failure(), "cannot write '" + file.string() + "': File exists");
  EXPECT_EQ(text_of(file), before);
  EXPECT_TRUE(CommandLogWriter(start(file, true)).close());
  EXPECT_NE(text_of(file), before);
}

TEST(CommandLog, MakesItsDirectory) {
  const auto file = test::temp_path("new/directory/a.log");
  EXPECT_TRUE(CommandLogWriter(start(file)).close());
  EXPECT_FALSE(CommandLogReader(file).next());
}

TEST(CommandLog, AFullDiskEndsTheLogWithAReason) {
  CommandLogWriter log(start("/dev/full", true));
  EXPECT_FALSE(log.wait_until_open());
  EXPECT_EQ(log.failure(), "cannot write '/dev/full': No space left on device");
  log.turn(push(101));  // are nothing now
  log.frame(101, 1);
  EXPECT_FALSE(log.wait_for_room());
  EXPECT_FALSE(log.close());
}

TEST(CommandLog, ADiskThatHangsEndsTheLogWithoutHoldingTheLoop) {
  const auto pipe = test::temp_path("pipe.log");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  CommandLogWriter log(start(pipe, true));  // its thread waits for somebody to read
  const auto begun = std::chrono::steady_clock::now();
  for (std::size_t n = 0; n < CommandLogWriter::kEntries; ++n) log.frame(n, n);
  EXPECT_EQ(log.state(), State::opening);
  log.frame(0, 0);
  EXPECT_EQ(log.state(), State::failed);
  EXPECT_EQ(log.failure(), pipe.string() + ": the disk is too slow for this run");
  EXPECT_FALSE(log.wait_until_open());
  EXPECT_LT(std::chrono::steady_clock::now() - begun, 10s);

  std::thread reader([&] {
    const int descriptor = ::open(pipe.c_str(), O_RDONLY);
    char part[4096];
    while (::read(descriptor, part, sizeof part) > 0) {
    }
    ::close(descriptor);
  });
  EXPECT_FALSE(log.close());
  reader.join();
}

TEST(CommandLog, LargeTurnsAreBoundedAsWell) {
  const auto pipe = test::temp_path("pipe_of_turns.log");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  CommandLogWriter log(start(pipe, true));
  const std::string text(kMaxFragment, '#');
  for (std::size_t n = 0; n < CommandLogWriter::kTurnBytes / kMaxFragment + 1; ++n) {
    TurnRecord turn = push(n);
    turn.orders = {order(ControlAction::spawn, text)};
    log.turn(std::move(turn));
  }
  EXPECT_EQ(log.state(), State::failed);
  const int descriptor = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  std::thread reader([&] {
    char part[65536];
    while (log.state() == State::failed && ::poll(nullptr, 0, 1) == 0)
      if (::read(descriptor, part, sizeof part) == 0) break;
  });
  EXPECT_FALSE(log.close());
  reader.join();
  ::close(descriptor);
}

TEST(CommandLog, FramesAndTurnsCostTheLoopNoAllocation) {
  if (!test::can_count_allocations()) GTEST_SKIP() << "a sanitizer's malloc";
  CommandLogWriter log(start(test::temp_path("cheap.log")));
  ASSERT_TRUE(log.wait_until_open());
  std::vector<TurnRecord> turns;
  for (std::uint64_t n = 0; n < 1000; ++n) turns.push_back(push(n));
  const std::size_t before = test::allocations();
  for (std::uint64_t n = 0; n < 1000; ++n) {
    log.turn(std::move(turns[n]));
    for (int k = 0; k < 10; ++k) log.frame(n, n);
  }
  EXPECT_EQ(test::allocations(), before);
  EXPECT_TRUE(log.close());
}

TEST(CommandLog, ManyFramesAllArrive) {
  const auto file = test::temp_path("many.log");
  constexpr std::uint64_t kMany = 5 * CommandLogWriter::kEntries;
  {
    CommandLogWriter log(start(file));
    for (std::uint64_t n = 1; n <= kMany; ++n) {
      log.frame(n, n * n);
      ASSERT_TRUE(log.wait_for_room());
    }
  }
  CommandLogReader log(file);
  std::uint64_t n = 0;
  while (const auto entry = log.next()) {
    ++n;
    ASSERT_EQ(std::get<FrameRecord>(*entry).frame, n);
    ASSERT_EQ(std::get<FrameRecord>(*entry).hash, n * n);
  }
  EXPECT_EQ(n, kMany);
}

}  // namespace
}  // namespace poinsot
