// Tests distributed rays by comparison with optics and geometry: the circle of confusion,
// penumbrae, the length of motion blur, and an edge seen in a rough surface.

#include <gtest/gtest.h>

#include <functional>

#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

constexpr int DISC_SIDE = 64;

// Parameters for scenes without lights, in which objects have only their ambient light.
Params make_glow(int samples) {
  Params params = make_params(DISC_SIDE, DISC_SIDE, 1);
  params.sample = SamplePosition::center;
  params.ambient = 1;
  params.sampling.pixel_samples = samples;
  return params;
}

// The horizontal and vertical variance of an image's brightness, in the image plane at distance 1.
struct Spread {
  double across = 0, up = 0;
};
Spread eval_spread(const Scene& scene, const Params& params) {
  const Samples image = render(scene, params, 2).samples;
  double sum = 0, mean[2] = {}, square[2] = {};
  for (int y = 0; y < DISC_SIDE; ++y)
    for (int x = 0; x < DISC_SIDE; ++x) {
      const double light = image.get(static_cast<std::uint32_t>(y * DISC_SIDE + x)).g;
      const double at[2] = {x + 0.5 - DISC_SIDE / 2, y + 0.5 - DISC_SIDE / 2};
      sum += light;
      for (int i = 0; i < 2; ++i) {
        mean[i] += light * at[i];
        square[i] += light * at[i] * at[i];
      }
    }
  EXPECT_GT(sum, 0);
  const double pixel = 2 * scene.view.half_height / DISC_SIDE;
  const auto variance = [&](int i) {
    const double centre = mean[i] / sum;
    return pixel * pixel * (square[i] / sum - centre * centre - 1.0 / 12);
  };
  return {variance(0), variance(1)};
}

Scene make_glowing_sphere(double depth, double radius, double half_height) {
  Scene scene;
  scene.surfaces.push_back({});
  scene.view.from = {};
  scene.view.at = {0, 0, -1};
  scene.view.angle = 360 / std::numbers::pi * std::atan(half_height);
  add_sphere(scene, {0, 0, -depth}, radius);
  return scene;
}

// A lens of diameter A and focal length F that is focused on the distance s has its film at v = F s
// / (s - F) (M. Potmesil and I. Chakravarty). A point at the distance d becomes a disc on the film,
// with the diameter c = A v abs(d - s) / (d s). The image plane here is at distance 1 from the lens
// instead of v, so that the disc has the diameter c / v in this plane.
TEST(Distributed, CircleOfConfusion) {
  constexpr double A = 0.5, S = 5, F = 0.05, V = F * S / (S - F);
  for (const double d : {2.5, 3.5, 4.2, 7.0, 12.0, 40.0}) {
    const double c = A * std::abs(d - S) / d * V / S;
    const double on_plane = c / V, radius = 0.05 * on_plane * d;
    Scene scene = make_glowing_sphere(d, radius, 0.7 * on_plane);
    scene.view.lens = {A, S};
    finish(scene);
    // A disc of the diameter D has the variance D^2 / 16. The variance of the sphere's sharp image
    // is added to it.
    const Spread found = eval_spread(scene, make_glow(256));
    const double own = radius * radius / (d * d) / 4;
    EXPECT_NEAR(V * 4 * std::sqrt(found.across - own), c, 0.02 * c) << "distance " << d;
    EXPECT_NEAR(V * 4 * std::sqrt(found.up - own), c, 0.02 * c) << "distance " << d;
  }
}

TEST(Distributed, WhatIsInFocusIsSharp) {
  Scene scene = make_glowing_sphere(5, 0.5, 0.2);
  scene.view.lens = {0.5, 5};
  finish(scene);
  Params params = make_glow(256);
  const Spread lens = eval_spread(scene, params);
  params.sampling.lens = 0;
  const Spread pinhole = eval_spread(scene, params);
  EXPECT_NEAR(lens.across, pinhole.across, 0.02 * pinhole.across);
  EXPECT_NEAR(lens.up, pinhole.up, 0.02 * pinhole.up);
}

