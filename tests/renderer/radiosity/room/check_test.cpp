// Tests that invalid rooms are refused with the right message.

#include <gtest/gtest.h>

#include "renderer/radiosity/room/check.hpp"
#include "tests/renderer/radiosity/rooms.hpp"

namespace radiosity::test {
namespace {

constexpr double NAN_ = std::numeric_limits<double>::quiet_NaN();
constexpr double INF = std::numeric_limits<double>::infinity();

struct WrongRoom {
  const char* name;
  void (*spoil)(Room&);
  const char* error;  // start of the message
};
void PrintTo(const WrongRoom& wrong, std::ostream* out) { *out << wrong.name; }

class RoomWrong : public testing::TestWithParam<WrongRoom> {};

TEST_P(RoomWrong, IsRejectedWithItsReason) {
  Room room = make_small_room();
  room.faces[0].where = "a.room:7";
  GetParam().spoil(room);
  const std::string error = get_error([&] { check(room); });
  EXPECT_EQ(error.substr(0, std::string_view(GetParam().error).size()), GetParam().error) << error;
}

std::vector<Vec>& corners(Room& room) { return room.faces[0].corners; }

INSTANTIATE_TEST_SUITE_P(
    Table, RoomWrong,
    testing::Values(
        WrongRoom{"Nan", [](Room& r) { corners(r)[1].y = NAN_; },
                  "a.room:7: found corner 2 at (1, nan, 0), expected finite numbers"},
        WrongRoom{"Infinite", [](Room& r) { corners(r)[3].z = -INF; },
                  "a.room:7: found corner 4 at (0, 1, -inf), expected finite numbers"},
        WrongRoom{"Huge", [](Room& r) { corners(r)[3].z = 1e16; },
                  "a.room:7: found corner 4 at (0, 1, 1e+16), expected finite numbers up to 1e+15"},
        WrongRoom{"NotFlat", [](Room& r) { corners(r)[2].z = 8e-6; },
                  "a.room:7: found corner 1 at a distance of 2e-06 from the face's plane, expected "
                  "a flat face"},
        WrongRoom{"TwoCorners", [](Room& r) { corners(r).resize(2); },
                  "a.room:7: found 2 corners, expected 3 or more"},
        WrongRoom{"NoCorners", [](Room& r) { corners(r).clear(); }, "a.room:7: found 0 corners"},
        WrongRoom{"RepeatedCorner", [](Room& r) { corners(r)[3] = corners(r)[0]; },
                  "a.room:7: found corners 4 and 1 both at (0, 0, 0), expected different corners"},
        WrongRoom{"OnePoint",
                  [](Room& r) {
                    corners(r) = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
                  },
                  "a.room:7: found corners 1 and 2 both at (1, 1, 1)"},
        WrongRoom{"Needle",
                  [](Room& r) {
                    corners(r) = {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}};
                  },
                  "a.room:7: found 3 corners that enclose no area, expected a face with an area"},
        WrongRoom{"Crossed", [](Room& r) { std::swap(corners(r)[1], corners(r)[2]); },
                  "a.room:7: found 4 corners that enclose no area"},
        WrongRoom{"ThreeOnALine",
                  [](Room& r) {
                    corners(r)[2] = {0.5, 0.5, 0};
                  },
                  "a.room:7: found corner 3 on the line between its neighbours, expected a turn"},
        WrongRoom{"Dart",
                  [](Room& r) {
                    corners(r)[2] = {0.2, 0.2, 0};
                  },
                  "a.room:7: found a face that is not convex at corner 3, expected a convex face"},
        WrongRoom{"Pentagram",
                  [](Room& r) {
                    corners(r).clear();
                    for (const int i : {0, 2, 4, 1, 3})
                      corners(r).push_back({std::cos(1.25664 * i), std::sin(1.25664 * i), 0});
                  },
                  "a.room:7: found a face whose corners wind more than once before corner"},
        WrongRoom{"Spiral",
                  // A border that turns left at every corner, but goes round more than once.
                  [](Room& r) {
                    corners(r) = {{0, 0, 0}};
                    for (int i = 0; i < 11; ++i)
                      corners(r).push_back({std::cos(0.7 * i), std::sin(0.7 * i), 0});
                  },
                  "a.room:7: found a face whose corners wind more than once before corner 7"},
        WrongRoom{"Normals",
                  [](Room& r) {
                    r.faces[0].normals.resize(3, Vec{0, 0, 1});
                  },
                  "a.room:7: found 3 normals, expected one for each of the 4 corners, or none"},
        WrongRoom{"NormalBehind",
                  [](Room& r) {
                    r.faces[0].normals.resize(4, Vec{0, 0, 1});
                    r.faces[0].normals[2] = {1, 0, -0.1};
                  },
                  "a.room:7: found the normal (1, 0, -0.1) of corner 3, expected a normal "
                  "of non"},
        WrongRoom{
            "NormalWithoutLength",  // the square of its length underflows to 0
            [](Room& r) {
              r.faces[0].normals.resize(4, Vec{0, 0, 1});
              r.faces[0].normals[1] = {0, 0, 1e-320};
            },
            "a.room:7: found the normal (0, 0, 1e-320) of corner 2, expected a normal of non"},
        WrongRoom{"NormalNan",
                  [](Room& r) {
                    r.faces[0].normals.resize(4, Vec{0, 0, NAN_});
                  },
                  "a.room:7: found the normal of corner 1 at (0, 0, nan)"},
        WrongRoom{"NoPatches", [](Room& r) { r.faces[0].along = 0; },
                  "a.room:7: found 0 x 1 patches, expected 1 to 10000 in each "},
        WrongRoom{"TooManyPatches", [](Room& r) { r.faces[0].across = 10001; },
                  "a.room:7: found 1 x 10001 patches"},
        WrongRoom{"NoSuchMaterial", [](Room& r) { r.faces[0].material = 2; },
                  "a.room:7: found material 2, expected an index below 2"},
        WrongRoom{"NoName", [](Room& r) { r.faces[1].along = 0; }, "face 2: found 0 x 1 patches"},
        WrongRoom{
            "ReflectsAll", [](Room& r) { r.materials[0].reflectance.g = 1; },
            "material 'wall': found a diffuse reflectance 0.5 1 0.5, expected 0 or more and less "
            "than 1"},
        WrongRoom{"ReflectsLessThanNothing", [](Room& r) { r.materials[0].reflectance.b = -0.1; },
                  "material 'wall': found a diffuse reflectance 0.5 0.5 -0.1"},
        WrongRoom{"ReflectsNan", [](Room& r) { r.materials[0].reflectance.r = NAN_; },
                  "material 'wall': found a diffuse reflectance nan 0.5 0.5"},
        WrongRoom{"DarkLight", [](Room& r) { r.materials[1].emission.b = -1; },
                  "material 'lamp': found an emission 1 1 -1, expected 0 to 1e+15"},
        WrongRoom{"BrightestLight", [](Room& r) { r.materials[1].emission.b = INF; },
                  "material 'lamp': found an emission 1 1 inf"},
        WrongRoom{"EmittingMirror", [](Room& r) { r.materials[1].mirror = true; },
                  "material 'lamp': found a mirror's emission 1 1 1, expected none"},
        WrongRoom{"MirrorAboveOne",
                  [](Room& r) {
                    r.materials[0] = {"glass", {1, 1, 1.01}, {}, true};
                  },
                  "material 'glass': found a mirror's reflectance 1 1 1.01, expected 0 to 1"},
        WrongRoom{"NoEmitter", [](Room& r) { r.faces.pop_back(); },
                  "found no face that emits, expected one or more"},
        WrongRoom{"OnlyMirrors",
                  [](Room& r) {
                    r.materials = {{"a", {1, 1, 1}, {}, true}, {"b", {1, 1, 1}, {}, true}};
                  },
                  "found only mirrors, expected a face that is not a mirror"},
        WrongRoom{"Empty", [](Room& r) { r.faces.clear(); }, "found no face, expected one or more"},
        WrongRoom{"CreaseOfNoLength",
                  [](Room& r) {
                    r.creases = {{{0, 0, 0}, {1, 0, 0}}, {{1, 2, 3}, {1, 2, 3}}};
                  },
                  "crease 2: found both ends of a crease at (1, 2, 3), expected different ends"},
        WrongRoom{"CreaseNan",
                  [](Room& r) {
                    r.creases = {{{0, 0, 0}, {1, NAN_, 0}}};
                  },
                  "crease 1: found a crease's second end at (1, nan, 0), expected finite numbers"},
        WrongRoom{"ViewFromWhatItSees", [](Room& r) { r.view.from = r.view.at; },
                  "view: found a view from the point it looks at, expected different points 'from' "
                  "and 'at'"},
        WrongRoom{"ViewUpAlong",
                  [](Room& r) {
                    r.view.up = {0, 0, 2};
                  },
                  "view: found an up direction along the view"},
        WrongRoom{"ViewNan", [](Room& r) { r.view.up.x = NAN_; },
                  "view: found the view's 'up' at (nan"},
        WrongRoom{"ViewAngle", [](Room& r) { r.view.angle = 180; },
                  "view: found a view angle of 180, expected degrees between 0 and 180"},
        WrongRoom{"ViewAngleNan", [](Room& r) { r.view.angle = NAN_; },
                  "view: found a view angle of nan"},
        WrongRoom{"ViewSize", [](Room& r) { r.view.height = 0; },
                  "view: found a picture of 512 x 0 pixels, expected 1 to 65536 in each "}),
    [](const auto& info) { return info.param.name; });

TEST(RoomCheck, SmallestRoomsPass) {
  Room room = make_small_room();
  EXPECT_EQ(get_error([&] { check(room); }), "accepted");
  corners(room)[2].z = 2e-6;  // every corner is then off the mean plane by a quarter of this height
  EXPECT_EQ(get_error([&] { check(room); }), "accepted");
  room.materials[0] = {"mirror", {1, 1, 1}, {}, true};
  EXPECT_EQ(get_error([&] { check(room); }), "accepted");
}

// A flat, convex face must be valid at any position and size.
TEST(RoomCheck, ConvexFacesPassAndDentedOnesDoNot) {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    Face face;
    face.corners = make_convex(random, 3 + random.below(10));
    const double size = std::pow(10.0, random.range(-6, 6));
    for (Vec& c : face.corners) c = size * c;
    ASSERT_EQ(get_error([&] { check_face(face, 1); }), "accepted");

    const std::size_t n = face.corners.size();
    Vec centre;
    for (const Vec& c : face.corners) centre += (1.0 / static_cast<double>(n)) * c;
    const auto i = static_cast<std::size_t>(random.below(static_cast<int>(n)));
    const Vec middle = 0.5 * (face.corners[(i + 1) % n] + face.corners[(i + n - 1) % n]);
    const Vec corner = face.corners[i];
    if (n > 3) {
      face.corners[i] = middle + 0.2 * (middle - corner);
      EXPECT_NE(get_error([&] { check_face(face, 1); }), "accepted") << "a dent";
      const Vec up = normalize(eval_area_normal(face.corners));
      face.corners[i] = corner + 1e-3 * length(corner - centre) * up;
      EXPECT_NE(get_error([&] { check_face(face, 1); }), "accepted") << "a bend";
    }
    face.corners[i] = face.corners[(i + 1) % n];
    EXPECT_NE(get_error([&] { check_face(face, 1); }), "accepted") << "a corner twice";
    face.corners[i] = corner;
    std::reverse(face.corners.begin(), face.corners.end());
    EXPECT_EQ(get_error([&] { check_face(face, 1); }), "accepted") << "either side may be front";
  }
}

// Newell's normal is the sum over a fan of triangles. It must be the same from every corner.
TEST(RoomCheck, AreaNormalsAreTheSameFromEveryCorner) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    std::vector<Vec> corners = make_convex(random, 3 + random.below(6));
    const Vec normal = eval_area_normal(corners);
    Vec newell;
    for (std::size_t i = 0; i < corners.size(); ++i)
      newell += cross(corners[i], corners[(i + 1) % corners.size()]);
    EXPECT_LT(length(normal - newell), 1e-12 * 100);
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    EXPECT_LT(length(normal - eval_area_normal(corners)), 1e-12 * length(normal) + 1e-13);
    std::reverse(corners.begin(), corners.end());
    EXPECT_LT(length(normal + eval_area_normal(corners)), 1e-12 * length(normal) + 1e-13);
  }
  const std::vector<Vec> square = {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}};
  EXPECT_EQ(eval_area_normal(square), (Vec{0, 0, 12}));
}

}  // namespace
}  // namespace radiosity::test
