// Tests previews by comparing them with the ray tracer, and with values calculated by hand.
#include "renderer/preview/preview.hpp"

#include <gtest/gtest.h>

#include "renderer/preview/facets.hpp"
#include "tests/renderer/support.hpp"
#include "tests/support/files.hpp"

namespace renderer::test {
namespace {

// By pixel: the number of the object that the ray from the eye hits.
std::vector<std::uint32_t> find_objects(const Scene& scene, const Params& params) {
  std::vector<std::uint32_t> objects;
  Work work;
  for (int y = 0; y < params.height; ++y)
    for (int x = 0; x < params.width; ++x) {
      const auto hit =
          intersect(scene, make_primary(scene.view, params, x, y), Traversal::nearest, work);
      objects.push_back(hit ? hit->object : NO_OBJECT);
    }
  return objects;
}

// True if one of the eight neighbours of pixel (x, y) shows another object.
bool is_at_silhouette(const std::vector<std::uint32_t>& objects, const Params& p, int x, int y) {
  const auto at = [&](int i, int j) { return objects[static_cast<std::size_t>(j * p.width + i)]; };
  for (int j = std::max(0, y - 1); j <= std::min(p.height - 1, y + 1); ++j)
    for (int i = std::max(0, x - 1); i <= std::min(p.width - 1, x + 1); ++i)
      if (at(i, j) != at(x, y)) return true;
  return false;
}

struct Compared {
  int pixels = 0, other_object = 0, off_silhouette = 0, other_sums = 0;
};

// Compares a preview with the ray-traced picture of the scene. `depth` is the number of levels of
// its shading trees.
void compare(const Scene& scene, Params params, int depth, Compared& all) {
  const Preview preview = make_preview(scene, params, PreviewStep::shadows);
  const auto objects = find_objects(scene, params);
  params.limits.depth = depth;
  const Samples traced = render(scene, params).samples;
  for (int y = 0; y < params.height; ++y)
    for (int x = 0; x < params.width; ++x) {
      const auto at = static_cast<std::size_t>(y * params.width + x);
      const bool other = preview.objects[at] != objects[at];
      ++all.pixels;
      all.other_object += other;
      all.off_silhouette += other && !is_at_silhouette(objects, params, x, y);
      all.other_sums += !other && preview.samples.sums[at] != traced.sums[at];
    }
}

constexpr PreviewStep SOLID[] = {PreviewStep::flat, PreviewStep::gouraud, PreviewStep::phong};

TEST(Preview, ShadowsAreTheRayTracersButAtSilhouettes) {
  Compared all;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Params params = make_params(60, 45, 1);
    params.sample = static_cast<SamplePosition>(seed % 3);
    compare(make_random_scene(seed, 12), params, 1, all);
  }
  EXPECT_EQ(all.other_sums, 0);
  EXPECT_LE(all.off_silhouette, all.pixels / 2000);
  EXPECT_LE(all.other_object, all.pixels / 50);
}

// The preview must not depend on the unit of length. In this scene, everything is nearer than one
// unit.
TEST(Preview, OfATinySceneIsTheRayTracersToo) {
  Compared all;
  const auto parse_scaled = [](double s) {
    return parse(
        fmt::format("v from 0 {0} {1} at 0 0 0 up 0 0 1 angle 40 resolution 60 45\nb 0.2 0.4 0.7\n"
                    "l {1} {0} {1} 1 1 1\nf 1 0.5 0.3 0.7 0.2 9 0 0\ns 0 0 0 {2}\n"
                    "c {2} 0 0 {3} {2} 0 {1} {3}\n",
                    -4 * s, 1.5 * s, 0.6 * s, 0.3 * s));
  };
  for (const double scale : {1.0, 1.0 / 64})
    compare(parse_scaled(scale), make_params(60, 45, 1), 1, all);
  EXPECT_LE(all.off_silhouette, all.pixels / 500);
  EXPECT_LE(all.other_object, all.pixels / 50);
}

TEST(Preview, WithoutMirrorsAndGlassThatIsTheWholePicture) {
  Compared all;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Scene scene = make_random_scene(seed, 12, 3);
    for (Surface& surface : scene.surfaces) surface.ks = surface.t = 0;
    compare(scene, make_params(60, 45, 1), 15, all);
  }
  EXPECT_EQ(all.other_sums, 0);
  EXPECT_LE(all.other_object, all.pixels / 50);
}

