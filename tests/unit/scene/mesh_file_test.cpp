#include "poinsot/scene/mesh_file.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "poinsot/scene/scene_file.h"

namespace poinsot {
namespace {

using Loop = std::array<int, 3>;

template <class Read>
std::string refusal(Read read) {
  try {
    read();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}
std::string obj_refusal(const std::string& text) {
  return refusal([&] { read_obj(text, "a.obj"); });
}
std::string stl_refusal(const std::string& text) {
  return refusal([&] { read_stl(text, "a.stl"); });
}

// OBJ ---------------------------------------------------------------------------------------------

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ObjFile, ReadsVerticesAndFaces) {
  const Mesh mesh = read_obj(
      "# a square\r\nmtllib x.mtl\r\no square\r\nv 0 0 0\r\nv 1.5e0 0 0\r\nv +1.5 1 0\r\n"
      "v 0 1 -0.125 # low\r\nvt 0 0\r\nvn 0 0 1\r\nusemtl m\r\ns off\r\nf 1 2 3\r\n\tf 1 3  4\r\n",
      "a.obj");
  EXPECT_EQ(mesh.vertices,
            (std::vector<Vec3>{{0, 0, 0}, {1.5, 0, 0}, {1.5, 1, 0}, {0, 1, -0.125}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Loop>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(ObjFile, TakesEveryFormOfACorner) {
  const Mesh mesh = read_obj(kSquare + "f 1/7 2/8/9 3//4\nf -4 -2 -1\n", "a.obj");
  EXPECT_EQ(mesh.triangles, (std::vector<Loop>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(ObjFile, CutsConvexFacesIntoFans) {
  EXPECT_EQ(read_obj(kSquare + "f 1 2 3 4", "a.obj").triangles,
            (std::vector<Loop>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(obj_refusal("v 0 0 0\nv 2 0 0\nv 1.9 1.9 0\nv 0 2 0\nv 1.5 1.5 0\nf 1 2 3 5 4\n"),
            "no error");
  EXPECT_EQ(obj_refusal("v 2 0 0\nv 0.1 0.1 0\nv 0 2 0\nv 0 0 0\nf 4 1 2 3\nf 1 2 3 4\n"),
            "a.obj:6: a face of more than three corners must be convex");
}

TEST(ObjFile, RefusesAtItsLine) {
  EXPECT_EQ(obj_refusal(""), "a.obj: a mesh needs a triangle that has an area");
  EXPECT_EQ(obj_refusal("v 0 0"), "a.obj:1: a coordinate must be a finite decimal number, is ''");
  EXPECT_EQ(obj_refusal("\n\nv 0 nan 0"),
            "a.obj:3: a coordinate must be a finite decimal number, is 'nan'");
  EXPECT_EQ(obj_refusal("v 0 1e999 0"),
            "a.obj:1: a coordinate must be a finite decimal number, is '1e999'");
  EXPECT_EQ(obj_refusal("v 0 1x 0"),
            "a.obj:1: a coordinate must be a finite decimal number, is '1x'");
  EXPECT_EQ(obj_refusal(kSquare + "f 1 2"), "a.obj:5: a face needs three corners");
  EXPECT_EQ(obj_refusal(kSquare + "f 1 2 5"), "a.obj:5: a face names vertex 5 of 4");
  EXPECT_EQ(obj_refusal(kSquare + "f 1 2 0"), "a.obj:5: a face names vertex 0 of 4");
  EXPECT_EQ(obj_refusal(kSquare + "f 1 2 -5"), "a.obj:5: a face names vertex -5 of 4");
  EXPECT_EQ(obj_refusal(kSquare + "f 1 2 99999999999999999999"),
            "a.obj:5: a corner of a face must be the number of a vertex, is "
            "'99999999999999999999'");
  EXPECT_EQ(obj_refusal(kSquare + "f 1 2 c"),
            "a.obj:5: a corner of a face must be the number of a vertex, is 'c'");
  EXPECT_EQ(obj_refusal("solid x"), "a.obj:1: unknown word 'solid' in an OBJ file");
  EXPECT_EQ(obj_refusal("v 2e9 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3"),
            "a.obj: vertex 1 of a mesh must be finite and at most 1e+09 m");
}

// STL ---------------------------------------------------------------------------------------------

std::string binary_stl(const std::vector<float>& numbers, std::uint32_t count) {
  std::string bytes(80, 's');
  const auto append = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append(count);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i % 9 == 0) bytes.append(12, '\xff');  // a normal of NaN: nobody looks
    append(numbers[i]);
    if (i % 9 == 8) bytes.append(2, '\0');
  }
  return bytes;
}

TEST(StlFile, ReadsBothFormsAlike) {
  const std::string ascii =
      "solid two triangles\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
      "vertex 1 1 0.5\nendloop\nendfacet\n  facet normal 0 0 1\n outer loop\n vertex 0 0 0\n"
      " vertex 1 1 0.5\n vertex 0 1 0\n endloop\n endfacet\nendsolid\n";
  const std::string binary =
      binary_stl({0, 0, 0, 1, 0, 0, 1, 1, 0.5F, 0, 0, 0, 1, 1, 0.5F, 0, 1, 0}, 2);
  for (const std::string& bytes : {ascii, binary}) {
    const Mesh mesh = read_stl(bytes, "a.stl");
    EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}}));
    EXPECT_EQ(mesh.triangles, (std::vector<Loop>{{0, 1, 2}, {0, 2, 3}}));
  }
}

TEST(StlFile, RefusesWhatIsNeither) {
  const std::string neither =
      "a.stl: neither an ASCII STL file, which begins with 'solid', nor a binary one, whose length "
      "follows from its number of triangles";
  EXPECT_EQ(stl_refusal(""), neither);
  EXPECT_EQ(stl_refusal(binary_stl({0, 0, 0, 1, 0, 0, 0, 1, 0}, 2)), neither);
  EXPECT_EQ(stl_refusal(binary_stl({0, 0, 0, 1, 0, 0, 0, 1, 0}, 0xffffffff)), neither);
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(stl_refusal(binary_stl({0, 0, 0, 1, inf, 0, 0, 1, 0}, 1)),
            "a.stl: vertex 2 of a mesh must be finite and at most 1e+09 m");
  EXPECT_EQ(stl_refusal("solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\n"),
            "a.stl:5: a facet has three vertices, this one 2");
  EXPECT_EQ(stl_refusal("solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n"),
            "a.stl:5: the last facet has no end");
  EXPECT_EQ(stl_refusal("solid\nfacet\nvertx 0 0 0\n"),
            "a.stl:3: unknown word 'vertx' in an STL file");
}

// In a scene --------------------------------------------------------------------------------------

class MeshOfAScene : public testing::Test {
 protected:
  MeshOfAScene() { std::filesystem::create_directories(folder_); }
  ~MeshOfAScene() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::string scene(const std::string& body) {
    write("s.yaml", "bodies:\n  - {name: a, " + body + "}\n");
    scene_ = {};
    return refusal([&] { scene_ = read_scene_file(folder_ / "s.yaml"); });
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      ("poinsot_mesh_" +
       std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
  Scene scene_;
};

TEST_F(MeshOfAScene, IsFoundBesideTheSceneFile) {
  write("square.OBJ", kSquare + "f 1 2 3\nf 1 3 4\n");
  ASSERT_EQ(scene("static: true, shape: {mesh: {file: square.OBJ}, position: [0, 0, 1]}"),
            "no error");
  const auto& mesh = std::get<Mesh>(scene_.bodies.at(0).shapes.at(0).shape);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(scene_.bodies[0].shapes[0].pose.c, Vec3(0, 0, 1));
  ASSERT_EQ(scene("kinematic: true, shape: {mesh: {file: square.OBJ}}"), "no error");
}

TEST_F(MeshOfAScene, FaultsHaveTheirPlace) {
  write("square.obj", kSquare + "f 1 2 3\n");
  write("broken.obj", kSquare + "f 1 2 9\n");
  const std::string file = (folder_ / "s.yaml").string();
  EXPECT_EQ(scene("density: 1, shape: {mesh: {file: square.obj}}"),
            file + ":2:41: only a static or kinematic body may have a mesh");
  EXPECT_EQ(
      scene("static: true, shape: {mesh: {file: broken.obj}}"),
      file + ":2:50: " + (folder_ / "broken.obj").string() + ":5: a face names vertex 9 of 4");
  EXPECT_EQ(scene("static: true, shape: {mesh: {file: none.obj}}"),
            file + ":2:50: " + (folder_ / "none.obj").string() +
                ": cannot be read: No such file or directory");
  EXPECT_EQ(scene("static: true, shape: {mesh: {file: s.yaml}}"),
            file + ":2:50: " + file + ": a mesh file must end in .obj or .stl");
  EXPECT_EQ(scene("static: true, shape: {mesh: {flie: a.obj}}"),
            file + ":2:44: unknown key 'flie', did you mean 'file'?");
  EXPECT_EQ(scene("static: true, shape: {mesh: {}}"), file + ":2:43: mesh needs the key 'file'");
  std::filesystem::create_directory(folder_ / "folder.obj");
  EXPECT_EQ(scene("static: true, shape: {mesh: {file: folder.obj}}"),
            file + ":2:50: " + (folder_ / "folder.obj").string() +
                ": cannot be read: it is no regular file");
}

// A scene cannot make a reader read without end by naming a file again and again.
TEST_F(MeshOfAScene, AliasesOfABigFileAreBounded) {
  std::string text;
  for (int i = 0; i < 60000; ++i)
    text += "v " + std::to_string(i % 245) + " " + std::to_string(i / 245) + " 0\n";
  for (int i = 0; i + 246 < 60000; ++i)
    text += "f " + std::to_string(i + 1) + " " + std::to_string(i + 2) + " " +
            std::to_string(i + 246) + "\n";
  write("big.obj", text);
  std::string shapes;
  for (int i = 0; i < 64; ++i) shapes += "{mesh: {file: big.obj}}, ";
  const std::string what = scene("static: true, shapes: [" + shapes + "]");
  EXPECT_NE(what.find("a scene must not hold more than 10000000 values"), std::string::npos)
      << what.substr(0, 200);
}

}  // namespace
}  // namespace poinsot
