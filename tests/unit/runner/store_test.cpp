#include "poinsot/runner/store.h"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "support/scene_builder.h"
#include "support/temp_path.h"

namespace poinsot {
namespace {

Checkpoint named(const std::string& name, std::uint64_t frame = 1) {
  return {.name = name,
          .epoch = 1,
          .frame = frame,
          .state_hash = frame,
          .scene = std::make_shared<const Scene>(test::empty_scene()),
          .state = {std::byte{1}}};
}

// `name` was written so many seconds ago.
void set_age(const Store& store, const std::string& name, int seconds) {
  std::filesystem::last_write_time(
      store.checkpoint_file(name),
      std::filesystem::file_time_type::clock::now() - std::chrono::seconds(seconds));
}

std::vector<std::string> names(const std::vector<StoredFile>& files) {
  std::vector<std::string> result;
  for (const StoredFile& file : files) result.push_back(file.name);
  return result;
}

using Names = std::vector<std::string>;

TEST(Store, KeepsCheckpointsByName) {
  const Store store(test::temp_path("named"), "arena");
  EXPECT_TRUE(store.checkpoints().empty());
  store.save(named("first", 10));
  store.save(named("second", 20));
  store.save(named("first", 30));
  EXPECT_EQ(store.load("first")->frame, 30u);
  EXPECT_EQ(store.load("second")->frame, 20u);
  EXPECT_TRUE(std::filesystem::exists(test::temp_path("named") / "arena" / "first.checkpoint"));
  EXPECT_EQ(store.checkpoints().size(), 2u);
}

TEST(Store, AMissingNameIsToldWithTheNearest) {
  const Store store(test::temp_path("missing"), "arena");
  store.save(named("lunch"));
  try {
    store.load("lunsh");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "no checkpoint 'lunsh', did you mean 'lunch'?");
  }
}

TEST(Store, NoNameLeadsOutOfTheDirectory) {
  const Store store(test::temp_path("names"), "arena");
  for (const std::string name :
       {"", ".", "..", "../x", "a/b", "/etc/passwd", ".hidden", "a b", "a\n", "ü", "a\\b", "a:b",
        "0123456789012345678901234567890123456789012345678901234567890123456789"}) {
    EXPECT_NE(store_name_fault(name), "") << name;
    EXPECT_THROW(store.checkpoint_file(name), Error) << name;
    EXPECT_THROW(store.log_file(name), Error) << name;
    EXPECT_THROW(store.load(name), Error) << name;
    EXPECT_THROW(store.save(named(name)), Error) << name;
  }
  EXPECT_NE(store_name_fault(std::string("a\0b", 3)), "");
  for (const char* name : {"a", "A-1_b.c", "-", "_", "a..b"}) EXPECT_EQ(store_name_fault(name), "");
  EXPECT_THROW(Store(test::temp_path("names"), "../x"), Error);
  EXPECT_THROW(Store(test::temp_path("names"), ""), Error);
}

TEST(Store, DoesNotFollowALinkInThePlaceOfACheckpoint) {
  const Store store(test::temp_path("links"), "arena");
  store.save(named("real"));
  std::filesystem::copy_file(store.checkpoint_file("real"), test::temp_path("outside"));
  std::filesystem::create_symlink(test::temp_path("outside"), store.checkpoint_file("link"));
  EXPECT_THROW(store.load("link"), Error);
  EXPECT_EQ(names(store.checkpoints()), Names({"real"}));
  store.save(named("link", 5));  // replaces the link, not what it names
  EXPECT_EQ(store.load("link")->frame, 5u);
  EXPECT_TRUE(std::filesystem::is_regular_file(
      std::filesystem::symlink_status(store.checkpoint_file("link"))));
}

TEST(Store, TheNewestIsTheOneWrittenLast) {
  const Store store(test::temp_path("newest"), "arena");
  std::vector<std::string> faults;
  EXPECT_EQ(store.load_newest(faults), nullptr);
  for (const char* name : {"b", "a", "c"}) store.save(named(name));
  set_age(store, "b", 30);
  set_age(store, "a", 10);
  set_age(store, "c", 20);
  EXPECT_EQ(names(store.checkpoints()), Names({"a", "c", "b"}));
  EXPECT_EQ(store.load_newest(faults)->name, "a");
  EXPECT_TRUE(faults.empty());
}

TEST(Store, ADamagedNewestIsToldAndPassedOver) {
  const Store store(test::temp_path("damaged"), "arena");
  store.save(named("good"));
  set_age(store, "good", 60);
  store.save(named("bad"));
  std::filesystem::resize_file(store.checkpoint_file("bad"), 50);
  std::vector<std::string> faults;
  EXPECT_EQ(store.load_newest(faults)->name, "good");
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults[0].find("bad.checkpoint: the checkpoint is damaged"), std::string::npos);
}

