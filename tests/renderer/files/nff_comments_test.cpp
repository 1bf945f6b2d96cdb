// Tests the statements in comments that extend NFF.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

const std::string COMMENTED_VIEW =
    "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nhither 1\nresolution 4 3\n";
const std::string COMMENTED_SURFACE = "f 1 0.5 0.25 0.6 0.3 20 0.1 1.5\n";

// A folder with an NFF file and the other files that it names.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "tlab-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("cannot make " + name);
    path_ = name;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string write(const std::string& name, const std::string& text) const {
    const auto path = path_ / name;
    std::ofstream(path) << text;
    return path.string();
  }

 private:
  std::filesystem::path path_;
};

template <class Action>
std::string get_error(const Action& action) {
  try {
    action();
  } catch (const base::BadInput& bad) {
    return bad.what();
  }
  return "nothing";
}

TEST(NffComments, EveryStatement) {
  const Scene scene =
      parse_scene("# lens 0.25 7\n#shutter 0.5 2 # frames\n" + COMMENTED_VIEW + COMMENTED_SURFACE +
                      "s 0 0 0 1\n  # gloss 0.1\ns 1 0 0 1\n# translucent 0.2\n"
                      "# move 1 0 -2\ns 2 0 0 1\n# move 0 0 0\n" +
                      COMMENTED_SURFACE +
                      "# translucent 1\n# gloss 0\ns 3 0 0 1\n"
                      "# light rect 1 2 3 4 0 0 0 5 0\n"
                      "# light sphere 6 7 8 0.5 0.25 0.5 1\nl 0 9 0\n",
                  "test.nff", 10);
  EXPECT_EQ(scene.view.lens.aperture, 0.25);
  EXPECT_EQ(scene.view.lens.focus, 7);
  ASSERT_EQ(scene.surfaces.size(), 4u);
  EXPECT_EQ(scene.surfaces[0].gloss, 0);
  EXPECT_EQ(scene.surfaces[1].gloss, 0.1);
  EXPECT_EQ(scene.surfaces[1].colour, scene.surfaces[0].colour);
  EXPECT_EQ(scene.surfaces[2].gloss, 0.1);
  EXPECT_EQ(scene.surfaces[2].translucency, 0.2);
  EXPECT_EQ(scene.surfaces[3].translucency, 1) << "no object had it without";
  ASSERT_EQ(scene.moves.size(), 4u);
  EXPECT_EQ(scene.moves[2], (Vec{1.5, 0, -3}));
  EXPECT_EQ(scene.moves[1], Vec{});
  EXPECT_EQ(scene.moves[3], Vec{});
  std::vector<Vec> centres(4);
  for (const Sphere& s : scene.spheres) {
    centres[s.tag.object] = s.centre;
    EXPECT_EQ(s.tag.surface, s.tag.object);
  }
  EXPECT_EQ(centres[2], (Vec{2 + 10.5, 0, -2 * 10.5})) << "where it is at frame 10 + 0.5";
  EXPECT_EQ(centres[3], (Vec{3, 0, 0}));
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].shape, LightShape::rectangle);
  EXPECT_EQ(scene.lights[0].u, (Vec{4, 0, 0}));
  EXPECT_EQ(scene.lights[0].v, (Vec{0, 5, 0}));
  EXPECT_EQ(scene.lights[0].intensity.g, 1 / std::sqrt(3.0)) << "the SPD's share";
  EXPECT_EQ(scene.lights[1].shape, LightShape::sphere);
  EXPECT_EQ(scene.lights[1].radius, 0.5);
  EXPECT_EQ(scene.lights[1].intensity, (Rgb{0.25, 0.5, 1}));
  EXPECT_EQ(scene.lights[2].shape, LightShape::point);
}

