// Tests textures, which NFF files state in comments.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/renderer/support.hpp"
#include "tests/support/files.hpp"

namespace renderer::test {
namespace {

// The view, which is line 1 of the file.
const std::string CAMERA = "v from 0 0 9 at 0 0 0 up 0 1 0 angle 40\n";
const std::string WHITE = "f 1 1 1 1 0 0 0 0\n";
const std::string SQUARE = "p 4 0 0 0 1 0 0 1 1 0 0 1 0\n";

// Provides a folder with the picture a.png of 2 x 1 pixels, red and green.
class NffTexture : public testing::Test {
 protected:
  NffTexture() { save_png(path("a.png"), 2, 1, {255, 0, 0, 0, 255, 0}); }

  std::string path(const std::string& name) const { return (folder_.path / name).string(); }
  Scene parse(const std::string& text) const { return parse_scene(CAMERA + text, path("s.nff")); }
  // The error message, with the folder removed.
  std::string error_of(const std::string& text) const {
    const auto message = ::test::message_of<base::BadInput>([&] { parse(text); });
    const std::string folder = folder_.path.string() + "/";
    std::string shorter = message;
    for (auto at = shorter.find(folder); at != shorter.npos; at = shorter.find(folder))
      shorter.erase(at, folder.size());
    return shorter;
  }

