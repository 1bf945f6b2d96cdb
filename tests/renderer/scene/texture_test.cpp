// Tests mipmaps, and the texture point at a point of the scene.
#include "renderer/scene/texture.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

std::vector<std::uint8_t> make_grey(std::initializer_list<int> values) {
  std::vector<std::uint8_t> bytes;
  for (const int value : values) bytes.insert(bytes.end(), 3, static_cast<std::uint8_t>(value));
  return bytes;
}

// A picture of 2 x 2 pixels: 0 and 255 in the upper row, 51 and 102 in the lower row.
Pyramid make_four() { return make_pyramid(2, 2, make_grey({0, 255, 51, 102})); }

double at(const Pyramid& pyramid, double u, double v) {
  return eval_bilinear(pyramid.levels[0], u, v).r;
}

TEST(Texture, ABytesFullIsOne) {
  const Level level = make_pyramid(1, 1, std::vector<std::uint8_t>{255, 0, 51}).levels[0];
  EXPECT_EQ(eval_bilinear(level, 0.3, 0.8), (Rgb{1, 0, 0.2}));
}

TEST(Texture, BilinearBetweenTheMiddlesOfTexels) {
  const Pyramid four = make_four();
  // At the centres of texels. (0, 0) is the lower left corner.
  EXPECT_EQ(at(four, 0.25, 0.75), 0);
  EXPECT_EQ(at(four, 0.75, 0.75), 1);
  EXPECT_EQ(at(four, 0.25, 0.25), 0.2);
  EXPECT_EQ(at(four, 0.75, 0.25), 0.4);
  // Halfway between two texels, and between four texels.
  EXPECT_DOUBLE_EQ(at(four, 0.5, 0.75), 0.5);
  EXPECT_DOUBLE_EQ(at(four, 0.25, 0.5), 0.1);
  EXPECT_DOUBLE_EQ(at(four, 0.5, 0.5), 0.4);
  // A quarter of the way from left to right texels, and three quarters from lower to upper texels:
  // 0.25 (0.75 * 0.2 + 0.25 * 0.4) + 0.75 (0.75 * 0 + 0.25 * 1).
  EXPECT_DOUBLE_EQ(at(four, 0.375, 0.625), 0.25 * 0.25 + 0.75 * 0.25);
}

TEST(Texture, RepeatsOnAllSides) {
  const Pyramid four = make_four();
  // On the left edge: half of the texel there, and half of the texel at the right edge.
  EXPECT_DOUBLE_EQ(at(four, 0, 0.75), 0.5);
  EXPECT_DOUBLE_EQ(at(four, 0, 0), 0.4);
  Random random{3};
  for (int i = 0; i < 200; ++i) {
    const double u = random.unit(), v = random.unit();
    const double found = at(four, u, v);
    for (const int shift : {-7, -1, 1, 1000})
      EXPECT_NEAR(at(four, u + shift, v - 3 * shift), found, 1e-11) << u << " " << v;
  }
}

TEST(Texture, NoCoordinateReadsBeyondThePicture) {
  constexpr double INF = std::numeric_limits<double>::infinity();
  const Pyramid pyramid =
      make_pyramid(3, 5, make_grey({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}));
  for (const double odd : {-1e-20, 1 - 1e-17, 1e15, -1e300, INF, -INF, std::nan("")})
    for (const auto beyond : {Beyond::repeats, Beyond::stays})
      for (const double size : {0.0, 1.5, 3.0, 1e300, INF, std::nan("")}) {
        const double found = eval_filtered(pyramid, odd, odd, size, beyond).colour.r;
        EXPECT_GE(found, 1.0 / 255);
        EXPECT_LE(found, 15.0 / 255);
      }
}

TEST(Texture, StaysAtItsEdges) {
  const Pyramid four = make_four();
  for (const double v : {1.0, 0.9, 2.0})
    EXPECT_EQ(eval_bilinear(four.levels[0], 0.75, v, Beyond::stays).r, 1);
  EXPECT_EQ(eval_bilinear(four.levels[0], 0.75, 0, Beyond::stays).r, 0.4);
}

double eval_mean(const Level& level) {
  double sum = 0;
  for (const Texel& texel : level.texels) sum += texel.g;
  return sum / static_cast<double>(level.texels.size());
}