// The length of motion blur in the image must be the length of the movement while the shutter is
// open, divided by the distance between the eye and the movement.
TEST(Distributed, BlurIsSpeedTimesShutter) {
  constexpr double DEPTH = 10, RADIUS = 0.3, SPEED = 3;
  for (const bool is_camera : {false, true})
    for (const double shutter : {0.25, 0.5, 1.0}) {
      Scene scene = make_glowing_sphere(DEPTH, RADIUS, 0.2);
      if (is_camera)
        scene.view.from_move = scene.view.at_move = {SPEED, 0, 0};
      else
        scene.moves = {{SPEED, 0, 0}};
      // Puts the middle of the movement in the middle of the picture.
      scene.view.from.x = scene.view.at.x = (is_camera ? -0.5 : 0.5) * SPEED * shutter;
      finish(scene);
      Params params = make_glow(96);
      params.sampling.shutter = shutter;
      const Spread found = eval_spread(scene, params);
      // A line of the length l has the variance l^2 / 12.
      const double own = RADIUS * RADIUS / (DEPTH * DEPTH) / 4;
      const double expected = SPEED * shutter / DEPTH;
      EXPECT_NEAR(std::sqrt(12 * (found.across - own)), expected, 0.01 * expected)
          << (is_camera ? "camera" : "object") << ", shutter " << shutter;
      EXPECT_NEAR(found.up, own, 0.05 * own);
    }
}

// The width for which `shape` fits best; `shape` rises from 0 to 1 between -0.5 and 0.5.
double fit_width(const std::vector<double>& at, const std::vector<double>& found, double expected,
                 const std::function<double(double)>& shape) {
  double best = 0, least = 1e300;
  for (double width = 0.7 * expected; width < 1.3 * expected; width += 0.001 * expected) {
    double error = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double difference = found[i] - shape(at[i] / width);
      error += difference * difference;
    }
    if (error < least) {
      least = error;
      best = width;
    }
  }
  return best;
}

// The fraction of a disc of diameter 1 that is below a line at `x`, -0.5..0.5.
double eval_segment(double x) {
  const double q = std::clamp(2 * x, -1.0, 1.0);
  return 1 - (std::acos(q) - q * std::sqrt(1 - q * q)) / std::numbers::pi;
}

// The fraction of a light that the point `x` of a floor at z = 0 sees. An edge at z = `edge` hides
// everything to the right of x = 0.
double eval_lit(const Scene& scene, double x, int samples) {
  Params params = make_params(1000, 1000, 1);
  params.sampling.pixel_samples = samples;
  int lit = 0;
  for (int pass = 0; pass < samples; ++pass) {
    Ray ray{.origin = {x, 0, 0.25}, .direction = {0, 0, -1}, .influence = {1, 1, 1}};
    ray.sample = static_cast<std::uint32_t>(std::lround(1000 * (x + 5)));
    ray.pass = static_cast<std::uint16_t>(pass);
    Work work;
    const auto hit = intersect(scene, ray, params.traversal, work);
    if (!hit) throw std::runtime_error("no floor");
    Children feelers;
    make_children(scene, params, ray, *hit, feelers, work);
    EXPECT_EQ(feelers.size(), 1u);
    lit += !intersect(scene, feelers.at(0), params.traversal, work);
  }
  return 1.0 * lit / samples;
}

// Measures the width of a penumbra. For a light of width L at the distance d1 from an edge that is
// d2 above the floor, it must be w = L d2 / d1.
double measure_penumbra(const std::string& light, double above, double edge, double expected,
                        const std::function<double(double)>& shape) {
  const Scene scene = parse(fmt::format(
      "v from 0 0 5 at 0 0 0 up 0 1 0 angle 45\nf 1 1 1 1 0 0 0 0\n"
      "p 4 -99 -99 0 99 -99 0 99 99 0 -99 99 0\np 4 0 -99 {0} 99 -99 {0} 99 99 {0} 0 99 {0}\n"
      "# light {1}\n",
      edge, fmt::format(fmt::runtime(light), above)));
  std::vector<double> at, found;
  for (int i = -60; i <= 60; ++i) {
    at.push_back(expected * i / 80.0);
    found.push_back(eval_lit(scene, -at.back(), 256));
  }
  EXPECT_EQ(found.front(), 0);
  EXPECT_EQ(found.back(), 1);
  return fit_width(at, found, expected, shape);
}

