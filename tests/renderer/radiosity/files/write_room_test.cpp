// Tests rooms that are written in other formats and read back.
#include "renderer/radiosity/files/write_room.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "renderer/files/write_nff.hpp"
#include "renderer/files/write_obj.hpp"
#include "renderer/radiosity/files/load_room.hpp"
#include "tests/renderer/support.hpp"
#include "tests/support/files.hpp"

namespace radiosity::test {
namespace {

using renderer::LeftOut;

// A lamp above boxes with random sides, a perfect mirror, and a two-sided screen.
std::string make_room_text(std::uint64_t seed) {
  renderer::test::Random random{seed};
  std::string text =
      "view from 0.1 0.2 9 at 0 0 0 up 0 1 0 angle 40 size 64 48\n"
      "material lamp reflect 0 0 0 emit 3 2.5 0.1\nmirror glass reflect 1 1 1\n"
      "quad lamp -1 5 -1  -1 5 1  1 5 1  1 5 -1\nquad glass 3 0 0  3 1 0  3 1 1  3 0 1\n";
  for (int i = 0; i < 5; ++i) {
    const auto at = random.point(3), to = at + Vec{1, 1, 1} + random.point(0.5);
    const auto [r, g, b] = random.colour();
    text += fmt::format("material m{} reflect {} {} {}\nbox m{} {} {} {} {} {} {}\n", i, r, g, b, i,
                        at.x, at.y, at.z, to.x, to.y, to.z);
  }
  const auto a = random.point(2);
  return text + fmt::format("polygon m0 {0} {1} {2}  {3} {1} {2}  {0} {4} {2} two-sided\n", a.x,
                            a.y, a.z, a.x + 1, a.y + 1);
}

// Describes the properties of a room that all formats preserve.
std::string describe(const Room& room) {
  std::string text;
  for (const Face& face : room.faces) {
    const Material& m = room.materials[face.material];
    text += fmt::format("{} {} {}:", renderer::describe(m.reflectance),
                        renderer::describe(m.emission), m.mirror);
    for (const Vec& corner : face.corners) text += " " + renderer::describe(corner);
    text += "\n";
    if (!face.two_sided) continue;
    Room back;
    back.materials = room.materials;
    back.faces = {face};
    back.faces[0].two_sided = false;
    std::ranges::reverse(back.faces[0].corners);
    text += describe(back);
  }
  return text;
}

TEST(WriteRoom, EachFormatCarriesFacesMaterialsAndView) {
  ::test::TemporaryFolder folder;
  const auto save = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder.path / name) << text;
    return (folder.path / name).string();
  };
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const Room room = read_room(make_room_text(seed), "a.room");
    LeftOut left_out;

    EXPECT_EQ(describe(read_room(to_text(room, left_out), "b.room")), describe(room));

    renderer::ObjText obj(folder.path.string(), "b.mtl");
    tell(room, obj, left_out);
    save("b.mtl", obj.library());
    const Room from_obj = load_room(save("b.obj", obj.text()));
    EXPECT_EQ(describe(from_obj), describe(room));
    EXPECT_EQ(renderer::describe_view(from_obj.view), renderer::describe_view(room.view));
    EXPECT_EQ(from_obj.materials, room.materials);

    renderer::NffText nff("");
    tell(room, nff, left_out);
    const Room from_nff = read_room(nff.text(), "b.nff");
    EXPECT_EQ(describe(from_nff), describe(room));
    EXPECT_EQ(renderer::describe_view(from_nff.view), renderer::describe_view(room.view));

    EXPECT_EQ(left_out.describe(), "");
  }
}

TEST(WriteRoom, WhatAFormatHasNoWordForIsNamed) {
  const Room room = read_room(
      "material lamp reflect 0 0 0 emit 1 1 1\nmirror dim reflect 0.5 0.5 0.5\n"
      "quad lamp 0 0 0  1 0 0  1 1 0  0 1 0 divide 2 3\nquad dim 0 0 1  1 0 1  1 1 1  0 1 1\n"
      "crease 0 0 0  1 1 0\nview from 0 0 3 at 0 0 0 up 0 1 0 angle 40 size 64 48\n",
      "a.room");
  LeftOut of_room, of_obj, of_nff;
  EXPECT_EQ(read_room(to_text(room, of_room), "b.room").creases.size(), 1u);
  EXPECT_EQ(of_room.describe(), "");
  renderer::ObjText obj("", "a.mtl");
  tell(room, obj, of_obj);
  EXPECT_EQ(of_obj.describe(), "creases (1), divisions of faces (1)");
  renderer::NffText nff("");
  tell(room, nff, of_nff);
  EXPECT_EQ(of_nff.describe(), "colours of mirrors (1), creases (1), divisions of faces (1)");
}

TEST(WriteRoom, WhatARoomHasNoWordForIsNamed) {
  const std::string view = "v from 0 0 3 at 0 0 0 up 0 1 0 angle 40\n";
  const std::string face = "p 3 0 0 0 1 0 0 0 1 0\n";
  LeftOut of_nff, of_obj;
  read_room(view + "b 1 1 1\nl 1 2 3\nf 1 1 1 0.5 0.5 9 0 1\n" + face +
                "f 1 1 1 0.5 0 0 0 1\n# emit 1 1 1\n" + face,
            "a.nff", &of_nff);
  EXPECT_EQ(of_nff.describe(), "backgrounds (1), lights (1), partial reflections (1)");
  ::test::TemporaryFolder folder;
  std::ofstream(folder.path / "m.mtl")
      << "newmtl a\nKd 0 0 0\nKe 1 1 1\nKs 1 1 1\nillum 2\nnewmtl b\nKd 0 0 0\nKs 0 0 1\nTr "
         "0.5\nillum 6\nmap_Kd b.png\n";
  read_room(
      "mtllib m.mtl\n# b 1 1 1\n# l 1 2 3\nv 0 0 0 1 0 0\nv 1 0 0 1\nv 0 1 0\nusemtl a\nf 1 2 3\n"
      "l 1 2\np 1\n",
      (folder.path / "a.obj").string(), &of_obj);
  EXPECT_EQ(of_obj.describe(),
            "backgrounds (1), colours of vertices (1), highlights without mirror reflection (1), "
            "lights (1), lines (1), partial reflections (1), pictures (1), points (1), transparent "
            "materials (1)");
}

}  // namespace
}  // namespace radiosity::test