TEST(Texture, LevelsHalveAndKeepTheMean) {
  Random random{5};
  for (const auto& [width, height] : {std::pair{8, 8}, {7, 5}, {1, 9}, {64, 3}, {1, 1}}) {
    std::vector<std::uint8_t> bytes;
    for (int i = 0; i < 3 * width * height; ++i)
      bytes.push_back(static_cast<std::uint8_t>(random.below(256)));
    const Pyramid pyramid = make_pyramid(width, height, bytes);
    int w = width, h = height;
    for (const Level& level : pyramid.levels) {
      EXPECT_EQ(level.width, w);
      EXPECT_EQ(level.height, h);
      EXPECT_EQ(level.texels.size(), static_cast<std::size_t>(w * h));
      // Rounding of the texels of each level changes the mean slightly.
      EXPECT_NEAR(eval_mean(level), eval_mean(pyramid.levels[0]), 0.5 * 7);
      w = std::max(1, w / 2);
      h = std::max(1, h / 2);
    }
    EXPECT_EQ(pyramid.levels.back().texels.size(), 1u);
  }
}

TEST(Texture, ATexelIsTheMeanOfWhatItCovers) {
  const Pyramid three = make_pyramid(3, 1, make_grey({0, 30, 255}));
  ASSERT_EQ(three.levels.size(), 2u);
  EXPECT_EQ(three.levels[1].texels[0].r, 95 * 257);
  const Pyramid five = make_pyramid(5, 1, make_grey({0, 50, 100, 150, 200}));
  EXPECT_EQ(five.levels[1].texels[0].r, 40 * 257);   // (0 + 50 + 100 / 2) / 2.5
  EXPECT_EQ(five.levels[1].texels[1].r, 160 * 257);  // (100 / 2 + 150 + 200) / 2.5
  const Pyramid four = make_pyramid(2, 2, make_grey({10, 20, 30, 40}));
  EXPECT_EQ(four.levels[1].texels[0].r, 25 * 257);
}

TEST(Texture, FilteringGoesFromLevelToLevelWithoutAStep) {
  Random random{6};
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 3 * 16 * 16; ++i)
    bytes.push_back(static_cast<std::uint8_t>(random.below(256)));
  const Pyramid pyramid = make_pyramid(16, 16, bytes);
  const double u = 0.31, v = 0.77;
  EXPECT_EQ(eval_filtered(pyramid, u, v, 0.2).colour, eval_bilinear(pyramid.levels[0], u, v));
  EXPECT_EQ(eval_filtered(pyramid, u, v, 0.2).texels, 4);
  for (int level = 0; level < 5; ++level) {
    const double size = std::exp2(level);
    const Rgb here = eval_bilinear(pyramid.levels[static_cast<std::size_t>(level)], u, v);
    EXPECT_NEAR(eval_filtered(pyramid, u, v, size).colour.r, here.r, 1e-12);
    EXPECT_NEAR(eval_filtered(pyramid, u, v, size * (1 - 1e-12)).colour.r, here.r, 1e-9);
  }
  const Filtered between = eval_filtered(pyramid, u, v, 3);
  EXPECT_EQ(between.texels, 8);
  EXPECT_NEAR(
      between.colour.r,
      (eval_bilinear(pyramid.levels[1], u, v).r + eval_bilinear(pyramid.levels[2], u, v).r) / 2,
      1e-12);
  EXPECT_EQ(eval_filtered(pyramid, u, v, 1e9).colour, eval_bilinear(pyramid.levels[4], u, v));
}

TEST(Texture, ATurnIsTheLibrarysAngle) {
  Random random{7};
  for (int i = 0; i < 20000; ++i) {
    const double x = random.range(-1, 1) * std::exp2(random.range(-40, 40)),
                 y = random.range(-1, 1) * std::exp2(random.range(-40, 40));
    const double found = eval_turn(y, x), expected = std::atan2(y, x) / (2 * std::numbers::pi);
    EXPECT_NEAR(std::remainder(found - expected, 1), 0, 3e-16) << y << " " << x;
    EXPECT_TRUE(found >= 0 && found < 1);
  }
  EXPECT_EQ(eval_turn(0, 0), 0);
  EXPECT_EQ(eval_turn(0, 2), 0);
  EXPECT_EQ(eval_turn(3, 0), 0.25);
  EXPECT_EQ(eval_turn(0, -1), 0.5);
  EXPECT_EQ(eval_turn(-1, 0), 0.75);
  EXPECT_LT(eval_turn(-1e-300, 1), 1);
}