TEST(Preview, AllSolidStepsShowTheSameObjects) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Scene scene = make_random_scene(seed, 12);
    const Params params = make_params(60, 45, 1);
    const Preview shadows = make_preview(scene, params, PreviewStep::shadows);
    for (const PreviewStep step : SOLID) {
      const Preview preview = make_preview(scene, params, step);
      EXPECT_EQ(preview.objects, shadows.objects);
      EXPECT_EQ(preview.counts, shadows.counts);
      EXPECT_EQ(preview.work[Op::ray_intersected], 0u);
    }
    EXPECT_GT(shadows.work[Op::ray_intersected], 0u);
  }
}

TEST(Preview, PhongHasTheLightOfShadowsWhereNothingIsInTheWay) {
  const Scene scene = parse(
      "v from 0 0 5 at 0 0 0 up 0 1 0 angle 40 resolution 9 9\n"
      "l 1 2 5 0.5 0.5 0.5\nf 1 0.5 0.2 0.7 0.2 10 0 0\ns 0 0 0 1\n");
  const Params params = make_params(40, 40, 1);
  EXPECT_EQ(make_preview(scene, params, PreviewStep::phong).samples,
            make_preview(scene, params, PreviewStep::shadows).samples);
}

// The view of a 4 x 4 image from z = 4. With samples at the corners of pixels, the point (x, y, 0)
// is at pixel (2 + x, 2 - y).
const std::string SQUARE_VIEW =
    "v from 0 0 4 at 0 0 0 up 0 1 0 angle 53.13010235415598 resolution 4 4\n"
    "b 0 0 0.5\n";

Params make_centred() {
  Params params = make_params(4, 4, 1);
  params.sample = SamplePosition::center;
  return params;
}

// One colour component of all pixels as text, arranged as in the image.
std::string show(const Preview& preview, double Rgb::*colour) {
  std::string text;
  for (std::uint32_t i = 0; i < preview.samples.sums.size(); ++i) {
    text += fmt::format("{:.3g}", preview.samples.get(i).*colour);
    text += (i + 1) % std::uint32_t(preview.samples.width) == 0 ? "\n" : " ";
  }
  return text;
}

TEST(Preview, FlatHasTheColourOfTheMiddle) {
  // The light is at a distance of 2 in front of the square's middle. The ambient part is ka * Ia =
  // 0.1 * 0.5.
  const Scene scene = parse(SQUARE_VIEW +
                            "l 0 0 2 0.8 0.8 0.8\nf 1 0 0 0.5 0 0 0 0\n"
                            "p 4 -1 -1 0 1 -1 0 1 1 0 -1 1 0\n");
  const Preview preview = make_preview(scene, make_centred(), PreviewStep::flat);
  EXPECT_EQ(show(preview, &Rgb::r), "0 0 0 0\n0 0.45 0.45 0\n0 0.45 0.45 0\n0 0 0 0\n");
  EXPECT_EQ(show(preview, &Rgb::b), "0.5 0.5 0.5 0.5\n0.5 0 0 0.5\n0.5 0 0 0.5\n0.5 0.5 0.5 0.5\n");
  EXPECT_EQ(preview.counts, (PreviewCounts{4, 1, 4, 4}));
  EXPECT_EQ(preview.work[Op::feeler_made], 1u);
}

// The eye is not in front of the square, but where the square's middle mirrors the light.
TEST(Preview, HighlightsAreWhereTheyAreSeenFromTheEye) {
  const Scene scene = parse(SQUARE_VIEW +
                            "l 2 0 4 0.8 0.8 0.8\nf 1 0 0 0 0.5 20 0 0\n"
                            "p 4 0 -1 0 2 -1 0 2 1 0 0 1 0\n");
  const Preview preview = make_preview(scene, make_centred(), PreviewStep::flat);
  EXPECT_EQ(show(preview, &Rgb::r), "0 0 0 0\n0 0 0.4 0.4\n0 0 0.4 0.4\n0 0 0 0\n");
}

TEST(Preview, GouraudInterpolatesTheColoursOfCorners) {
  // The light is above the middle of the square's left edge, at a height equal to the distance of
  // the corners.
  const Scene scene = parse(SQUARE_VIEW +
                            "l -1 0 1 1 1 1\nf 1 0.5 0.25 1 0 0 0 0\n"
                            "p 4 -1 -1 0 1 -1 0 1 1 0 -1 1 0\n");
  const Preview preview = make_preview(scene, make_centred(), PreviewStep::gouraud);
  // The diffuse part is cos = 1 / distance. The distance is sqrt(2) to the left corners and sqrt(6)
  // to the right ones. The ambient part is 0.1.
  const double left = 0.1 + 1 / std::sqrt(2), right = 0.1 + 1 / std::sqrt(6);
  for (const std::uint32_t y : {1u, 2u}) {
    EXPECT_NEAR(preview.samples.get(4 * y + 1).r, 0.75 * left + 0.25 * right, 1e-9);
    EXPECT_NEAR(preview.samples.get(4 * y + 2).r, 0.25 * left + 0.75 * right, 1e-9);
    const Rgb shown = preview.samples.get(4 * y + 2);
    EXPECT_NEAR(shown.g, shown.r / 2, 1e-9);
    EXPECT_NEAR(shown.b, shown.r / 4, 1e-9);
  }
  EXPECT_EQ(preview.work[Op::feeler_made], 4u);
}

