// tlab convert: formats, features that are left out, and refused input.
#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

const std::string NFF =
    "# a wall and a ball\nv\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 40\nl 1 2 5\n"
    "f 1 0.5 0.25 0.7 0.2 10 0 0\n# gloss 0.1\n# translucent 0\np 3\n-1 -1 0\n1 -1 0\n0 1 0\ns 1 0 "
    "0 1\n";

struct Convert : testing::Test {
  Convert() { write_file(folder.path / "a.nff", NFF); }

  Outcome convert(const std::string& from, const std::string& to) {
    return tlab(folder.path, {"convert", from, "-o", to});
  }
  // Renders a small picture and returns its bytes.
  std::string render(const std::string& scene) {
    EXPECT_EQ(tlab(folder.path, {"render", scene, "-o", "p.png", "--size", "24x18"}).exit_code, 0);
    return read_file(folder.path / "p.png");
  }

  TemporaryFolder folder;
};

TEST_F(Convert, NamesWhatItWritesAndWhatItLeavesOut) {
  const auto done = convert("a.nff", "b.obj");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.out, "scene    b.mtl\nscene    b.obj\nleft out gloss (1), spheres (1)\n");
  EXPECT_EQ(convert("b.obj", "c.nff").out, "scene    c.nff\n");
  EXPECT_EQ(render("b.obj"), render("c.nff"));
  EXPECT_EQ(convert("spheres:5", "s.nff").exit_code, 0);
  EXPECT_EQ(render("s.nff"), render("spheres:5"));
}

TEST_F(Convert, MirrorsOfARoomComeBack) {
  write_file(
      folder.path / "m.room",
      "view from 0 0 5 at 0 0 0 up 0 1 0 angle 40 size 24 18\n"
      "material lamp reflect 0 0 0 emit 2 2 2\nmirror glass reflect 1 1 1\n"
      "quad lamp -1 2 -1  -1 2 1  1 2 1  1 2 -1\nquad glass -1 -1 0  1 -1 0  1 1 0  -1 1 0\n");
  ASSERT_EQ(convert("m.room", "m.obj").exit_code, 0);
  ASSERT_EQ(convert("m.obj", "m.nff").exit_code, 0);
  ASSERT_EQ(convert("m.nff", "n.room").exit_code, 0);
  const auto back = read_file(folder.path / "n.room");
  EXPECT_TRUE(contains(back, "reflect 1 1 1\n")) << back;
  EXPECT_TRUE(contains(back, "\nmirror ")) << back;
  EXPECT_TRUE(contains(back, "emit 2 2 2\n")) << back;
}

TEST_F(Convert, ARoomIsWrittenWhereItIs) {
  write_file(folder.path / "far.room",
             "view from 100000 0 5 at 100000 0 0 up 0 1 0 angle 40 size 24 18\n"
             "material lamp reflect 0 0 0 emit 2 2 2\n"
             "quad lamp 100000 0 0  100001 0 0  100001 1 0  100000 1 0\n");
  ASSERT_EQ(convert("far.room", "far.nff").exit_code, 0);
  EXPECT_TRUE(contains(read_file(folder.path / "far.nff"), "\n100001 1 0\n"));
}

TEST_F(Convert, ASceneInTheDarkStaysDarkAndProseStaysProse) {
  write_file(folder.path / "dark.nff",
             "# emit is said of rooms\nv from 0 0 5 at 0 0 0 up 0 1 0 angle 40\nf 1 1 1 1 0 0 0 1\n"
             "p 3\n0 0 0\n1 0 0\n0 1 0\n");
  EXPECT_EQ(convert("dark.nff", "dark.obj").out, "scene    dark.mtl\nscene    dark.obj\n");
  EXPECT_EQ(convert("dark.obj", "again.nff").out, "scene    again.nff\n");
  EXPECT_EQ(render("dark.obj"), render("dark.nff"));
  EXPECT_EQ(render("again.nff"), render("dark.nff"));
}

// The mesh has a triangle with colours at its corners, and a line; both features are left out.
TEST_F(Convert, WhatIsLeftOutOfAMeshIsNamed) {
  write_file(folder.path / "c.ply",
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
             "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
             "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
             "0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n3 0 1 2\n2 0 1\n");
  const auto done = convert("c.ply", "c.obj");
  EXPECT_TRUE(contains(done.out, "left out colours of vertices (3), lines (1)\n")) << done.out;
}

TEST_F(Convert, AMeshInCapitals) {
  write_file(folder.path / "T.STL",
             "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
             "0\nendloop\nendfacet\nendsolid t\n");
  const auto done = convert("T.STL", "t.obj");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(read_file(folder.path / "t.obj"), "f 1"));
  EXPECT_EQ(render("t.obj").substr(1, 3), "PNG");
}

// A megabyte of nested brackets overflows the stack of the library Assimp.
TEST_F(Convert, AMeshHasTimeByItsSize) {
  write_file(folder.path / "deep.gltf", std::string(1 << 20, '['));
  const auto done = convert("deep.gltf", "deep.obj");
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_TRUE(contains(done.err, "found a mesh that takes more than 21 s of CPU time, or that"))
      << done.err;
}

TEST_F(Convert, WhatIsWrongIsRefusedAndNothingIsLeft) {
  write_file(folder.path / "bad.ply", "ply\nno mesh\n");
  write_file(folder.path / "own.mtl", "newmtl mine\n");
  write_file(folder.path / "flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\n\nf 1 2 3\n");
  write_file(folder.path / "far.off", "OFF\n3 1 0\n1e20 0 0\n0 1e20 0\n0 0 1\n3 0 1 2\n");
  write_file(folder.path / "x.txt", "");
  fs::create_directory(folder.path / "d.obj");
  const auto before = folder.names();
  const std::array<const char*, 3> wrong[] = {
      {"a.nff", "b.nff", "found the same format as a.nff, expected another"},
      {"a.nff", "b.png", "found another ending, expected .nff, .obj or .room"},
      {"x.txt", "b.obj", "expected an .nff, .obj or .room file, a generator"},
      {"spheres:5", "b.room", "convert it to .obj first"},
      {"a.nff", "my scene.obj", "a name without blanks"},
      {"a.nff", "a#b.obj", "a name without blanks and without '#'"},
      {"a.nff", "A.OBJ", "found another ending, expected .nff, .obj or .room"},
      {"flat.obj", "b.nff", "flat.obj:5: found"},
      {"far.off", "b.obj", "found a vertex at 1e+20 0 0, expected coordinates up to 1e+15"},
      {"a.nff", "own.obj", "own.mtl: found this file, but no own.obj that names it"},
      {"a.nff", "d.obj", "d.obj"},
      {"bad.ply", "b.obj", "bad.ply: "},
      {"none.nff", "b.obj", "none.nff: cannot be read"},
      {"a.nff", "none/b.obj", "none"}};
  for (const auto& [from, to, expected] : wrong) {
    const auto done = convert(from, to);
    EXPECT_EQ(done.exit_code, 2) << from << to;
    EXPECT_TRUE(contains(done.err, expected)) << done.err;
    EXPECT_EQ(folder.names(), before) << to;
  }
}

}  // namespace
}  // namespace laboratory