TEST(Distributed, PenumbraOfARectangle) {
  const auto ramp = [](double x) { return std::clamp(x + 0.5, 0.0, 1.0); };
  for (const auto& [l, d1, d2] : {std::array{0.4, 2.0, 1.0}, {0.8, 5.0, 0.5}, {1.0, 3.0, 2.0}}) {
    const double expected = l * d2 / d1;
    const auto light = fmt::format("rect 0 0 {{}} {} 0 0 0 0.3 0", l / 2);
    EXPECT_NEAR(measure_penumbra(light, d1 + d2, d2, expected, ramp), expected, 0.02 * expected);
    // The same light, with its front and back exchanged.
    const auto turned = fmt::format("rect 0 0 {{}} 0 -0.3 0 {} 0 0", -l / 2);
    EXPECT_NEAR(measure_penumbra(turned, d1 + d2, d2, expected, ramp), expected, 0.02 * expected);
  }
}

TEST(Distributed, PenumbraOfASphere) {
  for (const auto& [l, d1, d2] : {std::array{0.2, 4.0, 1.0}, {0.4, 5.0, 0.5}, {0.3, 6.0, 2.0}}) {
    const double expected = l * d2 / d1;
    const auto light = fmt::format("sphere 0 0 {{}} {}", l / 2);
    EXPECT_NEAR(measure_penumbra(light, d1 + d2, d2, expected, eval_segment), expected,
                0.03 * expected);
  }
}

// The fraction of rays that a surface sends beyond an edge. The directions fill a disc of radius S
// at distance 1, perpendicular to the axis. The edge lies in a plane parallel to the disc at
// distance D, and passes the axis at distance e. It therefore cuts off a segment of the disc at q =
// e / (D S) of the disc's radius.
double eval_beyond(const std::string& surface, bool is_mirror, double angle, double edge,
                   double distance, int samples) {
  const Vec in{std::sin(angle), 0, -std::cos(angle)};
  const Vec axis = is_mirror ? Vec{in.x, 0, -in.z} : in;
  const Vec side = cross(Vec{0, 1, 0}, axis);
  Scene scene = parse("v from 0 0 5 at 0 0 0 up 0 1 0 angle 45\n" + surface +
                      "p 4 -9 -9 0 9 -9 0 9 9 0 -9 9 0\n");
  const Vec corner = distance * axis + edge * side;
  const Vec corners[] = {corner + Vec{0, -999, 0}, corner + Vec{0, -999, 0} + 999 * side,
                         corner + Vec{0, 999, 0} + 999 * side, corner + Vec{0, 999, 0}};
  add_polygon(scene, corners);
  finish(scene);

  Params params = make_params(1000, 1000, 2);
  params.sampling.pixel_samples = samples;
  int beyond = 0;
  for (int pass = 0; pass < samples; ++pass) {
    Ray ray{.origin = -1 * in, .direction = in, .influence = {1, 1, 1}};
    ray.pass = static_cast<std::uint16_t>(pass);
    Work work;
    const auto hit = intersect(scene, ray, params.traversal, work);
    if (!hit || hit->object != 0) throw std::runtime_error("no surface");
    Children rays;
    make_children(scene, params, ray, *hit, rays, work);
    EXPECT_EQ(rays.size(), 1u);
    EXPECT_NEAR(length(rays.at(0).direction), 1, 1e-12);
    beyond += intersect(scene, rays.at(0), params.traversal, work).has_value();
  }
  return 1.0 * beyond / samples;
}

void expect_segments(const std::string& surface, bool is_mirror, double radius) {
  for (const double angle : {0.0, 0.5, 1.0})
    for (const double q : {-1.05, -0.8, -0.4, 0.0, 0.3, 0.6, 0.9, 1.05}) {
      constexpr double DISTANCE = 3;
      EXPECT_NEAR(eval_beyond(surface, is_mirror, angle, q * DISTANCE * radius, DISTANCE, 1024),
                  1 - eval_segment(q / 2), 0.012)
          << "radius " << radius << " angle " << angle << " q " << q;
    }
}

TEST(Distributed, AnEdgeInAGlossyMirror) {
  for (const double radius : {0.05, 0.2, 0.4})
    expect_segments(fmt::format("f 0 0 0 0 1 1 0 0\n# gloss {}\n", radius), true, radius);
}

