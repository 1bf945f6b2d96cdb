// Tests that the rooms in experiments/scenes have the properties stated in their comments.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "renderer/radiosity/mesh/mesh.hpp"
#include "renderer/radiosity/room/check.hpp"
#include "renderer/radiosity/show/orientation.hpp"
#include "tests/renderer/radiosity/rooms.hpp"
#include "tests/support/places.hpp"

namespace radiosity::test {
namespace {

const std::string ROOMS = ::test::in_sources("experiments/scenes/");

class OurRooms : public testing::TestWithParam<const char*> {
 protected:
  std::string path() const { return ROOMS + GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(All, OurRooms,
                         testing::Values("window.room", "no-mirror.room", "mirror.room",
                                         "spot-diffuse.room", "spot-mirror.room", "furnace.room",
                                         "curved.obj", "cornell-turned.room", "cornell-tall.room"));

TEST(OurRooms, AreAllHere) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ROOMS))
    files += entry.path().extension() == ".room" || entry.path().extension() == ".obj";
  EXPECT_EQ(files, 9) << "list new rooms above";
}

TEST_P(OurRooms, HaveNoFacesThatLookTheWrongWay) {
  const Room room = load_room(path());
  EXPECT_EQ(find_turned_faces(room, make_mesh(room, {})), std::vector<std::string>());
}

TEST_P(OurRooms, HaveAsManyPatchesAsTheySay) {
  const Room room = load_room(path());
  check(room);
  std::ifstream in(path());
  std::string comment;
  for (std::string line; std::getline(in, line) && line.starts_with("#");)
    comment += line.substr(1);
  for (const int refine : {1, 10}) {
    const std::size_t patches = make_mesh(room, {.refine = refine}).patches.size();
    const std::string said = fmt::format(" {} patches", patches),
                      also = fmt::format("; {} with each", patches);
    const bool found = comment.find(refine == 1 ? said : also) != comment.npos;
    EXPECT_TRUE(found || (refine == 10 && comment.find("with each") == comment.npos))
        << comment << " But there are" << said << " at refine " << refine;
  }
}

// In the picture, no face shows its back, and nothing outside the walls is visible.
TEST_P(OurRooms, ShowTheirFrontsToTheView) {
  const Room room = load_room(path());
  const Mesh mesh = make_mesh(room, {});
  ASSERT_EQ(mesh.blockers.objects.size(), room.faces.size());
  renderer::Params params;
  params.width = room.view.width / 8;
  params.height = room.view.height / 8;
  renderer::Work work;
  std::set<std::uint32_t> seen;
  for (int y = 0; y < params.height; ++y)
    for (int x = 0; x < params.width; ++x) {
      const renderer::Ray ray = make_primary(mesh.blockers.view, params, x, y);
      const auto hit = intersect(mesh.blockers, ray, params.traversal, work);
      if (!hit) {
        EXPECT_TRUE(path().ends_with(".obj")) << "a gap at pixel " << x << " " << y;
        continue;
      }
      const Face& face = room.faces[hit->object];
      EXPECT_TRUE(face.two_sided || dot(eval_area_normal(face.corners), ray.direction) < 0)
          << face.where << " from behind at pixel " << x << " " << y;
      seen.insert(hit->object);
    }
  EXPECT_GT(seen.size(), 3u);
}

// True if the polygon is between a point of the right wall and a point of the window.
bool is_covered(const Face& polygon, const Vec& from, const Vec& to) {
  const std::vector<Vec>& c = polygon.corners;
  const Vec at = from + (c[0].x - from.x) / (to.x - from.x) * (to - from);
  return at.y > c[0].y && at.y < c[2].y && at.z > c[0].z && at.z < c[2].z;
}

// How many of 9 x 9 points of the window, which include its corners, the polygon hides from
// `point`.
int count_covered(const Face& window, const Face& polygon, const Vec& point) {
  int covered = 0;
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 8; ++j)
      covered += is_covered(polygon, point,
                            window.corners[0] + i / 8.0 * (window.corners[1] - window.corners[0]) +
                                j / 8.0 * (window.corners[3] - window.corners[0]));
  return covered;
}

TEST(WindowRoom, CreasesAreWhereTheWindowBeginsAndEndsToBeCovered) {
  const Room room = load_room(ROOMS + "window.room");
  std::set<double> across, up;
  for (const Crease& crease : room.creases) {
    EXPECT_EQ(crease.a.x, 4.5);
    EXPECT_EQ(crease.b.x, 4.5);
    if (crease.a.y == crease.b.y) across.insert(crease.a.y);
    if (crease.a.z == crease.b.z) up.insert(crease.a.z);
  }
  const std::vector<double> y(across.begin(), across.end()), z(up.begin(), up.end());
  ASSERT_EQ(y.size(), 4u);
  ASSERT_EQ(z.size(), 4u);
  const auto find = [&](const auto& holds) {
    return *std::find_if(room.faces.begin(), room.faces.end(), holds);
  };
  const Face polygon = find([](const Face& f) { return f.two_sided; });
  const Face window =
      find([&](const Face& f) { return max_component(room.materials[f.material].emission) > 0; });

  Random random{6};
  for (int i = 0; i < 20000; ++i) {
    const Vec point{4.5, random.range(0, 7), random.range(0, 3)};
    const bool penumbra = point.y > y[0] && point.y < y[3] && point.z > z[0] && point.z < z[3];
    const bool umbra = point.y > y[1] && point.y < y[2] && point.z > z[1] && point.z < z[2];
    const int covered = count_covered(window, polygon, point);
    ASSERT_EQ(covered > 0, penumbra) << point.y << " " << point.z;
    ASSERT_EQ(covered == 81, umbra) << point.y << " " << point.z;
  }
}

}  // namespace
}  // namespace radiosity::test