TEST(NffComments, EveryKindOfObjectMoves) {
  const std::string objects =
      "s 0 0 0 1\np 3 0 0 0 1 0 0.2 0 1 0.1\npp 3 0 0 1 0 0 1 1 0 1 0 0 1 0 1 1 0 1 1\n"
      "c 0 0 0 1 0 0 1 0.5\n";
  const Scene still = parse(COMMENTED_VIEW + COMMENTED_SURFACE + objects);
  const Scene moved =
      parse_scene(COMMENTED_VIEW + COMMENTED_SURFACE + "# move 1 2 3\n" + objects, "test.nff", 2);
  EXPECT_TRUE(moved.moves.empty()) << "without a shutter nothing moves within a frame";
  Random random{1};
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    Ray ray{.origin = random.point(2), .direction = random.direction(), .influence = {}};
    Work work;
    const auto expected = intersect(still, ray, Traversal::nearest, work);
    ray.origin += Vec{2, 4, 6};
    const auto hit = intersect(moved, ray, Traversal::nearest, work);
    ASSERT_EQ(hit.has_value(), expected.has_value()) << "ray " << i;
    if (!hit) continue;
    ++hits;
    ASSERT_EQ(hit->object, expected->object);
    ASSERT_NEAR(hit->distance, expected->distance, 1e-9);
    ASSERT_LT(length(hit->normal - expected->normal), 1e-9);
  }
  EXPECT_GT(hits, 200);
}

// Comments that begin like statements but are prose. Such comments occur in older files.
TEST(NffComments, ProseIsNoStatement) {
  const Scene plain = parse(COMMENTED_VIEW + COMMENTED_SURFACE + "s 0 0 0 1\nl 1 1 1\n");
  const Scene scene =
      parse("# lens\n# lens of glass\n# lenses 1 2\n# light comes from the left\n# light\n" +
            COMMENTED_VIEW +
            "# light sphere in the corner\n# light rectangle 1 2 3\n# camera 1, seen from above\n"
            "# camera\n# path to the door\n# path door.nff\n# path here.txt is not used\n" +
            COMMENTED_SURFACE +
            "# gloss, none\n# translucent\n# shutter closed\n# move it later\n"
            "## move 1 0 0\ns 0 0 0 1 # move it\n# a # move 1 0 0\nl 1 1 1 # lens of glass\n"
            "# emit 1 1 1\n# gloss cm\n");
  EXPECT_EQ(scene.view.lens.aperture, 0);
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.surfaces.size(), 1u);
  EXPECT_TRUE(scene.moves.empty());
  EXPECT_EQ(render(scene, make_params(9, 9, 3)).samples,
            render(plain, make_params(9, 9, 3)).samples);
}

struct WrongComment {
  std::string text;   // file content after the view (7 lines) and the surface (line 8)
  std::string error;  // expected message, after "test.nff:"
};
class NffCommentsWrong : public testing::TestWithParam<WrongComment> {};