TEST(Distributed, AnEdgeBehindATranslucentPlate) {
  for (const double radius : {0.05, 0.2, 0.4})
    expect_segments(fmt::format("f 0 0 0 0 0 1 1 1\n# translucent {}\n", radius), false, radius);
}

// Reflected rays that would pass through the surface are mirrored back to the side on which they
// belong.
TEST(Distributed, GlossStaysOnItsSide) {
  const Scene scene = parse(
      "v from 0 0 5 at 0 0 0 up 0 1 0 angle 45\nf 0 0 0 0 1 1 1 1.2\n# gloss 1\n# translucent 1\n"
      "p 4 -9 -9 0 9 -9 0 9 9 0 -9 9 0\n");
  Params params = make_params(10, 10, 2);
  params.sampling.pixel_samples = 400;
  for (int pass = 0; pass < 400; ++pass) {
    const Vec in = normalize({1, 0, -0.2});
    Ray ray{.origin = -1 * in, .direction = in, .influence = {1, 1, 1}};
    ray.pass = static_cast<std::uint16_t>(pass);
    Work work;
    const auto hit = intersect(scene, ray, params.traversal, work);
    ASSERT_TRUE(hit);
    Children rays;
    make_children(scene, params, ray, *hit, rays, work);
    ASSERT_EQ(rays.size(), 2u);
    EXPECT_GT(rays[0].direction.z, 0);
    EXPECT_LT(rays[1].direction.z, 0);
  }
}

// A white furnace: everything around a ray is white, and no surface absorbs light.
Scene make_white_furnace(double ks, double ior, double roughness) {
  return parse(
      fmt::format("b 1 1 1\nv from 0 0 5 at 0 0 0 up 0 1 0 angle 24\n"
                  "f 0 0 0 0 {} 1 {} {}\n# gloss {}\n# translucent {}\ns 0 0 0 1\n",
                  ks, 1 - ks, ior, roughness, roughness));
}

// The light that a ray returns, and the influence of the rays that the limit on depth removes.
struct Furnace {
  double light = 0, cut = 0;
};

void follow(const Scene& scene, const Params& params, const Ray& ray, Furnace& found) {
  Work work;
  const auto hit = intersect(scene, ray, params.traversal, work);
  found.light += eval_contribution(scene, params, ray, hit, work).g;
  if (!hit) return;
  if (ray.level >= params.limits.depth) found.cut += ray.influence.g;
  Children rays;
  make_branches(scene, params, ray, *hit, rays, work);
  for (const Ray& child : rays) follow(scene, params, child, found);
}

// The mean of 100 samples at a position on the visible disc of the sphere: 0 is its middle, 1 its
// rim.
Furnace look_at_disc(const Scene& scene, double place, int depth) {
  constexpr int SAMPLES = 100;
  Params params = make_params(10, 10, depth);
  params.sampling.pixel_samples = SAMPLES;
  params.ambient = 0;
  Furnace sum;
  for (int pass = 0; pass < SAMPLES; ++pass) {
    Ray ray{.origin = {place, 0, 5}, .direction = {0, 0, -1}, .influence = {1, 1, 1}};
    ray.pass = static_cast<std::uint16_t>(pass);
    follow(scene, params, ray, sum);
  }
  return {sum.light, sum.cut / SAMPLES};  // the light of each sample already has its weight
}

// Light is lost only at the limit on depth. Rough glass reflects a ray that cannot leave; near the
// rim, this happens many times to a few rays.
TEST(Distributed, AWhiteFurnaceOfRoughGlassIsWhite) {
  for (const double roughness : {0.0, 0.1, 0.3, 1.0})
    for (const double place : {0.0, 0.5, 0.9, 0.98, 0.999}) {
      SCOPED_TRACE(fmt::format("roughness {} at {}", roughness, place));
      for (const double ks : {0.0, 0.2}) {
        const auto thin = look_at_disc(make_white_furnace(ks, 1, roughness), place, 15);
        EXPECT_NEAR(thin.light, 1, 1e-6);
        const auto glass = look_at_disc(make_white_furnace(ks, 1.5, roughness), place, 15);
        EXPECT_NEAR(glass.light + glass.cut, 1, 1e-9);
        EXPECT_LT(glass.cut, roughness == 0 ? 1e-6 : 0.3);
      }
      EXPECT_GT(look_at_disc(make_white_furnace(0, 1.5, roughness), place, 1000).light, 0.95);
    }
}

