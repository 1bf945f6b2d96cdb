// Compares pictures of radiosity with those of the path tracer. tests/reference/run compares more
// rooms.

#include <gtest/gtest.h>

#include "renderer/radiosity/creases/creases.hpp"
#include "renderer/radiosity/show/adapt.hpp"
#include "tests/reference/deviation.hpp"
#include "tests/reference/random_room.hpp"
#include "tests/reference/room_kinds.hpp"
#include "tests/renderer/radiosity/rooms.hpp"
#include "tests/support/places.hpp"

namespace radiosity::reference {
namespace {

Reference trace(const Room& room, int width, int height, int samples) {
  TracerParams params;
  params.width = width;
  params.height = height;
  params.samples = samples;
  return trace_paths(room, params);
}

constexpr int WIDTH = 40, HEIGHT = 30;

Deviation compare_room(const Room& room, int refine, Reconstruction kind, const std::string& name) {
  LightParams light;
  light.mesh.refine = refine;
  PictureParams size;
  size.width = WIDTH;
  size.height = HEIGHT;
  const Picture picture = trace_picture(light_room(room, light), {kind}, room.view, size);
  const Deviation found = compare(picture, trace(room, WIDTH, HEIGHT, 128));
  fmt::print(
      "{}, refine {}: RMSE {:.2f} %, bias {:.2f} % (noise {:.2f} %), pixels {:.2f} % (99th "
      "percentile), {:.2f} % (worst), {} together\n",
      name, refine, 100 * found.rmse, 100 * found.bias, 100 * found.noise, 100 * found.p99,
      100 * found.worst, found.group);
  EXPECT_LT(found.noise, 0.02);
  return found;
}

// A block in a room, both parallel to the axes.
constexpr const char* UPRIGHT = R"(
material wall reflect 0.7 0.6 0.5
material lamp reflect 0 0 0  emit 17 15 12
box wall  0 0 0  2 2 2  divide 4 inside
box wall  0.5 0.8 0  1.1 1.4 0.7  divide 2
quad lamp  0.7 0.75 1.98  0.7 1.25 1.98  1.3 1.25 1.98  1.3 0.75 1.98 divide 2 2
view from 1 0.02 1.75 at 0.95 1.15 0.2 up 0 0 1 angle 72 size 160 120
)";

TEST(RadiosityAgainstPathTracer, WindowRoom) {
  const Room room = load_room(::test::in_sources("experiments/scenes/window.room"));
  const Deviation found = compare_room(room, 2, Reconstruction::bicubic, "window");
  EXPECT_LT(found.rmse, 0.03);
  EXPECT_LT(std::abs(found.bias), 0.01);
  EXPECT_LT(found.p99, 0.08);
  EXPECT_LT(found.group, 12);
}

TEST(RadiosityAgainstPathTracer, UprightBox) {
  const Deviation found =
      compare_room(test::read(UPRIGHT), 2, Reconstruction::bilinear, "upright box");
  EXPECT_LT(found.rmse, 0.03);
  EXPECT_LT(std::abs(found.bias), 0.02);
  EXPECT_LT(found.p99, 0.15);
  EXPECT_LT(found.group, 12);
}

// A lamp 2 cm below a ceiling must have no dark halo, seen from below and from a corner.
TEST(RadiosityAgainstPathTracer, LampBelowACeiling) {
  Room room = test::read(R"(
material wall reflect 0.75 0.75 0.75
material lamp reflect 0 0 0  emit 15 15 15
box wall  0 0 0  2 1.6 1.4  divide 4 inside
quad lamp  0.8 0.5 1.38  0.8 1.2 1.38  1.4 1.2 1.38  1.4 0.5 1.38  divide 2 2
view from 1 0.8 0.1 at 1.05 0.85 1.4 up 0 1 0 angle 70 size 160 120
)");
  choose_creases(room, Creases::found);
  LightParams light;
  light.mesh.refine = 2;
  light.solve.tolerance = 0.01;
  AdaptedMesh adapted = make_lit_mesh(room, light);
  LitRoom lit{adapted.mesh, {}};
  const Solution solution = solve_adapted(room, adapted, light);
  lit.vertices = solution.vertices;
  add_ambient(lit.mesh, solution.ambient, lit.vertices);
  PictureParams size;
  size.width = WIDTH;
  size.height = HEIGHT;
  for (const Vec& from : {Vec{1, 0.8, 0.1}, Vec{0.2, 0.2, 0.2}}) {
    room.view.from = from;
    const Picture picture = trace_picture(lit, {Reconstruction::bicubic}, room.view, size);
    const Deviation found = compare(picture, trace(room, WIDTH, HEIGHT, 256));
    fmt::print("lamp from z = {}: RMSE {:.2f} %, {} together\n", from.z, 100 * found.rmse,
               found.group);
    EXPECT_LT(found.rmse, 0.02);
    EXPECT_LT(found.group, 3);
  }
}

TEST(RandomRooms, OfAllKindsAreClosedAndSeenFromInside) {
  for (const auto& [name, kind] : room_kinds())
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
      for (int view = 0; view < (kind == RoomKind::blocks ? 1 : ROOM_VIEWS); ++view) {
        const std::string text = make_room_of_kind(kind, seed, view);
        EXPECT_EQ(text, make_room_of_kind(kind, seed, view));
        const Reference made = trace(test::read(text), 16, 12, 8);
        const auto seen =
            std::ranges::count_if(made.faces, [](std::uint32_t face) { return face != 0; });
        const auto lit = std::ranges::count_if(
            made.picture.pixels, [](const Rgb& pixel) { return max_component(pixel) > 0; });
        EXPECT_EQ(seen, 16 * 12) << name << ' ' << seed << ' ' << view;
        EXPECT_GT(lit, 16 * 12 / 2) << name << ' ' << seed << ' ' << view;
      }
}

TEST(RandomRooms, AreClosedAndSeenFromInside) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const std::string text = make_random_room(seed);
    EXPECT_EQ(text, make_random_room(seed));
    const Reference made = trace(test::read(text), 16, 12, 8);
    for (const std::uint32_t face : made.faces) EXPECT_NE(face, 0u) << "seed " << seed;
    std::size_t lit = 0;
    for (const Rgb& pixel : made.picture.pixels) lit += max_component(pixel) > 0 ? 1 : 0;
    EXPECT_GT(lit, made.faces.size() * 9 / 10) << "seed " << seed;
  }
}

