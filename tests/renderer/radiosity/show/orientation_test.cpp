// Tests the warnings about faces with the wrong orientation.
#include "renderer/radiosity/show/orientation.hpp"

#include <gtest/gtest.h>

#include "tests/renderer/radiosity/rooms.hpp"

namespace radiosity::test {
namespace {

std::vector<std::string> find_in(const Room& room) {
  return find_turned_faces(room, make_mesh(room, {}));
}

// A closed room of 2 x 2 x 2 with a lamp below the ceiling. The fronts of the walls are inside if
// `inside`; the lamp shines down if `down`.
Room make_box(bool inside, bool down) {
  return read_room(fmt::format("material w reflect 0.5 0.5 0.5\n"
                               "material l reflect 0 0 0 emit 1 1 1\n"
                               "box w  0 0 0  2 2 2 {}\n"
                               "quad l  {}\n"
                               "view from 1 0.1 1 at 1 2 0.8 up 0 0 1 angle 60 size 40 30\n",
                               inside ? "inside" : "",
                               down ? "0.7 0.7 1.98  0.7 1.3 1.98  1.3 1.3 1.98  1.3 0.7 1.98"
                                    : "0.7 0.7 1.98  1.3 0.7 1.98  1.3 1.3 1.98  0.7 1.3 1.98"),
                   "box.room");
}

TEST(Orientation, RoomsAsTheyShouldBeHaveNoWarning) {
  EXPECT_TRUE(find_in(make_box(true, true)).empty());
}

TEST(Orientation, ACameraThatSeesBacksIsTold) {
  const auto found = find_in(make_box(false, true));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].starts_with("100 % of the visible faces show their backs")) << found[0];
  auto room = make_box(false, true);
  for (Face& face : room.faces) face.two_sided = true;
  EXPECT_TRUE(find_in(room).empty());
}

TEST(Orientation, ALampThatShinesIntoTheCeilingIsTold) {
  const auto found = find_in(make_box(true, false));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(
      found[0].starts_with("1 lamp(s) shine into a wall or out of the room, instead of to their "
                           "other side: box.room:4;"))
      << found[0];
}

}  // namespace
}  // namespace radiosity::test