// Only clear glass may lose totally reflected light, and only if the parameters say so.
TEST(Distributed, TotalInternalReflectionMirrorsTheTransmittedRay) {
  for (const bool is_rough : {false, true})
    for (const auto rule : {TotalReflection::mirrored, TotalReflection::lost}) {
      const Scene scene =
          parse(fmt::format("v from 0 0 -5 at 0 0 0 up 0 1 0 angle 45\nf 0 0 0 0 0 1 1 1.5\n{}"
                            "p 4 -9 -9 0 9 -9 0 9 9 0 -9 9 0\n",
                            is_rough ? "# translucent 0.1\n" : ""));
      const Vec in = normalize({1, 0, 0.2});
      Params params = make_params(10, 10, 5);
      params.total_reflection = rule;
      const Ray ray{.origin = -1 * in, .direction = in, .influence = {1, 1, 1}};
      Work work;
      const auto hit = intersect(scene, ray, params.traversal, work);
      ASSERT_TRUE(hit && hit->inside);
      Children rays;
      make_branches(scene, params, ray, *hit, rays, work);
      ASSERT_EQ(rays.size(), is_rough || rule == TotalReflection::mirrored ? 1u : 0u);
      if (rays.empty()) continue;
      EXPECT_EQ(rays[0].kind, RayKind::transmitted);
      EXPECT_EQ(rays[0].influence, ray.influence);
      EXPECT_LT(rays[0].direction.z, 0);
      if (!is_rough) {
        EXPECT_NEAR(length(rays[0].direction - Vec{in.x, in.y, -in.z}), 0, 1e-12);
      }
    }
}

// A rectangle must emit uniformly over its area, a sphere over its visible disc.
TEST(Distributed, LightsShineFromAllTheirPoints) {
  const Scene scene = parse(
      "v from 0 0 5 at 0 0 0 up 0 1 0 angle 45\nf 1 1 1 1 0 0 0 0\n"
      "p 4 -9 -9 0 9 -9 0 9 9 0 -9 9 0\n# light rect 1 2 3 0.5 0 0 0 0 0.25\n"
      "# light sphere 0 0 4 1\n");
  Params params = make_params(10, 10, 1);
  params.sampling.pixel_samples = 900;
  Vec mean;
  double square = 0;
  for (int pass = 0; pass < 900; ++pass) {
    Ray ray{.origin = {0, 0, 1}, .direction = {0, 0, -1}, .influence = {1, 1, 1}};
    ray.pass = static_cast<std::uint16_t>(pass);
    Work work;
    const auto hit = intersect(scene, ray, params.traversal, work);
    ASSERT_TRUE(hit);
    Children feelers;
    make_children(scene, params, ray, *hit, feelers, work);
    ASSERT_EQ(feelers.size(), 2u);
    const Vec on_rect = feelers[0].origin + feelers[0].reach * feelers[0].direction;
    EXPECT_NEAR(on_rect.y, 2, 1e-9);
    EXPECT_LE(std::abs(on_rect.x - 1), 0.5 + 1e-9);
    EXPECT_LE(std::abs(on_rect.z - 3), 0.25 + 1e-9);
    mean += (1.0 / 900) * on_rect;
    const Vec on_sphere = feelers[1].origin + feelers[1].reach * feelers[1].direction;
    EXPECT_NEAR(length(on_sphere - Vec{0, 0, 4}), 1, 1e-9);
    EXPECT_LE(on_sphere.z, 4 - 0.25 + 1e-9)
        << "the side that is seen: beyond its horizon it is not";
    const Vec way = feelers[1].direction;
    square += (1 - way.z) / 900;
  }
  EXPECT_LT(length(mean - Vec{1, 2, 3}), 0.005);
  // Points are uniformly distributed in solid angle: 1 - cosine is between 0 and 1 - sqrt(15 / 16),
  // and its mean is half of that maximum.
  EXPECT_NEAR(square, (1 - std::sqrt(15.0 / 16)) / 2, 1e-4);
}

}  // namespace
}  // namespace renderer::test