TEST(Store, ListsLogsApart) {
  const Store store(test::temp_path("lists"), "arena");
  store.save(named("a"));
  std::ofstream(store.log_file("b")) << "\n";
  EXPECT_EQ(names(store.checkpoints()), Names({"a"}));
  EXPECT_EQ(names(store.logs()), Names({"b"}));
}

TEST(Store, KeepsTheLastAutosavesAndAllOthers) {
  const Store store(test::temp_path("prune"), "arena");
  for (int k = 1; k <= 12; ++k) {
    const std::string name = "auto-" + std::to_string(k);
    store.save(named(name));
    set_age(store, name, 100 - k);
  }
  for (const char* name : {"auto-x", "auto-1b", "mine"}) {
    store.save(named(name));
    set_age(store, name, 500);
  }
  store.prune_autosaves(3);
  EXPECT_EQ(store.checkpoints().size(), 6u);
  for (const char* name : {"auto-12", "auto-11", "auto-10", "auto-x", "auto-1b", "mine"})
    EXPECT_EQ(store.load(name)->name, name);
}

TEST(Store, OfTheSameTimeTheLargerNumberIsNewer) {
  const Store store(test::temp_path("same_time"), "arena");
  const auto now = std::filesystem::file_time_type::clock::now();
  for (const char* name : {"auto-9", "auto-10", "auto-8"}) {
    store.save(named(name));
    std::filesystem::last_write_time(store.checkpoint_file(name), now);
  }
  EXPECT_EQ(names(store.checkpoints()), Names({"auto-10", "auto-9", "auto-8"}));
}

TEST(Store, WhatIsWrittenAfterTheClockWasSetBackIsTheNewest) {
  const Store store(test::temp_path("clock"), "arena");
  for (const int k : {7, 8, 9}) {
    const std::string name = "auto-" + std::to_string(k);
    store.save(named(name));
    set_age(store, name, -3600 - k);  // the clock was an hour ahead
  }
  for (const int k : {1, 2}) {  // of another epoch
    store.save(named("auto-" + std::to_string(k)));
    store.prune_autosaves(3);
  }
  EXPECT_EQ(names(store.checkpoints()), Names({"auto-2", "auto-1", "auto-9"}));
  std::vector<std::string> faults;
  EXPECT_EQ(store.load_newest(faults)->name, "auto-2");
}

TEST(Store, TheEnvironmentSaysWhere) {
  const auto set = [](const char* name, const char* value) {
    if (value == nullptr)
      ::unsetenv(name);
    else
      ::setenv(name, value, 1);
  };
  const char* const old_home = std::getenv("HOME");
  const std::string home = old_home == nullptr ? "" : old_home;
  set("POINSOT_DATA_DIR", "/a");
  set("XDG_STATE_HOME", "/b");
  set("HOME", "/c");
  EXPECT_EQ(Store::default_directory(), "/a");
  set("POINSOT_DATA_DIR", nullptr);
  EXPECT_EQ(Store::default_directory(), "/b/poinsot");
  set("XDG_STATE_HOME", "relative");
  EXPECT_EQ(Store::default_directory(), "/c/.local/state/poinsot");
  set("HOME", nullptr);
  EXPECT_THROW(Store::default_directory(), Error);
  set("XDG_STATE_HOME", nullptr);
  set("HOME", home.c_str());
}

}  // namespace
}  // namespace poinsot
