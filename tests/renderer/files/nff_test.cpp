// Tests the reader of NFF files: every statement, and error messages.

#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "tests/renderer/support.hpp"
#include "tests/support/files.hpp"

namespace renderer::test {
namespace {

const std::string VIEW = "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nhither 1\nresolution 4 3\n";
const std::string SURFACE = "f 1 0.5 0.25 0.6 0.3 20 0.1 1.5\n";

TEST(Nff, EveryStatement) {
  const Scene scene = parse(
      "# a comment\nb 0.1 0.2 0.3\n" + VIEW + "\nl 1 2 3\nl 4 5 6 0.5 0.25 1 # coloured\n" +
      SURFACE + "s 1 2 3 0.5\r\np 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" +
      "f 1 1 1 1 0 0 0 0\npp 3\n0 0 1 0 0 1\n1 0 1 0 0 2\n0 1 1 0 1 1\nc\n0 0 0 1\n0 0 2 0.5\n" +
      "c 0 0 0 1 0 0 2 1\n");
  EXPECT_EQ(scene.background, (Rgb{0.1, 0.2, 0.3}));
  EXPECT_EQ(scene.view.from, (Vec{0, 0, 5}));
  EXPECT_EQ(scene.view.hither, 1);
  EXPECT_EQ(scene.view.width, 4);
  EXPECT_EQ(scene.view.height, 3);
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0].at, (Vec{1, 2, 3}));
  EXPECT_EQ(scene.lights[0].intensity.g, 1 / std::sqrt(2.0)) << "the SPD's share";
  EXPECT_EQ(scene.lights[1].intensity, (Rgb{0.5, 0.25, 1}));
  ASSERT_EQ(scene.surfaces.size(), 2u);
  EXPECT_EQ(scene.surfaces[0].colour, (Rgb{1, 0.5, 0.25}));
  EXPECT_EQ(scene.surfaces[0].kd, 0.6);
  EXPECT_EQ(scene.surfaces[0].ks, 0.3);
  EXPECT_EQ(scene.surfaces[0].shine, 20);
  EXPECT_EQ(scene.surfaces[0].t, 0.1);
  EXPECT_EQ(scene.surfaces[0].ior, 1.5);
  EXPECT_EQ(object_count(scene), 5u);
  EXPECT_EQ(scene.spheres.at(0).radius, 0.5);
  EXPECT_EQ(scene.polygons.at(0).tag.surface, 0u);
  EXPECT_EQ(scene.patches.at(0).tag.surface, 1u);
  EXPECT_EQ(scene.cones.size(), 2u);
}

TEST(Nff, NumbersAsProgramsWriteThem) {
  const Scene scene =
      parse(VIEW + SURFACE + "s +1 -.5 1e-3 1E0\ns 0 0 1e-400 1\ns 1D0 0 1E-400 +0.5d+0#x\n");
  EXPECT_EQ(scene.spheres.at(0).centre, (Vec{1, -0.5, 0.001}));
  EXPECT_EQ(scene.spheres.at(2).radius, 0.5);
  EXPECT_EQ(object_count(scene), 3u);
}

TEST(Nff, LineEndsAndMarksOfOtherSystems) {
  const std::string text = "# made on a Mac\n" + VIEW + SURFACE + "# red\n#emit\ns 1 2 3 0.5 # b\n";
  for (const char* head : {"", "\xEF\xBB\xBF"})
    for (const char* tail : {"", "\x1A", "# no end"})
      for (const char* line_end : {"\n", "\r\n", "\r", "\r\r\n"}) {
        std::string ended = head;
        for (const char c : text) ended += c == '\n' ? line_end : std::string(1, c);
        const Scene scene = parse(ended + tail);
        ASSERT_EQ(object_count(scene), 1u);
        EXPECT_EQ(scene.spheres.at(0).radius, 0.5);
      }
  for (const char* line_end : {"\n", "\r\n", "\r"})
    EXPECT_EQ(::test::message_of<base::BadInput>(
                  [&] { parse(fmt::format("# a{0}{0}s 1 2 3 4{0}", line_end)); }),
              "test.nff:3: found 's', expected a surface ('f') before it");
}

struct Wrong {
  std::string text;   // file content after the view (7 lines) and the surface (line 8)
  std::string error;  // expected message, after "test.nff:"
};

class NffWrong : public testing::TestWithParam<Wrong> {};

