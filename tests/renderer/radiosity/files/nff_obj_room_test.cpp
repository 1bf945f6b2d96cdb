// Tests rooms from NFF and OBJ files: emission, mirrors, normals, and errors.

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/renderer/radiosity/rooms.hpp"

namespace radiosity::test {
namespace {

const std::string CAMERA = "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\n";
const std::string SQUARE = "p 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

Room read_nff(const std::string& text) { return read_room(text, "test.nff"); }

TEST(NffRoom, EmissionLastsUntilTheNextSurface) {
  const Room room =
      read_nff("# emitted by a program\n" + CAMERA +
               "b 1 1 1\nl 1 2 3\nf 1 0.5 0.25 0.6 0.3 20 0 0\n" + SQUARE + "# emit 1 2 3\n" +
               SQUARE + SQUARE + "  #emit 4 4 4\n" + SQUARE + "f 1 1 1 0.5 0 0 0 0\n" + SQUARE +
               "f 0.1 0.1 0.1 0 1 0 0 0\npp 3 0 0 0 0 0 2 1 0 0 1 0 2 0 1 0 0 1 1\n");
  ASSERT_EQ(room.faces.size(), 6u);
  const auto material = [&](std::size_t face) { return room.materials[room.faces[face].material]; };
  EXPECT_EQ(material(0).reflectance, (Rgb{0.6, 0.3, 0.15}));
  EXPECT_EQ(material(0).emission, Rgb{});
  EXPECT_EQ(material(1).reflectance, (Rgb{0.6, 0.3, 0.15}));
  EXPECT_EQ(material(1).emission, (Rgb{1, 2, 3}));
  EXPECT_EQ(room.faces[1].material, room.faces[2].material);
  EXPECT_EQ(material(3).emission, (Rgb{4, 4, 4}));
  EXPECT_EQ(material(4), (Material{"line 32", {0.5, 0.5, 0.5}, {}, false}));
  EXPECT_EQ(material(5).reflectance, (Rgb{1, 1, 1}));
  EXPECT_TRUE(material(5).mirror);
  EXPECT_EQ(room.faces[1].corners, room.faces[0].corners);
  EXPECT_EQ(room.faces[1].corners[2], (Vec{1, 1, 0}));
  EXPECT_EQ(room.faces[5].normals, (std::vector<Vec>{{0, 0, 2}, {1, 0, 2}, {0, 1, 1}}));
  EXPECT_EQ(room.faces[1].where, "test.nff:16");
  EXPECT_NEAR(length(room.view.right), 1, 1e-12);
}

TEST(NffRoom, WhatIsWrongIsRejectedWithItsLine) {
  const std::string head = CAMERA + "f 1 0.5 0.25 0.6 0.3 20 0 0\n";  // the text has 6 lines so far
  const std::pair<std::string, std::string> wrong[] = {
      {head + "s 0 0 0 1", "test.nff:7: found a sphere ('s'), expected flat faces: p or pp"},
      {head + "c 0 0 0 1 0 0 1 0", "test.nff:7: found a cone ('c'), expected flat faces: p or pp"},
      {head + "q", "test.nff:7: found 'q', expected a statement: v, b, l, f, # emit, p or pp"},
      {head + CAMERA, "test.nff:7: found a second 'v', expected only that of line 1"},
      {head + SQUARE, "test.nff: found no face that emits, expected one or more"},
      {head + "# emit 1 1", "test.nff:7: found the end of the line, expected an emission"},
      {head + "# emit 1 1 -1", "test.nff:7: found an emission 1 1 -1, expected 0"},
      {head + "# emit nan 1 1", "test.nff:7: found 'nan', expected an emission"},
      {head + "\np 3 0 0 0 1 0 0 2 0 0", "test.nff:8: found 3 corners that enclose no area"},
      {head + "p 3 0 0 0 1 0 0 2 nan 0", "test.nff:7: found 'nan', expected a vertex"},
      {head + "f 1 1 1 0.5 0 0 0.5 1", "test.nff:7: found T 0.5, expected 0 (opaque surfaces)"},
      {head + "f 1 1 1 1 0 0 0 0", "test.nff:7: found a diffuse reflectance 1 1 1, expected 0 or"},
      {head + "f 1 1 1 0 1 0 0 0\n#emit 1 1 1", "test.nff:8: found a mirror's emission 1 1 1"},
      {CAMERA + SQUARE, "test.nff:6: found 'p', expected a surface ('f') before it"},
      {CAMERA + "# emit 1 1 1", "test.nff:6: found '# emit', expected a surface ('f') before it"},
      {"f 1 1 1 0.5 0 0 0 0\n# emit 1 1 1\n" + SQUARE,
       "test.nff:7: found the end of the file, expected a view ('v')"},
      {"v from 0 0 1 at 0 0 1 up 0 1 0 angle 9\n" + SQUARE,
       "test.nff:1: found a view from the point it looks at"},
  };
  for (const auto& [text, expected] : wrong) {
    const std::string error = get_error([&] { read_nff(text); });
    EXPECT_EQ(error.substr(0, expected.size()), expected) << error;
  }
}

// Provides a temporary folder for files.
class ObjRoom : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              fmt::format("tlab-obj-{}-{}", getpid(),
                          testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string save(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }

  std::filesystem::path folder_;
};

const std::string MTL =
    "# materials\nnewmtl wall\nNs 10\nKd 0.5 0.25 0.125\nKs 0.9 0.9 0.9\n"
    "illum 2\nmap_Kd wall.png\nnewmtl lamp\nKe 1 2 3\n"
    "newmtl mirror\nKd 0.1 0.1 0.1\nKs 0.9 0.8 0.7\nillum 3\n";
const std::string POINTS =
    "mtllib m.mtl\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\n"
    "vt 0 0\nvn 0 0 1\nvn 0.1 0 1\ng one two\ns off\n";  // the text has 10 lines so far

TEST_F(ObjRoom, EmissionMirrorsAndNormals) {
  save("m.mtl", MTL);
  const std::string path =
      save("a.obj", POINTS +
                        "usemtl wall\nf 1 2 3 4\nusemtl lamp\nf 1/1 2/1 3/1\nusemtl mirror\n"
                        "f 1//1 2//1 -1//-1\nusemtl wall\nf -4/1/1 2/1/2 -2/1/1\n");
  const Room room = load_room(path);
  EXPECT_EQ(room.materials, (std::vector<Material>{{"wall", {0.5, 0.25, 0.125}, {}, false},
                                                   {"lamp", {}, {1, 2, 3}, false},
                                                   {"mirror", {0.9, 0.8, 0.7}, {}, true}}));
  ASSERT_EQ(room.faces.size(), 4u);
  EXPECT_EQ(room.faces[0].corners, (std::vector<Vec>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_TRUE(room.faces[0].normals.empty());
  EXPECT_EQ(room.faces[1].material, 1u);
  EXPECT_TRUE(room.faces[1].normals.empty());
  EXPECT_EQ(room.faces[2].corners[2], (Vec{0, 1, 0}));
  EXPECT_EQ(room.faces[2].normals, (std::vector<Vec>{{0, 0, 1}, {0, 0, 1}, {0.1, 0, 1}}));
  EXPECT_EQ(room.faces[3].corners, (std::vector<Vec>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
  EXPECT_EQ(room.faces[3].normals, (std::vector<Vec>{{0, 0, 1}, {0.1, 0, 1}, {0, 0, 1}}));
  EXPECT_EQ(room.faces[3].where, path + ":18");
  EXPECT_EQ(room.view.at, (Vec{0.5, 0.5, 0}));
  EXPECT_GT(room.view.from.x, 1) << "from outside";
  EXPECT_NEAR(length(room.view.right), 1, 1e-12);
  const Room shouted = load_room(save("B.OBJ", POINTS + "usemtl lamp\nf 1 2 3\n"));
  EXPECT_EQ(shouted.materials.at(shouted.faces.at(0).material).emission, (Rgb{1, 2, 3}));
}

TEST_F(ObjRoom, WhatIsWrongIsRejectedWithItsLine) {
  save("m.mtl", MTL);
  save("bright.mtl", "newmtl a\nKd 0 0 0\n\nnewmtl b\nKd 1 1 1\n");
  save("glow.mtl", "newmtl a\nillum 3\nKe 1 1 1\nKs 1 1 1\n");
  const std::string in = folder_.string() + "/", at = in + "a.obj:";
  const std::string use = POINTS + "usemtl wall\n";  // the text has 11 lines so far
  const std::pair<std::string, std::string> wrong[] = {
      {use + "f 1 2 5", at + "12: found '5', expected the number of a readable vertex (v): 1 to 4"},
      {use + "f 1 2 0", at + "12: found '0', expected the number of a readable vertex"},
      {use + "f 1 2 -5", at + "12: found '-5', expected the number of a readable vertex"},
      {use + "f 1 2 3x", at + "12: found '3x', expected the number of a readable vertex"},
      {use + "f 1 2", at + "12: found 2 different corners, expected 3 or more"},
      {use + "f", at + "12: found 0 different corners"},
      {use + "v 2 0 0\nf 1 2 5", at + "13: found 3 corners that enclose no area"},
      {use + "curv 1 2", in + "a.obj: found no face, expected one or more"},
      {use + "f 1 2 3", in + "a.obj: found no face that emits, expected one or more"},
      {"mtllib bright.mtl", in + "bright.mtl:4: found a diffuse reflectance 1 1 1, expected 0 or"},
      {"mtllib glow.mtl", in + "glow.mtl:1: found a mirror's emission 1 1 1, expected none"},
  };
  for (const auto& [text, expected] : wrong) {
    const std::string path = save("a.obj", text + "\n");
    const std::string error = get_error([&] { load_room(path); });
    EXPECT_EQ(error.substr(0, expected.size()), expected) << error;
  }
}

// The total area of a room's faces, and the number of faces with normals.
std::pair<double, std::size_t> measure(const Room& room) {
  double area = 0;
  std::size_t normals = 0;
  for (const Face& face : room.faces) {
    area += length(eval_area_normal(face.corners)) / 2;
    normals += !face.normals.empty();
  }
  return {area, normals};
}

TEST_F(ObjRoom, FacesThatRoomsDoNotHaveBecomeTriangles) {
  save("m.mtl", MTL);
  const std::string points =
      "mtllib m.mtl\nusemtl lamp\nv 0 0 0\nv 2 0 0\nv 1 1 0\nv 2 2 0\nv 0 2 0\nv 1 0 0\nv 2 2 1\n"
      "vn 0 0 1\nvn 0 0 -1\n";
  struct Case {
    const char* face;
    std::size_t faces;
    double area;
    std::size_t normals;
  };
  const Case cases[] = {
      {"f 1 2 4 5", 1, 4, 0},    // a square
      {"f 1 2 3 4 5", 3, 3, 0},  // not convex
      {"f 1 6 2 4 5", 3, 4, 0},  // a corner in the middle of a straight edge
      {"f 1 2 7 5", 2, std::sqrt(5) + std::sqrt(5), 0},  // bent
      {"f 1//1 2//1 4//1 5//1", 1, 4, 1},
      {"f 1//2 2//2 4//2 5//2", 1, 4, 0},  // normals that point to the back are ignored
      {"f 1//1 2//1 3//1 4//1 5//1", 3, 3, 3},
  };
  for (const auto& [face, faces, area, normals] : cases) {
    SCOPED_TRACE(face);
    const Room room = load_room(save("a.obj", points + face + "\n"));
    EXPECT_EQ(room.faces.size(), faces);
    EXPECT_NEAR(measure(room).first, area, 1e-12);
    EXPECT_EQ(measure(room).second, normals);
  }
}

TEST_F(ObjRoom, FacesWithoutAMaterialAreLightGrey) {
  save("m.mtl", MTL);
  const Room room =
      load_room(save("a.obj", POINTS + "f 1 2 3\nusemtl lamp\nf 1 2 3\nusemtl\nf 1 2 4\n"));
  ASSERT_EQ(room.faces.size(), 3u);
  for (const std::size_t i : {0, 2})
    EXPECT_EQ(room.materials[room.faces[i].material].reflectance, (Rgb{0.8, 0.8, 0.8}));
}

}  // namespace
}  // namespace radiosity::test