 private:
  ::test::TemporaryFolder folder_;
};

TEST_F(NffTexture, IsOfTheSurfaceSetLast) {
  const Scene scene =
      parse(WHITE + SQUARE + WHITE + "# texture a.png planar 1 2 3  2 0 0  0 4 0\n" + SQUARE +
            "# texture a.png spherical 0 0 0 axis 0 1 0\n" + SQUARE + WHITE + SQUARE);
  // A later texture does not change the surface of earlier objects.
  ASSERT_EQ(scene.surfaces.size(), 4u);
  EXPECT_EQ(scene.surfaces[0].texture, NO_TEXTURE);
  EXPECT_EQ(scene.surfaces[1].texture, 0u);
  EXPECT_EQ(scene.surfaces[2].texture, 1u);
  EXPECT_EQ(scene.surfaces[3].texture, NO_TEXTURE);
  ASSERT_EQ(scene.textures.size(), 2u);
  ASSERT_EQ(scene.pyramids.size(), 1u);  // both textures share one picture
  EXPECT_EQ(scene.pyramids[0].levels.size(), 2u);
  const TexturePoint planar = find_texture_point(scene, scene.textures[0], 1, {2, 5, 8});
  EXPECT_DOUBLE_EQ(planar.u, 0.5);
  EXPECT_DOUBLE_EQ(planar.v, 0.75);
  EXPECT_EQ(scene.textures[1].mapping.axis, (Vec{0, 1, 0}));
}

TEST_F(NffTexture, KeepsWhatElseTheSurfaceHas) {
  const Scene scene =
      parse(WHITE + "# gloss 0.2\n# texture a.png spherical 0 0 0\n# translucent 0.1\n" + SQUARE);
  ASSERT_EQ(scene.surfaces.size(), 1u);
  EXPECT_EQ(scene.surfaces[0].texture, 0u);
  EXPECT_EQ(scene.surfaces[0].gloss, 0.2);
  EXPECT_EQ(scene.surfaces[0].translucency, 0.1);
  EXPECT_EQ(scene.textures[0].mapping.axis, (Vec{0, 0, 1}));
}

TEST_F(NffTexture, CoordinatesAreThoseOfThePolygonThatFollows) {
  const std::string patch = "pp 3 0 0 0 0 0 1  1 0 0 0 0 1  0 1 0 0 0 1\n";
  const Scene scene = parse(
      "f 1 1 1 1 0 0 0 0\n# texture a.png mesh\n"
      "# uv 0 0 2 0 # a comment\n# uv 2 1 0 1\n" +
      SQUARE + "# uv 0 0 .5 0 0 .5\n" + patch);
  const auto find = [&](std::uint32_t object, double x, double y) {
    return find_texture_point(scene, scene.textures[0], object, {x, y, 0});
  };
  EXPECT_DOUBLE_EQ(find(0, 0.5, 0.5).u, 1);
  EXPECT_DOUBLE_EQ(find(0, 0.5, 0.5).v, 0.5);
  EXPECT_DOUBLE_EQ(find(1, 0.5, 0.25).u, 0.25);
  EXPECT_DOUBLE_EQ(find(1, 0.5, 0.25).v, 0.125);
}

TEST_F(NffTexture, TravelsWithItsObjectFromFrameToFrame) {
  const std::string text = CAMERA + WHITE + "# texture a.png planar 0 0 0 1 0 0 0 1 0\n" +
                           "# shutter 0 0.5\n# move 4 0 0\n" + SQUARE;
  for (const int frame : {0, 3}) {
    const Scene scene = parse_scene(text, path("s.nff"), frame);
    // A quarter of a frame later, the object has moved by one unit.
    Ray ray;
    // the texture point that was at (0.25, 0.5) at time 0
    ray.origin = {4.0 * frame + 1 + 0.25, 0.5, 5};
    ray.direction = {0, 0, -1};
    ray.time = 0.5;
    Work work;
    const Params params = make_params(2000, 2000, 1);
    const auto hit = intersect(scene, ray, params.traversal, work);
    ASSERT_TRUE(hit);
    const Rgb colour = colour_of(scene, params, ray, *hit, work);
    EXPECT_NEAR(colour.r, 1, 1e-6);
    EXPECT_NEAR(colour.g, 0, 1e-6);
  }
}

TEST_F(NffTexture, ProseIsProse) {
  const Scene scene = parse(
      WHITE +
      "# texture of wood\n# texture of mesh\n# texture\n# uv-mapped\n# uv coordinates\n# uv\n" +
      SQUARE);
  EXPECT_TRUE(scene.textures.empty());
}

TEST_F(NffTexture, CoordinatesWithoutATextureThatNeedsThemDoNoHarm) {
  const Scene scene = parse(WHITE + "# uv 0 0 1 0 1 1 0 1\n" + SQUARE);
  EXPECT_TRUE(scene.coordinates.empty());
}

TEST_F(NffTexture, NamesItsFiles) {
  std::ofstream(path("s.nff")) << CAMERA << WHITE << "# texture a.png spherical 0 0 0\n" << SQUARE;
  EXPECT_EQ(find_files(path("s.nff")), std::vector{path("a.png")});
}

TEST_F(NffTexture, ErrorsNameTheLine) {
  const std::string mesh = WHITE + "# texture a.png mesh\n";
  const std::pair<std::string, std::string> WRONG[] = {
      {"# texture a.png mesh\n", "s.nff:2: found '# texture', expected a surface ('f') before it"},
      {WHITE + "# texture b.png mesh\n", "s.nff:3: b.png: cannot be read"},
      {WHITE + "# texture b.jpg mesh\n", "s.nff:3: b.jpg: cannot be read"},
      {WHITE + "# texture b.PNG\n", "s.nff:3: found the end of the line, expected a mapping"},
      {WHITE + "# texture a.png\n", "s.nff:3: found the end of the line, expected a mapping"},
      {WHITE + "# texture a.png cubic\n",
       "s.nff:3: found 'cubic', expected a mapping: planar, spherical or mesh"},
      {WHITE + "# texture a.png planar 0 0 0 1 0 0 0 1\n",
       "s.nff:3: found the end of the line, expected the texture's left edge"},
      {WHITE + "# texture a.png planar 0 0 0 1 0 0 2 0 0\n",
       "s.nff:3: found a planar texture whose edges span no plane"},
      {WHITE + "# texture a.png spherical 0 0 0 axis 0 0 0\n",
       "s.nff:3: found an axis of length 0"},
      {WHITE + "# texture a.png mesh 1\n", "s.nff:3: found '1', expected the end of the line"},
      {mesh + SQUARE, "s.nff:4: found a polygon without coordinates"},
      {mesh + "s 0 0 0 1\n", "s.nff:4: found a sphere without coordinates"},
      {mesh + "c 0 0 0 1 0 0 1 1\n", "s.nff:4: found a cone without coordinates"},
      {mesh + "# uv 0 0 1 0 1 1\n" + SQUARE,
       "s.nff:5: found 3 texture coordinates for 4 vertices, expected one pair for each vertex"},
      {mesh + "# uv 0 0 1\n" + SQUARE,
       "s.nff:4: found the end of the line, expected a texture coordinate"},
      {mesh + "# uv 0 0 1 2e6\n" + SQUARE,
       "s.nff:4: found '2e6', expected a texture coordinate (a number from -1e+06 to 1e+06)"},
      {mesh + "# uv 0 0 1 0\ns 0 0 0 1\n", "s.nff:4: found 's' after '# uv', expected its polygon"},
      {mesh + "# uv 0 0 1 0\n# gloss 0.1\n", "s.nff:"},
      {mesh + "# uv 0 0 1 0\n", "s.nff:4: found the end of the file after '# uv'"},
  };
  for (const auto& [text, expected] : WRONG)
    EXPECT_EQ(error_of(text).substr(0, expected.size()), expected) << text;
  std::ofstream(path("a.png"), std::ios::binary) << "no picture";
  EXPECT_TRUE(error_of(mesh).starts_with("s.nff:3: a.png: found a file that is not a complete PNG"))
      << error_of(mesh);
}

}  // namespace
}  // namespace renderer::test
