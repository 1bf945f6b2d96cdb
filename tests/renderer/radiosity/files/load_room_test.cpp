// Tests the reader of .room files: the content of rooms, and error messages.

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "base/errors.hpp"
#include "renderer/radiosity/light/solve.hpp"
#include "tests/renderer/radiosity/rooms.hpp"
#include "tests/support/files.hpp"

namespace radiosity::test {
namespace {

TEST(RoomFile, RandomRoomsComeBackAsTheyWere) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Room room = make_random_room(seed);
    const std::string text = write(room);
    const Room read_back = read(text);
    ASSERT_EQ(read_back.materials, room.materials) << text;
    ASSERT_EQ(read_back.faces.size(), room.faces.size());
    for (std::size_t i = 0; i < room.faces.size(); ++i) {
      const Face &a = read_back.faces[i], &b = room.faces[i];
      EXPECT_EQ(a.corners, b.corners);
      EXPECT_EQ(a.material, b.material);
      EXPECT_EQ(a.along, b.along);
      EXPECT_EQ(a.across, b.across);
      EXPECT_EQ(a.two_sided, b.two_sided);
      EXPECT_TRUE(a.normals.empty());
      EXPECT_EQ(a.where, fmt::format("test.room:{}", 2 + 2 * room.materials.size() + i));
    }
    ASSERT_EQ(read_back.creases.size(), room.creases.size());
    for (std::size_t i = 0; i < room.creases.size(); ++i) {
      EXPECT_EQ(read_back.creases[i].a, room.creases[i].a);
      EXPECT_EQ(read_back.creases[i].b, room.creases[i].b);
    }
    EXPECT_EQ(read_back.view.from, room.view.from);
    EXPECT_EQ(read_back.view.at, room.view.at);
    EXPECT_EQ(read_back.view.up, room.view.up);
    EXPECT_EQ(read_back.view.angle, room.view.angle);
    EXPECT_EQ(read_back.view.width, room.view.width);
    EXPECT_EQ(read_back.view.height, room.view.height);
    EXPECT_NEAR(length(read_back.view.above), 1, 1e-9) << "the view has its image plane";
  }
}

const std::string VIEW = "view from 0 0 5 at 0 0 0 up 0 1 0 angle 45 size 4 3\n";

TEST(RoomFile, BoxesAreClosedAndFaceTheirSide) {
  for (const bool inside : {false, true}) {
    const Room room = read("material m reflect 0 0 0 emit 1 1 1\nbox m -1 2 3 4 4 9 divide 3" +
                           std::string(inside ? " inside\n" : "\n") + VIEW);
    ASSERT_EQ(room.faces.size(), 6u);
    Vec sum;
    double area = 0, volume = 0;
    for (const Face& face : room.faces) {
      EXPECT_EQ(face.along, 3);
      EXPECT_EQ(face.across, 3);
      EXPECT_EQ(face.where, "test.room:2");
      const Vec normal = 0.5 * eval_area_normal(face.corners);
      sum += normal;
      area += length(normal);
      volume += dot(normal, face.corners[0]) / 3;
    }
    EXPECT_EQ(sum, Vec{});
    EXPECT_DOUBLE_EQ(area, 2 * (5 * 2 + 2 * 6 + 6 * 5));
    EXPECT_DOUBLE_EQ(volume, inside ? -60 : 60);
  }
}

struct WrongText {
  const char* text;   // content of the file from line 4 on
  const char* error;  // start of the message, after "test.room:"
};
void PrintTo(const WrongText& wrong, std::ostream* out) { *out << wrong.text; }

class RoomFileWrong : public testing::TestWithParam<WrongText> {};

TEST_P(RoomFileWrong, IsRejectedWithItsLine) {
  const std::string head =
      "material wall reflect 0.5 0.5 0.5\n# lamp:\n"
      "material lamp reflect 0 0 0 emit 9 9 9\n";
  const std::string tail = "\nquad lamp 0 0 0 1 0 0 1 1 0 0 1 0\n" + VIEW;
  const std::string error = get_error([&] { read(head + GetParam().text + tail); });
  const std::string expected = "test.room:" + std::string(GetParam().error);
  EXPECT_EQ(error.substr(0, expected.size()), expected) << error;
}