TEST(Preview, PointsAreTheCornersAndFade) {
  // At the farthest point, a quarter of the colour remains; the rest is the background's.
  const Scene scene = parse(SQUARE_VIEW + "f 1 0 0 1 0 0 0 0\np 3 -1 -1 0 1 -1 0 -2 2 -4\n");
  const Preview preview = make_preview(scene, make_params(4, 4, 1), PreviewStep::points);
  EXPECT_EQ(show(preview, &Rgb::r), "0 0 0 0\n0 0.25 0 0\n0 0 0 0\n0 1 0 1\n");
  EXPECT_EQ(preview.counts, (PreviewCounts{3, 0, 3, 3}));
}

TEST(Preview, PointsFadeOnlyWhereOthersAreNearer) {
  const auto red = [](const std::string& triangle) {
    const Scene scene = parse(SQUARE_VIEW + "f 1 0 0 1 0 0 0 0\n" + triangle);
    return show(make_preview(scene, make_params(4, 4, 1), PreviewStep::points), &Rgb::r);
  };
  // The first triangle has one corner in the image. The second has two, one of which is half a unit
  // farther away.
  EXPECT_EQ(red("p 3 -1 -1 0 50 -1 0 -1 50 0\n"), "0 0 0 0\n0 0 0 0\n0 0 0 0\n0 1 0 0\n");
  EXPECT_EQ(red("p 3 -1 -1 0 1.125 -1.125 -0.5 -1 50 0\n"),
            "0 0 0 0\n0 0 0 0\n0 0 0 0\n0 1 0 0.25\n");
}

TEST(Preview, EdgesAreThoseThatNothingHides) {
  const std::string back = "f 1 0 0 1 0 0 0 0\np 4 -2 -2 0 2 -2 0 2 2 0 -2 2 0\n";
  // A green wall at half the distance hides the rightmost column. Red pixels belong to the square
  // behind it.
  const std::string front = "f 0 1 0 1 0 0 0 0\np 4 0.25 -9 2 9 -9 2 9 9 2 0.25 9 2\n";
  const Params params = make_params(4, 4, 1);
  const auto red = [&](const std::string& objects) {
    return show(make_preview(parse(SQUARE_VIEW + objects), params, PreviewStep::edges), &Rgb::r);
  };
  // (The right and lower edges are outside the image, because its last samples are at 1.)
  EXPECT_EQ(red(back), "1 1 1 1\n1 0 0 0\n1 0 0 0\n1 0 0 0\n");
  EXPECT_EQ(red(back + front), "0.25 0.25 0.25 0\n0.25 0 0 0\n0.25 0 0 0\n0.25 0 0 0\n");
}

TEST(Preview, OfAnAreaIsThatPartOfTheWhole) {
  for (const auto& [name, step] : preview_steps()) {
    // points and edges fade with distance
    if (step == PreviewStep::points || step == PreviewStep::edges) continue;
    SCOPED_TRACE(name);
    const Scene scene = make_random_scene(7, 12);
    Params params = make_params(30, 20, 1);
    const Preview whole = make_preview(scene, params, step);
    params.area = {5, 6, 11, 9};
    const Preview part = make_preview(scene, params, step);
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 30; ++x) {
        const auto at = static_cast<std::size_t>(y * 30 + x);
        const bool inside = x >= 5 && x < 16 && y >= 6 && y < 15;
        EXPECT_EQ(part.samples.sums[at], inside ? whole.samples.sums[at] : Samples::Sums{});
        EXPECT_EQ(part.objects[at], inside ? whole.objects[at] : NO_OBJECT);
      }
  }
}

TEST(Preview, FromWithinASphereAndACylinder) {
  const Scene scene = parse(
      "v from 0.2 0.1 0 at 0 0 -1 up 0 1 0 angle 80 resolution 9 9\n"
      "l 0 0.5 0 1 1 1\nf 1 0.5 0.2 0.7 0 0 0 0\ns 0 0 0 5\nc 0 0 2 1 0 0 -2 1\n");
  Compared all;
  compare(scene, make_params(50, 50, 1), 1, all);
  EXPECT_EQ(all.other_sums, 0);
  EXPECT_EQ(all.off_silhouette, 0);
  EXPECT_LE(all.other_object, 60);  // rays near the cylinder's far rim may hit another object
}

