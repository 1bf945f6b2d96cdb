// Tests properties that a mesh must keep from its room: areas, sides, powers, and shared vertices.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/renderer/radiosity/rooms.hpp"
#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {
namespace {

double eval_area(const Face& face) { return length(eval_area_normal(face.corners)) / 2; }

TEST(Mesh, KeepsAreasAndPowers) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    Room room = make_furnished(random, 3, 2);
    room.materials = {{"wall", {0.5, 0.25, 0.125}, {}}, {"lamp", grey(0.1), {2, 3, 4}}};
    room.faces[static_cast<std::size_t>(random.below(6))].material = 1;
    double area = 0, lamp = 0;
    for (const Face& face : room.faces) {
      area += eval_area(face) * (face.two_sided ? 2 : 1);
      lamp += face.material == 1 ? eval_area(face) : 0;
    }
    const Mesh mesh = make_mesh(room, {.refine = 1 + random.below(3)});
    double sum = 0;
    for (const Patch& patch : mesh.patches) sum += patch.area;
    EXPECT_NEAR(sum, area, 1e-9 * area);
    EXPECT_NEAR(mesh.area, area, 1e-9 * area);
    EXPECT_NEAR(mesh.emitted.b, 4 * lamp, 1e-9 * area);
    const double mean = (0.25 * (area - lamp) + 0.1 * lamp) / area;
    EXPECT_NEAR(mesh.reflectance.g, mean, 1e-9);
  }
}

// The message of the error for a room whose mesh must be refused.
std::string refusal_of(const Room& room) {
  try {
    make_mesh(room, {});
  } catch (const BadInput& error) {
    return error.what();
  }
  return {};
}

// The second face alone has fewer patches than the limit; only the sum for the room exceeds it.
TEST(Mesh, TheSumOfPatchesIsCheckedBeforeAnyIsMade) {
  Room room = make_small_room();
  room.faces[0].along = 3000;
  room.faces[0].across = 2000;
  room.faces[1].along = room.faces[1].across = 2001;
  room.faces[1].where = "r.room:7";
  EXPECT_EQ(refusal_of(room),
            "r.room:7: found more than 10000000 patches, expected fewer divisions (of the room's "
            "faces, or by refine)");
}

TEST(Mesh, FacesThatTouchAreLimited) {
  Room room = make_small_room();
  const Face face = room.faces[0];
  room.faces.insert(room.faces.end(), 2000, face);
  EXPECT_NE(refusal_of(room).find("found a face in one of more than 1200200 pairs that touch"),
            std::string::npos);
}

TEST(Mesh, ManyFacesInOnePlaneAreNotComparedWithEachOther) {
  for (const int axis : {0, 1, 2}) {
    Room room = make_small_room();
    for (int i = 0; i < 3000; ++i) {
      Face& face = room.faces.emplace_back(room.faces[0]);
      for (Vec& corner : face.corners) {
        const double at[] = {corner.x, corner.y, 0};
        corner = axis == 0   ? Vec{5, at[0] + 3 * i, at[1]}
                 : axis == 1 ? Vec{at[1], 5, at[0] + 3 * i}
                             : Vec{at[0] + 3 * i, at[1], 5};
      }
    }
    EXPECT_EQ(make_mesh(room, {}).patches.size(), 3002u);
  }
}

TEST(Mesh, PatchesLookWhereTheirFaceDoes) {
  Random random{5};
  const Room room = make_furnished(random, 3, 3);
  const Mesh mesh = make_mesh(room, {});
  for (const Patch& patch : mesh.patches) {
    const Face& face = room.faces[patch.face];
    std::vector<Vec> corners;
    for (const auto v : patch.corners) {
      corners.push_back(mesh.vertices[v].at);
      EXPECT_GT(dot(mesh.vertices[v].normal, patch.normal), 1 - 1e-9);
    }
    EXPECT_GT(dot(normalize(eval_area_normal(corners)), patch.normal), 1 - 1e-9);
    const double side = dot(normalize(eval_area_normal(face.corners)), patch.normal);
    EXPECT_GT(face.two_sided ? std::abs(side) : side, 1 - 1e-9);
  }
}

// The back of a face is divided like its front, so that patches lie behind patches.
TEST(Mesh, BothSidesAreDividedAlike) {
  Room room;
  room.materials = {{"lamp", grey(0), grey(1)}};
  add_quad(room, 0, {1, 2, 3}, {1, 0, 0.5}, {0, 2, 0}, 3, 2).two_sided = true;
  const Mesh mesh = make_mesh(room, {.refine = 2});
  ASSERT_EQ(mesh.patches.size(), 2u * 6 * 4);
  for (const Patch& patch : mesh.patches)
    EXPECT_EQ(std::ranges::count_if(mesh.patches,
                                    [&](const Patch& other) {
                                      return length(other.centre - patch.centre) < 1e-12 &&
                                             dot(other.normal, patch.normal) < 0;
                                    }),
              1);
}

// The walls of a room are separate surfaces. A wall that consists of two faces is one surface if
// both have the same material.
TEST(Mesh, VerticesAreSharedWithinASurface) {
  for (const bool same : {true, false}) {
    Room room;
    room.materials = {{"wall", grey(0.5), {}}, {"lamp", grey(0), grey(1)}};
    add_box(room, 0, {0, 0, 0}, {2, 2, 2}, 4);
    EXPECT_EQ(make_mesh(room, {}).vertices.size(), 6u * 25);
    room.faces.erase(room.faces.begin());
    add_quad(room, 0, {0, 0, 0}, {1, 0, 0}, {0, 2, 0}, 2, 4);
    add_quad(room, same ? 0 : 1, {1, 0, 0}, {1, 0, 0}, {0, 2, 0}, 2, 4);
    EXPECT_EQ(make_mesh(room, {}).vertices.size(), 6u * 25 + (same ? 0 : 5));
  }
}

// The light of vertices on a border is computed slightly inside it. For all other vertices, it is
// computed at the vertex. These points must lie in the plane of the face.
TEST(Mesh, BordersAreLitInside) {
  Room room;
  room.materials = {{"wall", grey(0.5), grey(1)}};
  add_quad(room, 0, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 4, 4);
  for (const Vertex& v : make_mesh(room, {.refine = 1, .inset = 0.2}).vertices) {
    const auto expected = [](double x) { return x == 0 ? 0.025 : x == 1 ? 0.975 : x; };
    EXPECT_NEAR(v.lit.x, expected(v.at.x), 1e-12);
    EXPECT_NEAR(v.lit.y, expected(v.at.y), 1e-12);
    EXPECT_EQ(v.lit.z, 0);
  }
}

}  // namespace
}  // namespace radiosity::test