INSTANTIATE_TEST_SUITE_P(
    Table, RoomFileWrong,
    testing::Values(
        WrongText{"sphere 0 0 0 1",
                  "4: found 'sphere', expected a statement: material, mirror, quad, polygon, box, "
                  "crease or view"},
        WrongText{"\n\nquad wal 0 0 0 1 0 0 1 1 0 0 1 0",
                  "6: found 'wal', expected a material of the lines above: wall, lamp"},
        WrongText{"quad", "4: found the end of the line, expected a material of the lines above"},
        WrongText{"quad wall 0 0 0 1 0 0 1 1 0 0 1",
                  "4: found the end of the line, expected corner 4"},
        WrongText{"quad wall 0 0 0 1 0 0 1 1 0 0 1 0 0",
                  "4: found '0', expected 'divide', then 'two-sided', or the end of the line"},
        WrongText{"quad wall 0 0 0 1 0 0 1 1 nan 0 1 0",
                  "4: found 'nan', expected corner 3 (a number"},
        WrongText{"quad wall 0 0 0 1 0 0 1 1 inf 0 1 0", "4: found 'inf', expected corner 3"},
        WrongText{"quad wall 0 0 0 1 0 0 1 1 0.1 0 1 0",
                  "4: found corner 1 at a distance of 0.0249 from the face's plane, expected a "
                  "flat face"},
        WrongText{"\nquad wall 0 0 0 1 0 0 2 0 0 3 0 0", "5: found 4 corners that enclose no area"},
        WrongText{"quad wall 0 0 0 1 0 0 1 1 0 0 1 0 divide 2",
                  "4: found the end of the line, expected patches along the second edge"},
        WrongText{"quad wall 0 0 0 1 0 0 1 1 0 0 1 0 divide 2 0", "4: found '0', expected patches"},
        WrongText{"quad wall 0 0 0 1 0 0 1 1 0 0 1 0 divide 2.5 1",
                  "4: found '2.5', expected patches"},
        WrongText{"quad wall 0 0 0 1 0 0 1 1 0 0 1 0 two-sided divide 2 2", "4: found 'divide'"},
        WrongText{"polygon wall 0 0 0 1 0 0", "4: found the end of the line, expected corner 3"},
        WrongText{"polygon wall 0 0 0 1 0 0 1 1 0 tow-sided",
                  "4: found 'tow-sided', expected corner 4 (a number"},
        WrongText{"polygon wall 0 0 0 4 0 0 1 1 0 0 4 0",
                  "4: found a face that is not convex at corner 3, expected a convex face"},
        WrongText{"box wall 0 0 0 1 1",
                  "4: found the end of the line, expected the corner with the largest coordinates"},
        WrongText{"box wall 0 0 0 1 -1 1",
                  "4: found a box from 0 to -1 along y, expected the corner with the smallest"},
        WrongText{"box wall 0 0 0 1 1 1 inward",
                  "4: found 'inward', expected 'divide', then 'inside'"},
        WrongText{"material red reflect 1 0 0",
                  "4: found a diffuse reflectance 1 0 0, expected 0 or more and less than 1"},
        WrongText{"material red reflect 0.5 0 0 emit 0 0 -1", "4: found an emission 0 0 -1"},
        WrongText{"material red emit 1 1 1", "4: found 'emit', expected 'reflect'"},
        WrongText{"material red reflect 0.5 0",
                  "4: found the end of the line, expected a reflectance"},
        WrongText{"material wall reflect 0 0 0",
                  "4: found a second material 'wall', expected another name"},
        WrongText{"mirror m reflect 1 1 1 emit 1 1 1",
                  "4: found a mirror's emission 1 1 1, expected none, because a mirror only "
                  "reflects: a face that emits needs a diffuse material"},
        WrongText{"mirror m reflect 1 1 2",
                  "4: found a mirror's reflectance 1 1 2, expected 0 to 1"},
        WrongText{"crease 0 0 0 0 0 0", "4: found both ends of a crease at (0, 0, 0)"},
        WrongText{"crease 0 0 0 1 1 1 1", "4: found '1', expected the end of the line"},
        WrongText{"view from 0 0 1 at 0 0 0 up 0 0 1 angle 45 size 4 3",
                  "4: found an up direction along the view"},
        WrongText{"view from 0 0 1 at 0 0 0 up 0 1 0 angle 180 size 4 3",
                  "4: found a view angle of 180, expected degrees between 0 and 180"},
        WrongText{"view from 0 0 1 at 0 0 0 angle 180", "4: found 'angle', expected 'up'"},
        WrongText{"view from 0 0 1 at 0 0 0 up 0 1 0 angle 40 size 4",
                  "4: found the end of the line, expected the picture's height"},
        WrongText{"view from 0 0 1 at 0 0 0 up 0 1 0 angle 40 size 4 4",
                  "6: found a second view, expected only that of line 4"}));

