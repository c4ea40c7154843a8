#include "include_rules.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

namespace fs = std::filesystem;

bool allowed(std::string_view path, std::string_view text) {
  return violations(path, text).empty();
}

struct Walk {
  int files = 0;
  std::vector<std::string> found;
};

Walk walk_the_tree() {
  const fs::path source = POINSOT_SOURCE_DIR;
  Walk walk;
  for (const char* root : {"common", "server", "client"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(source / root)) {
      const fs::path extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ostringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      const std::string path = fs::relative(entry.path(), source).generic_string();
      for (std::string& line : violations(path, text.str())) walk.found.push_back(std::move(line));
      ++walk.files;
    }
  }
  return walk;
}

TEST(IncludeDirection, FollowsTheTable) {
  const Walk walk = walk_the_tree();
  EXPECT_GT(walk.files, 40) << "the tree was not found";
  for (const std::string& line : walk.found) ADD_FAILURE() << line;
}

TEST(IncludeDirection, FindsAPlantedArrowUpwards) {
  const std::vector<std::string> found = violations("common/poinsot/math/pose.h",
                                                    "// a pose\n\n#pragma once\n"
                                                    "#include \"poinsot/math/types.h\"\n"
                                                    "#include \"poinsot/scene/scene.h\"\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found.front(), "common/poinsot/math/pose.h:5: math must not include scene");
}

TEST(IncludeDirection, FindsTheArrowsThatTheLayersForbid) {
  const auto includes = [](std::string_view module) {
    return "#include \"poinsot/" + std::string(module) + "/x.h\"\n";
  };
  EXPECT_FALSE(allowed("server/poinsot/simulation/world.h", includes("collision")));
  EXPECT_FALSE(allowed("server/poinsot/simulation/world.h", includes("protocol")));
  EXPECT_FALSE(allowed("server/poinsot/contact/contact.h", includes("collision")));
  EXPECT_FALSE(allowed("server/poinsot/collision/island.h", includes("presentation")));
  EXPECT_FALSE(allowed("server/poinsot/presentation/x.cpp", includes("wire")));
  EXPECT_FALSE(allowed("server/poinsot/runner/x.cpp", includes("wire")));
  EXPECT_FALSE(allowed("client/poinsot/client/client.cpp", includes("simulation")));
  EXPECT_FALSE(allowed("client/poinsot/client/client.cpp", includes("program")));
  EXPECT_FALSE(allowed("common/poinsot/wire/topics.h", includes("simulation")));
  EXPECT_TRUE(allowed("server/poinsot/collision/island.h", includes("simulation")));
  EXPECT_TRUE(allowed("client/poinsot/cli/push.cpp", includes("program")));
}

TEST(IncludeDirection, KeepsForeignLibrariesBehindTheirWalls) {
  EXPECT_TRUE(allowed("server/poinsot/collision/proximity_fcl.cpp", "#include <fcl/fcl.h>\n"));
  EXPECT_FALSE(allowed("server/poinsot/collision/proximity.h", "#include <fcl/fcl.h>\n"));
  EXPECT_FALSE(allowed("server/poinsot/contact/contact.h", "#include <ccd/vec3.h>\n"));
  EXPECT_TRUE(allowed("common/poinsot/scene/scene_file.cpp", "#include <yaml-cpp/yaml.h>\n"));
  EXPECT_FALSE(allowed("common/poinsot/scene/validate.cpp", "#include <yaml-cpp/yaml.h>\n"));
  EXPECT_TRUE(
      allowed("common/poinsot/scene/convex_hull.cpp", "#include <libqhull_r/qhull_ra.h>\n"));
  EXPECT_FALSE(allowed("common/poinsot/scene/shape.cpp", "#include <libqhull_r/qhull_ra.h>\n"));
  EXPECT_TRUE(allowed("common/poinsot/wire/qos.h", "#include <fastdds/dds/core/x.hpp>\n"));
  EXPECT_FALSE(allowed("server/poinsot/service/daemon.cpp", "#include <fastdds/dds/core/x.hpp>\n"));
  EXPECT_FALSE(allowed("server/poinsot/service/daemon.cpp", "#include \"poinsot/msg/poses.h\"\n"));
  EXPECT_FALSE(allowed("server/poinsot/simulation/world.cpp", "#include <spdlog/logger.h>\n"));
  EXPECT_FALSE(allowed("server/poinsot/simulation/world.cpp", "#include <boost/any.hpp>\n"));
  EXPECT_TRUE(allowed("server/poinsot/simulation/world.cpp", "#include <Eigen/Core>\n"));
}

TEST(IncludeDirection, KeepsClocksAndThreadsOutOfPhysics) {
  EXPECT_FALSE(allowed("server/poinsot/simulation/world.cpp", "#include <chrono>\n"));
  EXPECT_FALSE(allowed("server/poinsot/collision/island.cpp", "  #  include <thread>\n"));
  EXPECT_TRUE(allowed("server/poinsot/service/frame_loop.cpp", "#include <chrono>\n"));
}

TEST(IncludeDirection, KeepsSceneFilesOffTheBus) {
  EXPECT_TRUE(
      allowed("common/poinsot/protocol/body_info.h", "#include \"poinsot/scene/scene.h\"\n"));
  EXPECT_FALSE(
      allowed("common/poinsot/wire/convert.h", "#include \"poinsot/scene/scene_file.h\"\n"));
}

TEST(IncludeDirection, RefusesAFolderThatTheTableDoesNotKnow) {
  EXPECT_FALSE(allowed("server/poinsot/joints/joint.h", ""));
  EXPECT_FALSE(allowed("common/poinsot/stray.h", ""));
}

TEST(IncludeDirection, RefusesIncludesThatAreNotAsInstalled) {
  EXPECT_FALSE(allowed("common/poinsot/math/pose.h", "#include \"../base/check.h\"\n"));
}

// A table with a cycle would allow what it is there to forbid.
TEST(IncludeTable, HasNoCycle) {
  std::string known = "msg ";
  for (const ModuleRule& rule : module_rules()) {
    std::istringstream modules{std::string(rule.may_include)};
    for (std::string module; modules >> module;)
      EXPECT_NE((" " + known).find(" " + module + " "), std::string::npos)
          << rule.module << " includes " << module << ", which stands below it";
    known += std::string(rule.module) + " ";
  }
}

}  // namespace
}  // namespace poinsot