// Expects that the gradients of a mapping equal the differences of its coordinates between
// neighbouring points.
void check_gradients(const Mapping& mapping, const Vec& point) {
  constexpr double STEP = 1e-6;
  const TexturePoint here = eval_mapping(mapping, point);
  for (const Vec way : {Vec{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
    const TexturePoint next = eval_mapping(mapping, point + STEP * way),
                       last = eval_mapping(mapping, point - STEP * way);
    EXPECT_NEAR((next.u - last.u) / (2 * STEP), dot(here.grow_u, way), 1e-7);
    EXPECT_NEAR((next.v - last.v) / (2 * STEP), dot(here.grow_v, way), 1e-7);
  }
}

TEST(Texture, PlanarGoesAlongItsEdges) {
  const Vec origin{1, 2, 3}, u{2, 0, 0}, v{1, 4, 0};  // not at right angles
  const Mapping mapping = make_planar(origin, u, v);
  Random random{8};
  for (int i = 0; i < 100; ++i) {
    const double a = random.range(-3, 3), b = random.range(-3, 3), off = random.range(-3, 3);
    const TexturePoint found = eval_mapping(mapping, origin + a * u + b * v + Vec{0, 0, off});
    EXPECT_NEAR(found.u, a, 1e-12);
    EXPECT_NEAR(found.v, b, 1e-12);
  }
  check_gradients(mapping, {5, 6, 7});
  const auto refused = [](const Vec& a, const Vec& b) {
    EXPECT_THROW(make_planar({}, a, b), base::BadInput);
  };
  refused({}, {0, 1, 0});
  refused({1, 2, 3}, {-2, -4, -6});
  refused({1e-30, 0, 0}, {0, 1, 0});
}

TEST(Texture, SphericalIsLongitudeAndLatitude) {
  const Vec middle{3, -2, 1};
  const Mapping mapping = make_spherical(middle, {0, 0, 2});
  const auto find = [&](const Vec& way) { return eval_mapping(mapping, middle + way); };
  const double r = 5;
  EXPECT_EQ(find({r, 0, 0}).u, 0);
  EXPECT_EQ(find({r, 0, 0}).v, 0.5);
  EXPECT_EQ(find({0, r, 0}).u, 0.25);  // seen from outside with z up, to the right of x
  EXPECT_EQ(find({-r, 0, 0}).u, 0.5);
  EXPECT_EQ(find({0, -r, 0}).u, 0.75);
  EXPECT_EQ(find({0, 0, r}).v, 1);
  EXPECT_EQ(find({0, 0, -r}).v, 0);
  EXPECT_NEAR(find({r, 0, r}).v, 0.75, 1e-15);
  EXPECT_NEAR(find({r, r, -r * std::sqrt(2)}).v, 0.25, 1e-15);
  EXPECT_NEAR(find({r, r, 0}).u, 0.125, 1e-15);
  // The seam of the picture is at longitude 0; coordinates never go beyond it.
  EXPECT_GT(find({r, -1e-9, 0}).u, 0.99999);
  EXPECT_LT(find({r, -1e-9, 0}).u, 1);
  EXPECT_EQ(find({}).v, 0.5);  // at the middle of the sphere
  EXPECT_THROW(make_spherical(middle, {}), base::BadInput);
  Random random{9};
  for (int i = 0; i < 50; ++i) {
    const Vec axis = random.direction();
    const Mapping other = make_spherical(middle, axis);
    EXPECT_NEAR(length(other.u), 1, 1e-15);
    EXPECT_NEAR(dot(other.u, axis), 0, 1e-15);
    EXPECT_NEAR(dot(cross(other.u, other.v), axis), 1, 1e-15);
    const TexturePoint north = eval_mapping(other, middle + 4 * axis);
    EXPECT_NEAR(north.v, 1, 1e-7);
    const Vec point = middle + 2 * random.direction();
    if (const double u = eval_mapping(other, point).u; u > 0.001 && u < 0.999)
      check_gradients(other, point);
  }
}

// A scene with one surface. Its texture has the pixels `rgb8`, and uses coordinates at corners.
Scene make_scene(int width, int height, const std::vector<std::uint8_t>& rgb8) {
  Scene scene;
  scene.pyramids.push_back(make_pyramid(width, height, rgb8));
  scene.textures.push_back({0, make_mesh_mapping()});
  Surface surface;
  surface.texture = 0;
  scene.surfaces.push_back(surface);
  return scene;
}

TEST(Texture, AMeshIsLinearInATriangle) {
  Random random{10};
  for (int round = 0; round < 50; ++round) {
    Scene scene = make_scene(1, 1, {0, 0, 0});
    const Vec corners[] = {random.point(5), random.point(5), random.point(5)};
    const Vec normals[] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    Corner coordinates[3];
    for (Corner& c : coordinates) c = {random.range(-2, 2), random.range(-2, 2)};
    if (round % 2)
      add_patch(scene, corners, normals, coordinates);
    else
      add_polygon(scene, corners, coordinates);
    finish(scene);
    for (int i = 0; i < 20; ++i) {
      double a = random.unit(), b = random.unit();
      if (a + b > 1) a = 1 - a, b = 1 - b;
      const double c = 1 - a - b;
      const Vec point = a * corners[0] + b * corners[1] + c * corners[2];
      const TexturePoint found = find_texture_point(scene, scene.textures[0], 0, point);
      EXPECT_NEAR(found.u, a * coordinates[0].u + b * coordinates[1].u + c * coordinates[2].u,
                  1e-9);
      EXPECT_NEAR(found.v, a * coordinates[0].v + b * coordinates[1].v + c * coordinates[2].v,
                  1e-9);
      const Vec way = corners[1] - corners[0];
      EXPECT_NEAR(dot(found.grow_u, way), coordinates[1].u - coordinates[0].u, 1e-8);
      EXPECT_NEAR(dot(found.grow_v, way), coordinates[1].v - coordinates[0].v, 1e-8);
    }
  }
}

TEST(Texture, AMeshOnAQuadrangleMeetsCornersAndEdges) {
  Scene scene = make_scene(1, 1, {0, 0, 0});
  add_polygon(scene, std::vector<Vec>{{9, 9, 9}, {8, 9, 9}, {8, 8, 9}}, std::vector<Corner>(3));
  const std::vector<Vec> corners = {{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {0, 2, 0}};
  const std::vector<Corner> coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  add_polygon(scene, corners, coordinates);
  finish(scene);
  const auto find = [&](double x, double y) {
    return find_texture_point(scene, scene.textures[0], 1, {x, y, 0});
  };
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(find(corners[i].x, corners[i].y).u, coordinates[i].u);
    EXPECT_EQ(find(corners[i].x, corners[i].y).v, coordinates[i].v);
  }
  EXPECT_DOUBLE_EQ(find(1, 0).u, 0.25);
  EXPECT_DOUBLE_EQ(find(4, 1.5).v, 0.75);
  EXPECT_DOUBLE_EQ(find(2, 1).u, 0.5);
  // Coordinates that are affine functions of the position must be exact inside any polygon.
  EXPECT_NEAR(find(3, 0.5).u, 0.75, 1e-14);
  EXPECT_NEAR(find(3, 0.5).v, 0.25, 1e-14);
  EXPECT_NEAR(find(3, 0.5).grow_u.x, 0.25, 1e-14);
  EXPECT_NEAR(find(3, 0.5).grow_v.y, 0.5, 1e-14);
}

TEST(Texture, AMeshNeedsCoordinates) {
  Scene scene = make_scene(1, 1, {0, 0, 0});
  const std::vector<Vec> corners = {{0, 0, 0}, {4, 0, 0}, {4, 2, 0}};
  EXPECT_THROW(add_sphere(scene, {}, 1), base::BadInput);
  EXPECT_THROW(add_cone(scene, {}, 1, {0, 0, 1}, 1), base::BadInput);
  EXPECT_THROW(add_polygon(scene, corners), base::BadInput);
  EXPECT_THROW(add_patch(scene, corners, corners), base::BadInput);
  EXPECT_THROW(add_polygon(scene, corners, std::vector<Corner>(2)), base::BadInput);
  EXPECT_TRUE(scene.objects.empty());
  EXPECT_NO_THROW(add_polygon(scene, corners, std::vector<Corner>(3)));
}

}  // namespace
}  // namespace renderer::test