TEST(RoomFile, WhatIsMissingIsNamed) {
  EXPECT_EQ(get_error([] { read(""); }), "test.room:1: found the end of the file, expected a view");
  EXPECT_EQ(get_error([] { read(VIEW); }), "test.room: found no face, expected one or more");
  EXPECT_EQ(get_error([] {
              read(
                  "material m reflect 0 0 0\nmaterial lamp reflect 0 0 0 emit 1 1 1\n"
                  "polygon m 0 0 0 1 0 0 0 1 0\n" +
                  VIEW);
            }),
            "test.room: found no face that emits, expected one or more, because the room is dark "
            "without");
  EXPECT_EQ(get_error([] { read("mirror m reflect 1 1 1\npolygon m 0 0 0 1 0 0 0 1 0\n" + VIEW); }),
            "test.room: found only mirrors, expected a face that is not a mirror");
}

TEST(RoomFile, IsFoundByItsEnding) {
  EXPECT_EQ(get_error([] { load_room("a.txt"); }),
            "a.txt: found another ending in the name of a room, expected .room, .nff or .obj");
  for (const char* path : {"no-such.room", "no-such.nff", "no-such.obj"})
    EXPECT_EQ(get_error([&] { load_room(path); }),
              std::string(path) + ": cannot be read: No such file or directory");
}

TEST(ReadRoom, ARoomFarAwayIsLitAsNearby) {
  const Room near = read(R"(
material wall reflect 0.7 0.6 0.5
material lamp reflect 0 0 0  emit 17 15 12
box wall  0 0 0  7 5 3  divide 3 inside
box wall  1.5 1.8 0  2.1 2.4 0.7  divide 2
quad lamp  3 2 2.98  3 3 2.98  4 3 2.98  4 2 2.98 divide 2 2
view from 1 0.2 1.75 at 0.95 1.15 0.2 up 0 0 1 angle 72 size 8 6
)");
  const Vec shift{1e6, -2e6, 3e5};
  Room far = near;
  for (Face& face : far.faces)
    for (Vec& corner : face.corners) corner += shift;
  far.view.from += shift;
  far.view.at += shift;
  const ::test::TemporaryFolder folder;
  const auto path = folder.path / "far.room";
  std::ofstream(path) << write(far);
  const LitRoom here = light_room(near, {}), there = light_room(load_room(path.string()), {});
  ASSERT_EQ(here.vertices.size(), there.vertices.size());
  double apart = 0;
  for (std::size_t i = 0; i < here.vertices.size(); ++i)
    apart = std::max(apart, max_component(here.vertices[i] + -1.0 * there.vertices[i]));
  fmt::print("apart by {:.2g}\n", apart);
  EXPECT_LT(apart, 1e-6);
}

TEST(ReadRoom, RefusesACreaseOnNoFace) {
  const std::string text =
      "material wall reflect 0.5 0.5 0.5 emit 1 1 1\n"
      "box wall 0 0 0  1 1 1  inside\n"
      "crease 0.2 0.2 0  0.8 0.2 0\n"
      "crease 5 5 5  6 6 6\n"
      "view from 0.5 0.5 0.5 at 1 0.5 0.5 up 0 0 1 angle 60 size 8 8\n";
  try {
    read_room(text, "r.room");
    FAIL() << "read";
  } catch (const base::BadInput& error) {
    EXPECT_STREQ(error.what(),
                 "r.room:4: found a crease that lies on no face, expected both ends in the plane "
                 "of one face");
  }
}

}  // namespace
}  // namespace radiosity::test