// The rays of the middle column meet the border of a face, or pass it at a distance of 0.001.
TEST(Deviation, LeavesOutRaysThatPassAnEdge) {
  constexpr int W = 5, H = 3;
  for (const double aside : {0.0, 1e-6, 1e-3}) {
    Room room;
    room.view.from = {0, 0, 0};
    room.view.at = {0, 1, 0};
    room.view.up = {0, 0, 1};
    room.view.angle = 60;
    Face face;
    face.corners = {{aside, 2, -9}, {9, 2, -9}, {9, 2, 9}, {aside, 2, 9}};
    room.faces.push_back(face);
    Reference reference;
    reference.picture = {W, H, std::vector<Rgb>(W * H)};
    reference.faces.assign(W * H, 1);
    leave_out_edges(reference, room);
    for (int i = 0; i < W * H; ++i)
      EXPECT_EQ(reference.faces[static_cast<std::size_t>(i)] == 0, i % W == 2 && aside < 1e-4)
          << i << ' ' << aside;
  }
}

TEST(Deviation, FindsGroupsBiasAndEdges) {
  // The reference shows two faces. The picture is 10 % too bright, and has a group of dark pixels.
  Reference reference;
  constexpr int W = 10, H = 8;
  reference.picture = {W, H, std::vector<Rgb>(W * H, {2, 2, 2})};
  reference.error.assign(W * H, 0);
  reference.emits.assign(W * H, false);
  for (int i = 0; i < W * H; ++i) reference.faces.push_back(i % W < 5 ? 1 : 2);
  Picture picture = reference.picture;
  for (Rgb& pixel : picture.pixels) pixel = 1.1 * pixel;
  const Deviation even = compare(picture, reference);
  EXPECT_NEAR(even.bias, 0.1, 1e-12);
  EXPECT_NEAR(even.rmse, 0.1, 1e-12);
  EXPECT_NEAR(even.p99, 0.1, 1e-12);
  EXPECT_EQ(even.group, 0);

  // changes the pixels on a diagonal
  for (const std::size_t i : {0, 11, 22, 33}) picture.pixels[i] = {1, 1, 1};
  picture.pixels[29] = {1, 1, 1};  // not a neighbour of pixel 30, which is in the next row
  picture.pixels[30] = {1, 1, 1};
  const Deviation spots = compare(picture, reference);
  EXPECT_EQ(spots.group, 4);
  EXPECT_NEAR(spots.worst, 0.5, 1e-12);
  EXPECT_NEAR(spots.edges, 0.1, 1e-12);
  picture.pixels[4] = {4, 4, 4};  // a pixel at the border between the faces
  EXPECT_NEAR(compare(picture, reference).edges, 1, 1e-12);
  EXPECT_NEAR(compare(picture, reference).worst, 0.5, 1e-12);
  // The standard error is now a quarter of the radiosity, which explains the differences.
  reference.error.assign(W * H, 0.5);
  picture.pixels[4] = {2, 2, 2};
  EXPECT_EQ(compare(picture, reference).group, 0);

  const auto inner = find_inner(reference);
  // All pixels except the columns at the border between the faces.
  EXPECT_EQ(std::ranges::count(inner, true), 8 * H);
  reference.emits[0] = true;
  EXPECT_EQ(std::ranges::count(find_inner(reference), true), 8 * H - 1);
}

}  // namespace
}  // namespace radiosity::reference