TEST(Preview, NamesWhatIsWrong) {
  const Scene scene = make_random_scene(1, 1);
  EXPECT_EQ(::test::message_of<base::BadInput>(
                [&] { make_preview(scene, make_params(0, 5, 1), PreviewStep::flat); }),
            "size: found 0 x 5, expected 1 to 65536 pixels on each side");
}

// Projects a point of the scene onto the image; the result is in pixels.
std::pair<double, double> project(const Scene& scene, const Raster& raster, const Vec& point) {
  const Vec way = point - scene.view.from;
  const double scale = 1 / (dot(way, scene.view.ahead) * raster.step);
  return {raster.left + dot(way, scene.view.right) * scale,
          raster.top - dot(way, scene.view.above) * scale};
}

// The object is curved in two directions; each may contribute a quarter of a pixel.
TEST(Facets, AreOffTheirObjectByHalfAPixelAtMost) {
  double most_of_cylinder = 0, most_of_sphere = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    Scene scene;
    scene.view.from = {0, 0, 6};
    scene.surfaces.push_back({});
    // Some cylinders are so near that their surface is much nearer to the eye than their axis.
    const bool is_sphere = seed % 2, is_near = seed % 8 == 2;
    const double radius = random.range(is_near ? 0.5 : 0.01, 2), turn = random.range(0, 0.3);
    // Some cylinders are parallel to a coordinate axis. The result must be right for all three
    // axes.
    const Vec axes[] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
    Vec base = random.point(1.5), axis = random.direction();
    if (seed % 4 == 0) axis = axes[seed / 4 % 3];
    if (is_near) {
      base = {0, 0, 6 - 2.5 * radius};
      axis = {std::sin(turn), std::cos(turn), 0};
    }
    if (is_sphere)
      add_sphere(scene, base, radius);
    else
      add_cone(scene, base, radius, base + axis, radius);
    finish(scene);
    const Params params = make_params(400, 300, 1);
    const Raster raster = make_raster(scene.view, params);
    Facets facets;
    make_facets(scene, scene.objects[0], params, Fineness::silhouette, facets);
    EXPECT_GE(facets.ends.size(), 4u);
    std::uint32_t first = 0;
    for (const auto end : facets.ends) {
      Vec middle;
      for (std::uint32_t i = first; i < end; ++i)
        middle += (1.0 / (end - first)) * facets.corners[facets.indices[i]].at;
      first = end;
      const double along = is_sphere ? 0 : dot(middle - base, axis);
      const Vec foot = base + along * axis;
      const double inside = radius - length(middle - foot);
      EXPECT_GE(inside, -1e-6 * radius);
      const auto [x, y] = project(scene, raster, middle);
      const auto [u, v] = project(scene, raster, foot + radius * normalize(middle - foot));
      double& most = is_sphere ? most_of_sphere : most_of_cylinder;
      if (x >= 0 && x < 400 && y >= 0 && y < 300) most = std::max(most, std::hypot(x - u, y - v));
    }
  }
  EXPECT_LE(most_of_sphere, 0.5);
  EXPECT_LE(most_of_cylinder, 0.25);
  EXPECT_GE(most_of_sphere, 0.2);  // the tessellation must not be finer than necessary
  EXPECT_GE(most_of_cylinder, 0.1);
}

// The distance from pole to pole along the surface is half of the circumference.
TEST(Facets, OfASphereAreNoHigherThanWide) {
  int odd = 0;
  for (int i = 1; i <= 100; ++i) {
    SCOPED_TRACE(testing::Message() << "radius " << 0.02 * i);
    Scene scene;
    scene.view.from = {0, 0, 6};
    scene.surfaces.push_back({});
    add_sphere(scene, {}, 0.02 * i);
    finish(scene);
    Facets facets;
    make_facets(scene, scene.objects[0], make_params(400, 300, 1), Fineness::silhouette, facets);
    // each facet at a pole begins with the pole's corner
    const auto around = std::ranges::count(facets.indices, 0u);
    ASSERT_GE(around, 4);
    ASSERT_EQ(std::ssize(facets.ends) % around, 0);
    const auto bands = std::ssize(facets.ends) / around;
    EXPECT_GE(2 * bands, around);
    EXPECT_LE(2 * bands, around + 1);
    odd += around % 2;
  }
  EXPECT_GT(odd, 20);
}

}  // namespace
}  // namespace renderer::test