TEST_P(NffWrong, IsRejectedWithItsLine) {
  try {
    parse(VIEW + SURFACE + GetParam().text);
    FAIL() << "accepted";
  } catch (const base::BadInput& bad) {
    EXPECT_EQ(std::string(bad.what()).substr(0, 9 + GetParam().error.size()),
              "test.nff:" + GetParam().error);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Table, NffWrong,
    testing::Values(
        Wrong{"q 1 2", "9: found 'q', expected a statement: v, b, l, f, s, p, pp or c"},
        Wrong{"\n\ns 1 2 x 4", "11: found 'x', expected the centre (a number"},
        Wrong{"s 1 2 3", "9: found the end of the file, expected the radius"},
        Wrong{"s 1 2 nan 1", "9: found 'nan', expected the centre"},
        Wrong{"s 1 2 inf 1", "9: found 'inf'"}, Wrong{"s 1 2 1e999 1", "9: found '1e999'"},
        Wrong{"s 1 2 1e20 1", "9: found '1e20'"}, Wrong{"s 1 2 0x10 1", "9: found '0x10'"},
        Wrong{"s 1 2 3,5 1", "9: found '3,5'"}, Wrong{"s 1 2 +-3 1", "9: found '+-3'"},
        Wrong{"s 1 2 3 -1", "9: found '-1', expected the radius"},
        Wrong{"s 1 2 3 0", "9: found a sphere of radius 0, expected a radius > 0"},
        Wrong{"s 1 2 3 4 5", "9: found '5', expected a statement"},
        Wrong{"s 1 2 \x01\x80z 1", "9: found '\\x01\\x80z'"},
        Wrong{"p 2 0 0 0 1 1 1", "9: found '2', expected the number of vertices (a whole number"},
        Wrong{"p -1", "9: found '-1'"}, Wrong{"p 3.5", "9: found '3.5'"},
        Wrong{"p 1000000000\n0 0 0", "9: found '1000000000', expected the number of vertices"},
        Wrong{"p 10000000\n0 0 0\n", "10: found the end of the file, expected a vertex"},
        Wrong{"p 99999999999999999999", "9: found '9999"},
        Wrong{"p 3\n0 0 0\n1 1 1\ns 0 0 0 1", "12: found 's', expected a vertex"},
        Wrong{"p 3\n0 0 0\n1 1 1\n2 2 2", "9: found a polygon with area 0"},
        Wrong{"p 3\n1 1 1\n1 1 1\n1 1 1", "9: found a polygon with area 0"},
        Wrong{"p 4\n0 0 0\n1 0 0\n1 1 1\n0 1 0", "9: found a polygon that is not flat"},
        Wrong{"pp 3 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 0", "9: found a normal of length 0"},
        Wrong{"c 0 0 0 0\n1 1 1 0", "9: found a cone of radii 0 and 0"},
        Wrong{"c 0 0 0 1\n0 0 0 1", "9: found a cone with coinciding ends"},
        Wrong{"c 0 0 0 -1\n0 0 1 1", "9: found '-1', expected the base's radius"},
        Wrong{"f 1 1 1 2 0 0 0 0", "9: found '2', expected Kd (a number from 0 to 1)"},
        Wrong{"f 1 1 1 1 0 0 0.5 0", "9: found an index of refraction of 0"},
        Wrong{"f 1 1 1 1 0 -3 0 0", "9: found '-3', expected Shine"},
        Wrong{"s 0 0 1.#INF 1", "9: found '1.#INF', expected the centre"},
        Wrong{"s 0 0 1.#QNAN 1", "9: found '1.#QNAN', expected the centre"},
        Wrong{"b 1 -1 1", "9: found '-1', expected the background"},
        Wrong{"l 1 2", "9: found the end of the file, expected the light's position"},
        Wrong{"l 1 2 3 0.5\n", "9: found the end of the file, expected the light's colour"},
        Wrong{"v from 1 1 1", "9: found a second 'v', expected only that of line 1"}));

TEST(Nff, WrongFromTheStart) {
  const auto expect = [](const std::string& text, const std::string& error) {
    try {
      parse(text);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const base::BadInput& bad) {
      EXPECT_EQ(std::string(bad.what()).substr(0, error.size()), error);
    }
  };
  expect("", "test.nff:1: found the end of the file, expected a view ('v')");
  expect("\xFF\xFEv", "test.nff:1: found UTF-16 or binary data, expected text in UTF-8");
  expect("b 0 0 0\n", "test.nff:1: found the end of the file, expected a view ('v')");
  expect(VIEW + "s 0 0 0 1\n", "test.nff:8: found 's', expected a surface ('f')");
  expect("v\nfrom 0 0 1\nat 0 0 0\nup 0 1 0\n" + SURFACE,
         "test.nff:5: found 'f', expected the view's 'angle'");
  expect("\nv from 0 0 0 at 0 0 0 up 0 1 0 angle 45", "test.nff:2: found a view from the point");
  expect("v from 0 0 1 at 0 0 0 up 0 0 1 angle 45", "test.nff:1: found an up direction along");
  expect("v from 0 0 1 at 0 0 0 up 0 0 0 angle 45", "test.nff:1: found an up direction along");
  expect("v from 0 0 1 at 0 0 0 up 0 1 0 angle 180", "test.nff:1: found a view angle of 180");
  expect("v from 0 0 1 from 0 0 1", "test.nff:1: found 'from', expected each");
  expect("v from 0 0 1 at 0 0 0 up 0 1 0 angle 45 resolution 0 5", "test.nff:1: found '0'");
}

TEST(Nff, RandomBytesAreRejectedNotFatal) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    std::string text =
        VIEW + SURFACE + "l 1 1 1\ns 0 0 0 1\np 3 0 0 0 1 0 0 0 1 0\nc 0 0 0 1 0 0 1 1\n";
    for (int i = 0; i < 5; ++i)
      text[static_cast<std::size_t>(random.below(static_cast<int>(text.size())))] =
          static_cast<char>(random.below(256));
    try {
      render(parse(text), make_params(4, 4, 3));
    } catch (const base::BadInput&) {
    }
  }
}

}  // namespace
}  // namespace renderer::test
