#include "poinsot/runner/load_scene.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "support/temp_path.h"

namespace poinsot {
namespace {

namespace fs = std::filesystem;

class LoadSceneTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(directory_);
    fs::create_directories(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }

  fs::path write(const std::string& name, const std::string& text) {
    std::ofstream(directory_ / name) << text;
    return directory_ / name;
  }

  template <class Call>
  static std::string error_of(Call call) {
    try {
      call();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  const fs::path directory_ = test::temp_path("load_scene");
  const std::vector<fs::path> directories_ = {"/nonexistent", directory_};
};

constexpr const char* kOverlapping =
    "bodies:\n"
    "  - {name: lower, shape: {box: [1, 1, 1]}, density: 100, position: [0, 0, 0]}\n"
    "  - {name: upper, shape: {box: [1, 1, 1]}, density: 100, position: [0, 0, 0.9]}\n";

TEST_F(LoadSceneTest, FindsAPathAndAShippedName) {
  const fs::path file = write("tower.yaml", "bodies: []\n");
  EXPECT_EQ(find_scene(file.string(), {}), file);
  EXPECT_EQ(find_scene("tower", directories_), file);
}

TEST_F(LoadSceneTest, AnUnknownNameListsTheShippedScenesAndTheNearest) {
  write("tower.yaml", "");
  write("incline.yaml", "");
  write("notes.txt", "");
  const std::string error = error_of([&] { find_scene("towre", directories_); });
  EXPECT_NE(error.find("did you mean 'tower'?"), std::string::npos) << error;
  EXPECT_NE(error.find("(shipped: incline, tower)"), std::string::npos) << error;
}

TEST_F(LoadSceneTest, OverlappingBodiesAreAnErrorWithPlaceAndNames) {
  const fs::path file = write("overlap.yaml", kOverlapping);
  const std::string error = error_of([&] { load_scene(file); });
  EXPECT_NE(error.find("overlap.yaml:"), std::string::npos) << error;
  EXPECT_NE(error.find("lower"), std::string::npos) << error;
  EXPECT_NE(error.find("upper"), std::string::npos) << error;
  EXPECT_NE(error.find("0.1"), std::string::npos) << error;  // [m] depth
}

TEST_F(LoadSceneTest, OverlapIsFineWhereTheSceneAllowsIt) {
  const fs::path file = write("overlap.yaml", "allow_overlap: true\n" + std::string(kOverlapping));
  EXPECT_EQ(load_scene(file).bodies.size(), 2u);
}

}  // namespace
}  // namespace poinsot
