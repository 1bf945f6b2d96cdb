// Compares pictures of the second pass with known illumination, and pictures of the z-buffer with
// those of the second pass.
#include "renderer/radiosity/show/picture.hpp"

#include <gtest/gtest.h>

#include "tests/renderer/radiosity/show/pictures.hpp"

namespace radiosity::test {
namespace {

const PictureParams SMALL{40, 30, 1, 8};

Picture trace(const Room& room, const Mesh& mesh, const PictureParams& params = SMALL,
              Reconstruction kind = Reconstruction::bilinear) {
  renderer::Work work;
  return trace_picture(mesh, make_illumination(mesh, make_linear(mesh), kind), room.view, params,
                       work);
}

TEST(TracePicture, EveryPixelHasWhatItsRayMeets) {
  const Room room = make_cube(5);
  const Mesh mesh = make_mesh(room, {});
  const Picture picture = trace(room, mesh);
  ASSERT_EQ(picture.pixels.size(), 40u * 30u);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) {
      const Vec way = eval_way(room.view, SMALL, x, y);
      const Vec point = room.view.from + eval_reach(room.view.from, way) * way;
      EXPECT_LT(distance(picture.pixels[static_cast<std::size_t>(y * 40 + x)], eval_linear(point)),
                1e-9)
          << x << ", " << y;
    }
}

// Patches reproduce a linear radiosity exactly, so that the picture must not depend on the mesh.
TEST(TracePicture, DoesNotDependOnTheMesh) {
  Room room = make_furnished_cube(1);
  const Picture coarse = trace(room, make_mesh(room, {1}));
  const Picture fine = trace(room, make_mesh(room, {6}));
  room.creases = {{{0.1, 0, 0.15}, {0.8, 0, 0.9}}, {{0.2, 0, 0.1}, {0.9, 0, 0.3}}};
  const Picture creased = trace(room, make_mesh(room, {3}));
  for (std::size_t i = 0; i < coarse.pixels.size(); ++i) {
    EXPECT_LT(distance(coarse.pixels[i], fine.pixels[i]), 1e-9) << i;
    EXPECT_LT(distance(coarse.pixels[i], creased.pixels[i]), 1e-9) << i;
  }
}

// The mirror at x = 1 shows at x what is at 2 - x. Two facing mirrors reflect a ray many times.
TEST(TracePicture, MirrorsShowTheMirroredRoom) {
  Room room = make_cube(3);
  room.view.at = {1, 0.4, 0.2};
  room.faces[1].material = 1;
  for (const bool both : {false, true}) {
    room.faces[0].material = both ? 1 : 0;
    const Mesh mesh = make_mesh(room, {});
    for (const int depth : {0, 1, 2, 100}) {
      PictureParams params = SMALL;
      params.depth = depth;
      renderer::Work work;
      const Picture picture =
          trace_picture(mesh, make_illumination(mesh, make_linear(mesh)), room.view, params, work);
      std::uint64_t reflected = 0;
      for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
          Vec at = room.view.from, way = eval_way(room.view, params, x, y);
          Rgb expected{1, 1, 1};
          for (int met = 0;; ++met) {
            at += eval_reach(at, way) * way;
            const bool mirror = at.x > 1 - 1e-12 || (both && at.x < 1e-12);
            if (mirror && met == depth) expected = {};
            if (!mirror || met == depth) break;
            ++reflected;
            expected = expected * room.materials[1].reflectance;
            way.x = -way.x;
          }
          EXPECT_LT(distance(picture.pixels[static_cast<std::size_t>(y * 40 + x)],
                             expected * eval_linear(at)),
                    1e-9)
              << x << ", " << y << " depth " << depth;
        }
      EXPECT_EQ(work[renderer::Op::ray_reflected], reflected);
      EXPECT_EQ(work[renderer::Op::sample_updated], 40u * 30u);
    }
  }
}

TEST(TracePicture, BacksAreBlackAndHideUnlessThereIsASecondFace) {
  for (const int what : {0, 1, 2, 3}) {
    Room room = make_cube(2);
    room.view = {{0.5, 0.5, 0.9}, {0.5, 0.5, 0}, {0, 1, 0}, 60, 0, 8, 8};
    // A quad that faces away from the eye, almost perpendicular to the view. It is slightly
    // slanted, so that rounding matters.
    const std::vector<Vec> front = {
        {0, 0.01, 0.3}, {0.02, 1, 0.41}, {1, 0.99, 0.43}, {0.98, 0, 0.32}};
    const Vec n = normalize(eval_area_normal(front));
    std::vector<Vec> flat = front;
    flat[3] = flat[3] - dot(n, flat[3] - flat[0]) * n;
    flat[2] = flat[2] - dot(n, flat[2] - flat[0]) * n;
    flat[1] = flat[1] - dot(n, flat[1] - flat[0]) * n;
    std::vector<Vec> turned(flat.rbegin(), flat.rend());
    std::ranges::rotate(turned, turned.begin() + what);
    room.faces.push_back(make_face(flat, 3, 4));
    if (what == 1) room.faces.back().two_sided = true;
    if (what >= 2) room.faces.push_back(make_face(turned, 5, 2));
    if (what == 3) std::swap(room.faces[6], room.faces[7]);
    const Mesh mesh = make_mesh(room, {});
    const PictureParams params{8, 8, 1, 1};
    const Picture picture = trace(room, mesh, params);
    const Picture preview =
        preview_picture(mesh, make_illumination(mesh, make_linear(mesh)), room.view, params);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        const Vec way = eval_way(room.view, params, x, y);
        const Vec point = room.view.from + dot(flat[0] - room.view.from, n) / dot(way, n) * way;
        const Rgb expected = what == 0 ? Rgb{} : eval_linear(point);
        const auto i = static_cast<std::size_t>(y * 8 + x);
        EXPECT_LT(distance(picture.pixels[i], expected), 1e-9) << what << ": " << x << ", " << y;
        EXPECT_LT(distance(preview.pixels[i], expected), 1e-2) << what << ": " << x << ", " << y;
      }
  }
}