TEST_P(NffCommentsWrong, IsRejectedWithItsLine) {
  const std::string found = get_error([] {
                              parse(COMMENTED_VIEW + COMMENTED_SURFACE + GetParam().text);
                            }).substr(0, 9 + GetParam().error.size());
  EXPECT_EQ(found, "test.nff:" + GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(
    Table, NffCommentsWrong,
    testing::Values(
        WrongComment{"# lens 1",
                     "9: found the end of the line, expected the lens's focal distance"},
        WrongComment{"# lens 1\n2",
                     "9: found the end of the line, expected the lens's focal distance"},
        WrongComment{"# lens -1 2", "9: found '-1', expected the lens's aperture"},
        WrongComment{"# lens 1 0", "9: found '0', expected the lens's focal distance"},
        WrongComment{"# lens 1 1e-300", "9: found '1e-300', expected the lens's focal distance"},
        WrongComment{"# gloss 10cm", "9: found '10cm', expected the radius of a disc"},
        WrongComment{"# lens 1 2 3", "9: found '3', expected the end of the line"},
        WrongComment{"# lens 1 2\n\n# lens 1 2",
                     "11: found a second '# lens', expected only that of line 9"},
        WrongComment{
            "# shutter 1 0.5",
            "9: found '0.5', expected the closing time in frames (a number from 1 to 1e+06)"},
        WrongComment{"# shutter -1 0.5", "9: found '-1', expected the opening time in frames"},
        WrongComment{"# shutter 0 1\n# shutter 0 1", "10: found a second '# shutter'"},
        WrongComment{"# move 1 2", "9: found the end of the line, expected a velocity"},
        WrongComment{"# move 3 objects", "9: found 'objects', expected a velocity"},
        WrongComment{"# shutter 0 1e6\n# move 1e12 0 0\ns 0 0 0 1",
                     "10: found a displacement of 1e+18, expected at most 1e+15"},
        WrongComment{"# gloss 1.5",
                     "9: found '1.5', expected the radius of a disc at distance 1 (a "
                     "number from 0 to 1)"},
        WrongComment{"# translucent -1", "9: found '-1', expected the radius of a disc"},
        WrongComment{"# light sphere 1 2 3",
                     "9: found the end of the line, expected the light's radius"},
        WrongComment{"# light sphere 1 2 3 0",
                     "9: found a light of radius 0, expected a radius > 0"},
        WrongComment{"# light sphere 1 2 3 1 0.5 0.5",
                     "9: found the end of the line, expected the light's colour"},
        WrongComment{"# light rect 1 2 3 1 0 0",
                     "9: found the end of the line, expected the light's "
                     "second half edge"},
        WrongComment{"# light rect 1 2 3 1 0 0 -2 0 0",
                     "9: found a light with area 0, expected half"},
        WrongComment{"# light rect 1 2 3 1 0 0 0 0 0", "9: found a light with area 0"},
        WrongComment{"# path no-such.csv", "9: no-such.csv: cannot be read"},
        WrongComment{"# camera no-such.txt", "9: no-such.txt: cannot be read"}));

// A word that was meant as a number makes the comment a statement, which is then refused. Names may
// be in upper case, and the blank after '#' may be missing.
TEST(NffComments, WhatLooksLikeAStatementIsNotIgnored) {
  const auto read = [](const std::string& line) {
    return parse(COMMENTED_VIEW + COMMENTED_SURFACE + line + "\ns 0 0 0 1\n");
  };
  for (const char* name : {"lens", "shutter", "move", "gloss", "translucent", "uv", "light rect",
                           "light sphere", "LENS", "Gloss"})
    for (const char* number :
         {"0,5", "-0,5", "nan", "-nan", "inf", "+inf", "infinity", "1e999", "-1e999", "1,5e3",
          "10%", "0.1;", "1/2", "0.5s", "1e", "0x1", ".5.", "-2nd"})
      for (const char* begin : {"# ", "#", "  #\t"}) {
        const auto line = fmt::format("{}{} {} 1 1", begin, name, number);
        EXPECT_TRUE(get_error([&] { read(line); }).starts_with("test.nff:9: found '")) << line;
      }
  for (const char* line : {"# texture wood.jpg", "# texture Wood.PNG planar", "# path a.CSV"})
    EXPECT_TRUE(get_error([&] { read(line); }).starts_with("test.nff:9: ")) << line;
  for (const char* line : {"# lens 1 5", "#lens 1 5", "# LENS +1 5"})
    EXPECT_EQ(read(line).view.lens.focus, 5) << line;
  EXPECT_EQ(get_error([&] { read("s 1 0 0 1 # move 1 0 0"); }),
            "test.nff:9: found '# move 1 0 0' after other words, expected it on a line of its own");
}

TEST(NffComments, GlossNeedsASurface) {
  EXPECT_EQ(get_error([] { parse("# gloss 0.5\n" + COMMENTED_VIEW); }),
            "test.nff:1: found '# gloss', expected a surface ('f') before it");
}

TEST(NffComments, Paths) {
  const Path path = parse_path("T,X,Y,Z\n0,1,2,3\n# later\n2, 3,2,1\n\n4 3 2 0\n", "a.csv", false);
  ASSERT_EQ(path.size(), 3u);
  EXPECT_EQ(eval_path(path, -7).place, (Vec{1, 2, 3}));
  EXPECT_EQ(eval_path(path, 0).place, (Vec{1, 2, 3}));
  EXPECT_EQ(eval_path(path, 0.5).place, (Vec{1.5, 2, 2.5}));
  EXPECT_EQ(eval_path(path, 2).place, (Vec{3, 2, 1}));
  EXPECT_EQ(eval_path(path, 3).place, (Vec{3, 2, 0.5}));
  EXPECT_EQ(eval_path(path, 99).place, (Vec{3, 2, 0}));
  const auto wrong = [](const char* text, bool has_target = false) {
    return get_error([&] { parse_path(text, "a.csv", has_target); });
  };
  EXPECT_EQ(wrong(""), "a.csv:1: found the end of the file, expected a row of numbers");
  EXPECT_EQ(wrong("T X Y Z\n"), "a.csv:1: found the end of the file, expected a row of numbers");
  EXPECT_EQ(wrong("0 1 2 3\n0 1 2 3"), "a.csv:2: found the time 0, expected more than 0");
  EXPECT_EQ(wrong("0 1 2\n3"),
            "a.csv:1: found the end of the line, expected a displacement (a "
            "number up to 1e+15 in magnitude)");
  EXPECT_EQ(wrong("0 1 2 3 4"), "a.csv:1: found '4', expected the end of the line");
  EXPECT_EQ(wrong("0 1 2 3 4 5\n", true),
            "a.csv:1: found the end of the line, expected the point that the camera looks at (a "
            "number up to 1e+15 in magnitude)");
}

TEST(NffComments, FilesAreLookedForBesideTheScene) {
  const Folder folder;
  folder.write("walk.csv", "T,X,Y,Z\n0,0,0,0\n10,20,0,0\n");
  folder.write("eye.path", "0 0 0 5 0 0 0\n4 0 0 9 0 4 0\n");
  const std::string nff = folder.write(
      "scene.nff", "# shutter 0 0.5\n# camera eye.path\n" + COMMENTED_VIEW + COMMENTED_SURFACE +
                       "# path walk.csv\ns 1 0 0 1\n# move 0 0 0\ns 2 0 0 1\n");
  const Scene scene = load_scene(nff, 3);
  EXPECT_EQ(scene.moves, (std::vector<Vec>{{1, 0, 0}, {}}));
  for (const Sphere& s : scene.spheres)
    EXPECT_EQ(s.centre, (s.tag.object == 0 ? Vec{7, 0, 0} : Vec{2, 0, 0}));
  EXPECT_EQ(scene.view.from, (Vec{0, 0, 8}));
  EXPECT_EQ(scene.view.at, (Vec{0, 3, 0}));
  EXPECT_EQ(scene.view.from_move, (Vec{0, 0, 0.5}));
  EXPECT_EQ(scene.view.at_move, (Vec{0, 0.5, 0}));
  EXPECT_EQ(scene.view.angle, 45);
  EXPECT_TRUE(scene.view.has_motion);
  const auto beside = [&](const char* name) {
    return (std::filesystem::path(nff).parent_path() / name).string();
  };
  EXPECT_EQ(find_files(nff), (std::vector{beside("eye.path"), beside("walk.csv")}));

  const std::string walk = folder.write("walk.csv", "0 0 0 0\n1 x 0 0\n");
  EXPECT_EQ(get_error([&] { load_scene(nff); }),
            nff + ":11: " + walk +
                ":2: found 'x', expected a displacement (a number up to 1e+15 in "
                "magnitude)");
  folder.write("eye.path", "0 0 0 5 0 0 0\n1 0 0 -5 0 0 0\n");
  folder.write("walk.csv", "0 0 0 0\n");
  EXPECT_EQ(get_error([&] { load_scene(nff); }).substr(0, nff.size() + 37),
            nff + ":2: found a view whose 'from' and 'at");
}

TEST(NffComments, RandomStatementsAreRejectedNotFatal) {
  const std::string whole = "# lens 0.1 5\n# shutter 0 1\n" + COMMENTED_VIEW + COMMENTED_SURFACE +
                            "# gloss 0.5\n# translucent 0.5\n# move 1 0 0\ns 0 0 0 1\n"
                            "# light rect 1 1 1 1 0 0 0 1 0\n# light sphere 1 1 1 1\n";
  int accepted = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    std::string text = whole;
    for (int i = 0; i < 3; ++i)
      text[static_cast<std::size_t>(random.below(static_cast<int>(text.size())))] =
          static_cast<char>(random.below(128));
    try {
      Params params = make_params(4, 4, 3);
      params.sampling.pixel_samples = 2;
      render(parse(text), params);
      ++accepted;
    } catch (const base::BadInput&) {
    }
  }
  EXPECT_GT(accepted, 20);
}

}  // namespace
}  // namespace renderer::test
