// Warnings about OBJ files: one line for each kind of feature that is left out, with the place
// where it first occurs.
#include <algorithm>

#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

const std::string OBJ =
    "mtllib m.mtl\nusemtl red\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\nf 1 2\nl 1 2\n"
    "usemtl None\nf 3 2 1\nf 3 1 2\n";
const std::string BAD_FACES =
    "s.obj:7: found '4', expected the number of a readable vertex (v): 1 to 3, or -1 to -3 counted "
    "back from this line; left out faces (2)\n";
const std::string GREY_FACES =
    "s.obj:10: found the material 'None', expected one of the libraries: 'red'; faces in light "
    "grey (2)\n";

struct SceneWarnings : testing::Test {
  SceneWarnings() {
    write_file(folder.path / "s.obj", OBJ);
    write_file(folder.path / "m.mtl", "newmtl red\nKd 0.9 0 0\nKe 1 1 1\n");
  }

  // Runs a command, which must succeed, and returns what it writes to standard error.
  std::string warnings_of(const std::vector<std::string>& arguments) {
    const auto done = tlab(folder.path, arguments);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    out = done.out;
    return done.err;
  }

  TemporaryFolder folder;
  std::string out;
};

TEST_F(SceneWarnings, OneLineForEachKind) {
  const auto warning = [](const std::string& text) { return "tlab: warning: " + text; };
  const auto of_files = warning(BAD_FACES) + warning(GREY_FACES);
  const auto all = of_files + warning("s.obj: left out lines (1)\n");
  EXPECT_EQ(warnings_of({"render", "s.obj", "-o", "a.png", "--size", "8x8"}), all);
  EXPECT_EQ(warnings_of({"render", "s.obj", "-o", "a.png", "--size", "8x8", "--preview", "phong"}),
            all);
  EXPECT_EQ(warnings_of({"render", "s.obj", "-o", "a.png", "--size", "8x8", "--frames", "0-1"}),
            all);
  // Radiosity warns also of the light that leaves the room, because the room is open.
  EXPECT_TRUE(warnings_of({"radiosity", "s.obj", "-o", "a.png", "--size", "8x8"}).starts_with(all));
  EXPECT_EQ(warnings_of({"convert", "s.obj", "-o", "a.nff"}), of_files);
  EXPECT_EQ(out, "scene    a.nff\nleft out faces (2), lines (1)\n");
  EXPECT_EQ(warnings_of({"convert", "s.obj", "-o", "a.room"}), of_files);
}

TEST_F(SceneWarnings, AnExperimentWarnsOnceForAllItsPoints) {
  write_file(folder.path / "e.toml",
             "[scene]\nsource = \"s.obj\"\n[image]\nwidth = 8\nheight = 8\n"
             "[sweep]\nworkers = [1, 2]\n");
  const auto errors = warnings_of({"run", "e.toml", "-o", "results"});
  const auto first = errors.find("s.obj:7: ");
  ASSERT_NE(first, errors.npos) << errors;
  EXPECT_EQ(errors.find("s.obj:7: ", first + 1), errors.npos) << errors;
}

}  // namespace
}  // namespace laboratory