TEST(TracePicture, SamplesAreTheMeanOfAFinerPicture) {
  const Room room = make_furnished_cube(2);
  const Mesh mesh = make_mesh(room, {});
  const Picture whole = trace(room, mesh, {12, 9, 3, 8}), fine = trace(room, mesh, {36, 27, 1, 8});
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 12; ++x) {
      Rgb sum;
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          sum += fine.pixels[static_cast<std::size_t>((3 * y + j) * 36 + 3 * x + i)];
      EXPECT_LT(distance(whole.pixels[static_cast<std::size_t>(y * 12 + x)], 1.0 / 9 * sum), 1e-12);
    }
}

TEST(TracePicture, ImpossibleParametersAreErrors) {
  for (const PictureParams& bad :
       {PictureParams{-1, 5, 1, 1}, PictureParams{5, 70000, 1, 1}, PictureParams{5, 5, 0, 1},
        PictureParams{5, 5, 65, 1}, PictureParams{5, 5, 1, -1}, PictureParams{5, 5, 1, 1001}})
    EXPECT_THROW(check(bad), base::BadInput);
  check(PictureParams{});
  EXPECT_THROW(renderer::make_image_plane({{1, 2, 3}, {1, 2, 3}}), base::BadInput);
}

// Both pictures have the same sample points. Pixels may differ only where rounding decides which of
// two faces is hit.
TEST(PreviewPicture, IsTheTracedPicture) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Random random{seed};
    Room room = make_cube(3);
    // Keeps the object inside the cube. If it crossed a wall, the wall would have patches that are
    // not parallelograms.
    const Vec a = random.point(0.08) + Vec{0.5, 0.5, 0.5};
    const Vec b = 0.2 * random.direction(), c = 0.2 * random.direction();
    room.faces.push_back(make_face({a, a + b, a + b + c, a + c}, 4, 5));
    room.faces.back().two_sided = seed % 2 == 0;
    room.view.from = random.point(0.4) + Vec{0.5, 0.5, 0.5};
    room.view.at = random.point(0.4) + Vec{0.5, 0.5, 0.5};
    room.view.angle = random.range(20, 140);
    const Mesh mesh = make_mesh(room, {2});
    std::vector<Rgb> values;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) values.push_back(random.colour());
    for (const auto kind :
         {Reconstruction::flat, Reconstruction::bilinear, Reconstruction::bicubic}) {
      const Illumination light = make_illumination(mesh, values, kind);
      renderer::Work work;
      const PictureParams params{64, 48, 1, 8};
      const Picture traced = trace_picture(mesh, light, room.view, params, work);
      const Picture seen = preview_picture(mesh, light, room.view, params);
      int differ = 0;
      for (std::size_t i = 0; i < traced.pixels.size(); ++i)
        differ += distance(traced.pixels[i], seen.pixels[i]) > 1e-6;
      EXPECT_LE(differ, 3) << "seed " << seed;
    }
  }
}

// The room is seen from outside, and has corners behind the eye.
TEST(PreviewPicture, MirrorsAreAsGreyAsTheRoom) {
  Room room = make_cube(4);
  room.faces[4].material = 1;
  room.view = {{0.5, 0.5, 0.9}, {0.5, 0.5, 0}, {0, 1, 0}, 30, 0, 8, 8};
  const Mesh mesh = make_mesh(room, {});
  const std::vector<Rgb> values(mesh.vertices.size(), Rgb{1, 2, 6});
  const Picture picture = preview_picture(mesh, make_illumination(mesh, values), room.view, {8, 8});
  for (const Rgb& pixel : picture.pixels) EXPECT_LT(distance(pixel, {3, 3, 3}), 1e-12);
  room.view.from = {0.5, 0.5, -1};
  const Picture behind = preview_picture(mesh, make_illumination(mesh, values), room.view, {8, 8});
  EXPECT_EQ(behind.pixels[8 * 4 + 4], Rgb{});
}

}  // namespace
}  // namespace radiosity::test
