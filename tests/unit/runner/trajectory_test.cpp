#include "poinsot/runner/trajectory.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "support/scene_builder.h"
#include "support/temp_path.h"

namespace poinsot {
namespace {

std::filesystem::path temporary_file(const std::string& name) {
  return test::temp_path(name);
}

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

World two_bodies() {
  Scene scene = test::empty_scene();
  scene.bodies = {test::floor("the \"table\", old"), test::box("box", Vec3(0.1, -2, 1.0 / 3))};
  scene.bodies[1].mass_properties.center_of_mass = Vec3(0.25, 0, 0);
  scene.bodies[1].linear_velocity = Vec3(1, 0, 0);
  scene.bodies[1].angular_velocity = Vec3(0, 0, 2);
  return World(scene);
}

TEST(CsvField, QuotesOnlyWhatNeedsIt) {
  EXPECT_EQ(csv_field("box_1"), "box_1");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("say \"x\""), "\"say \"\"x\"\"\"");
  EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csv_field(""), "");
}

TEST(Trajectory, WritesOneRowPerFrameAndBodyInFileOrder) {
  const auto file = temporary_file("trajectory_rows.csv");
  const World world = two_bodies();
  Trajectory trajectory(file, world, 60);
  trajectory.write(world, 0);
  trajectory.write(world, 1);
  trajectory.close();
  const auto lines = lines_of(file);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0], "frame,time,body,px,py,pz,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz");
  EXPECT_EQ(lines[1], "0,0,\"the \"\"table\"\", old\",0,0,-0.5,0,0,0,1,0,0,0,0,0,0");
  EXPECT_EQ(lines[2].substr(0, 8), "0,0,box,");
  EXPECT_EQ(lines[3].substr(0, 21), "1,0.01666666666666666");
  EXPECT_EQ(lines[4].substr(0, 2), "1,");
}

TEST(Trajectory, NumbersReadBackToTheSameBits) {
  const auto file = temporary_file("trajectory_bits.csv");
  const World world = two_bodies();
  Trajectory trajectory(file, world, 60);
  trajectory.write(world, 7);
  trajectory.close();
  std::istringstream row(lines_of(file).at(2));
  std::vector<std::string> fields;
  for (std::string field; std::getline(row, field, ',');) fields.push_back(field);
  ASSERT_EQ(fields.size(), 16u);
  EXPECT_EQ(std::stod(fields[1]), 7 / 60.0);
  const Pose pose = body_pose(world, 1);
  for (int k = 0; k < 3; ++k) {
    const auto at = static_cast<std::size_t>(k);
    EXPECT_EQ(std::stod(fields[3 + at]), pose.c(k));
    EXPECT_EQ(std::stod(fields[10 + at]), linear_velocity(world, 1)(k));
    EXPECT_EQ(std::stod(fields[13 + at]), angular_velocity(world, 1)(k));
  }
}

TEST(Trajectory, FormatsAsPrintfDoes) {
  const auto file = temporary_file("trajectory_printf.csv");
  World world = two_bodies();
  position(world.y, 1) = Vec3(1e-300, 123456789.123456789, -1e22);
  Trajectory trajectory(file, world, 60);
  trajectory.write(world, 0);
  trajectory.close();
  const Vec3 p = body_pose(world, 1).c;
  char expected[128];
  std::snprintf(expected, sizeof expected, "0,0,box,%.17g,%.17g,%.17g,", p.x(), p.y(), p.z());
  EXPECT_EQ(lines_of(file).at(2).rfind(expected, 0), 0u) << lines_of(file).at(2);
}

TEST(Trajectory, SaysWhichFileCannotBeCreated) {
  try {
    Trajectory("/nonexistent/run.csv", two_bodies(), 60);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("/nonexistent/run.csv"), std::string::npos);
  }
}

TEST(Trajectory, TellsAFullDiskOnClose) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP();
  const World world = two_bodies();
  Trajectory trajectory("/dev/full", world, 60);
  for (std::uint64_t n = 0; n < 1000; ++n) trajectory.write(world, n);
  EXPECT_THROW(trajectory.close(), std::runtime_error);
}

}  // namespace
}  // namespace poinsot
