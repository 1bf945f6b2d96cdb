// Tests scenes as OBJ files, and the conversion of NFF to OBJ and back.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "base/whole_file.hpp"
#include "renderer/files/obj_nff.hpp"
#include "renderer/files/write_nff.hpp"
#include "renderer/files/write_obj.hpp"
#include "renderer/image/image.hpp"
#include "tests/renderer/support.hpp"
#include "tests/support/files.hpp"

namespace renderer::test {
namespace {

class ObjScene : public ::testing::Test {
 protected:
  std::string save(const std::string& name, const std::string& text) {
    std::ofstream(folder_.path / name) << text;
    return (folder_.path / name).string();
  }

  // Saves a scene as NAME.obj with its MTL file, and returns the content of the OBJ file.
  std::string save_obj(const std::string& name, const auto& tell) {
    ObjText obj(folder_.path.string(), name + ".mtl");
    NffAsObj nff(obj, left_out_);
    tell(nff);
    save(name + ".mtl", obj.library());
    return save(name + ".obj", obj.text());
  }

  std::string error_of(const std::string& obj) {
    const auto path = save("bad.obj", obj);
    return ::test::message_of<base::BadInput>([&] { load_scene(path); });
  }

  ::test::TemporaryFolder folder_;
  LeftOut left_out_;
};

std::vector<Samples::Sums> render_small(const Scene& scene) {
  return render(scene, make_params(40, 30, 4)).samples.sums;
}

// Sends to the target random content that OBJ can express: polygons with and without normals, and
// all kinds of surfaces and lights.
void tell_random(Random& random, NffTarget& target) {
  target.set_view(make_image_plane({.from = random.point(1) + Vec{0, 0, 6},
                                    .up = {0.1, 1, 0},
                                    .angle = random.range(30, 60),
                                    .width = 40,
                                    .height = 30}));
  target.set_background(random.colour());
  for (int i = random.below(3); i > 0; --i) {
    Light light{.at = random.point(5)};
    light.shape = static_cast<LightShape>(random.below(3));
    light.u = random.direction(), light.v = random.direction();
    light.radius = random.unit() + 0.1;
    target.add_light(light, random.below(2) ? std::optional(random.colour()) : std::nullopt);
  }
  for (int i = 0; i < 12; ++i) {
    target.set_surface({random.colour(), random.unit(), random.below(2) * random.unit(),
                        random.range(1, 50), random.below(2) * random.unit(), random.range(1, 2)});
    for (int j = random.below(3); j >= 0; --j) {
      const Vec at = random.point(2);
      const auto corners = make_star(random, at, 1.5);
      std::vector<Vec> normals;
      if (random.below(2))
        for (const Vec& corner : corners) normals.push_back(corner - at + random.direction());
      target.add_polygon(corners, normals);
    }
  }
}

TEST_F(ObjScene, AnNffAsObjHasTheSameImageAndComesBackTheSame) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    NffText first("");
    Random random{seed};
    tell_random(random, first);
    const auto path =
        save_obj("scene", [&](NffTarget& nff) { read_nff(first.text(), "first.nff", nff); });

    const auto pixels = render_small(parse(first.text()));
    EXPECT_NE(std::ranges::count(pixels, pixels[0]), std::ssize(pixels)) << "all is background";
    EXPECT_EQ(render_small(load_scene(path)), pixels);

    NffText back("");
    read_scene(base::read_text(path), path, back);
    EXPECT_EQ(back.text(), first.text());
  }
  EXPECT_EQ(left_out_.describe(), "");
}

TEST_F(ObjScene, PicturesAreCarriedByCoordinates) {
  save_png((folder_.path / "tiles.png").string(), 2, 2,
           std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 0});
  const auto nff = save("tiled.nff",
                        "v from 0 0 3 at 0 0 0 up 0 1 0 angle 45\nl 1 2 5\n"
                        "f 1 1 1 0.75 0 0 0 1\n# texture tiles.png mesh\n"
                        "# uv 0 0 3 0 3 3 0 3\np 4 -1 -1 0 1 -1 0 1 1 0 -1 1 0\n");
  const auto obj = save_obj("tiled", [&](NffTarget& t) { read_nff(base::read_text(nff), nff, t); });
  EXPECT_EQ(render_small(load_scene(obj)), render_small(load_scene(nff)));
  EXPECT_NE(base::read_text(folder_.path / "tiled.mtl").find("map_Kd tiles.png\n"),
            std::string::npos);
  EXPECT_EQ(find_files(obj), (std::vector<std::string>{(folder_.path / "tiled.mtl").string(),
                                                       (folder_.path / "tiles.png").string()}));
}

TEST_F(ObjScene, WhatObjHasNoWordForIsNamed) {
  save_png((folder_.path / "a.png").string(), 1, 1, std::vector<std::uint8_t>{255, 0, 0});
  save_obj("scene", [&](NffTarget& nff) {
    read_nff(
        "v from 0 0 3 at 0 0 0 up 0 1 0 angle 45\n# lens 0.1 3\n# shutter 0 1\nf 1 1 1 1 1 0 0 1\n"
        "# gloss 0.1\ns 0 0 0 1\ns 1 0 0 1\nc 0 0 0 1 0 1 0 1\nf 1 1 1 1 0 0 0 1\n"
        "# texture a.png planar 0 0 0 1 0 0 0 1 0\n# move 1 0 0\np 3 0 0 0 1 0 0 0 1 0\n",
        (folder_.path / "a.nff").string(), nff);
  });
  EXPECT_EQ(left_out_.describe(),
            "cones (1), gloss (1), lenses (1), motions (1), shutters (1), spheres (2), textures "
            "with another mapping than mesh (1)");
}

TEST_F(ObjScene, GeneratedScenesAreWritten) {
  for (const char* name : {"spheres:50", "hills:300", "room:2"}) {
    SCOPED_TRACE(name);
    const auto made = load_scene(name);
    NffText nff("");
    tell(made, nff);
    const auto read = parse(nff.text());
    EXPECT_EQ(object_count(read), object_count(made));
    const auto params = make_params(40, 30, 4);
    const auto a = render(made, params).samples.sums, b = render(read, params).samples.sums;
    int differ = 0;
    for (std::size_t i = 0; i < a.size(); ++i) differ += !(a[i] == b[i]);
    EXPECT_LE(differ, 12) << "a rounding moves an edge now and then";
  }
}

const std::string TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST_F(ObjScene, WithoutViewLightAndMaterialItIsSeenFromOutside) {
  const auto scene = load_scene(save("bare.obj", TRIANGLE + "f 1 2 3\n"));
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].at, scene.view.from);
  EXPECT_EQ(scene.view.at, (Vec{0.5, 0.5, 0}));
  EXPECT_EQ(scene.surfaces[0].colour, (Rgb{0.8, 0.8, 0.8}));
}

TEST_F(ObjScene, EndingsMayBeCapitals) {
  save("M.MTL", "newmtl red\nKd 1 0 0\n");
  const auto scene =
      load_scene(save("A.OBJ", "mtllib M.MTL\n" + TRIANGLE + "usemtl red\nf 1 2 3\n"));
  EXPECT_EQ(scene.surfaces.at(0).colour, (Rgb{1, 0, 0}));
}

TEST_F(ObjScene, MaterialsAreSurfaces) {
  save("m.mtl",
       "newmtl dull\nKd 0.5 0.25 0\nKs 0.9 0.9 0.9\nNs 20\nillum 2\n"
       "newmtl mirror\nKd 0 0 0\nKs 0.5 0.75 0.25\nillum 3\n"
       "newmtl glass\nKd 0 0 0\nd 0.75\nTr 0.25\nNi 1.5\nillum 6\n"
       "newmtl swapped\nKd 0 0 0\nd 1\nTr 1\nillum 1\n"
       "newmtl factors\nKd 0.125 0.25 0.5\n# surface 0.25 0.5 1 0.5\n"
       "newmtl changed\nKd 0.125 0.25 0.25\n# surface 0.25 0.5 1 0.5\n");
  std::string obj = "mtllib m.mtl\n" + TRIANGLE;
  for (const char* name : {"dull", "mirror", "glass", "swapped", "factors", "changed"})
    obj += fmt::format("usemtl {}\nf 1 2 3\n", name);
  const auto s = load_scene(save("a.obj", obj)).surfaces;
  ASSERT_EQ(s.size(), 6u);
  EXPECT_EQ(s[0].colour, (Rgb{0.5, 0.25, 0}));
  EXPECT_EQ(s[0].kd, 1);
  EXPECT_EQ(s[0].ks, 0) << "a highlight alone";
  EXPECT_EQ(s[0].shine, 20);
  EXPECT_EQ(s[1].ks, 0.75);
  EXPECT_EQ(s[2].t, 0.25);
  EXPECT_EQ(s[2].ior, 1.5);
  EXPECT_EQ(s[3].t, 0) << "d counts where Tr contradicts it";
  EXPECT_EQ(s[4].colour, (Rgb{0.25, 0.5, 1}));
  EXPECT_EQ(s[4].kd, 0.5);
  EXPECT_EQ(s[5].colour, (Rgb{0.125, 0.25, 0.25}));
  EXPECT_EQ(s[5].kd, 1);
}

TEST_F(ObjScene, WhatIsWrongIsRejectedWithItsLine) {
  const std::string at = folder_.path.string() + "/bad.obj";
  const std::pair<std::string, std::string> wrong[] = {
      {"", at + ": found no face, expected one or more"},
      {TRIANGLE + "f 1 2 2\n", at + ":4: found 2 different corners, expected 3 or more"},
      {"v 0 0\nf 1 1 1\n", at + ":1: found the end of the line, expected a vertex"},
      {"\nsolid cube\nfacet normal 0 0 1\n", at + ":2: found 'solid', expected a statement: v, "},
      {std::string("\x7f"
                   "ELF\2\1\1\0x",
                   9),
       at + ":1: found '\\x7fELF\\x02\\x01\\x01\\x00x'"},
      {"\xff\xfev\0 \0", at + ":1: found UTF-16 or binary data, expected text in UTF-8"},
      {std::string("v\0 \0", 4), at + ":1: found UTF-16 or binary data, expected text in UTF-8"},
      {"# v from 0 0 1 at 0 0 0 up 0 1 0\n", at + ":1: found the end of the line, expected the "
                                                  "view's 'angle'"},
      {"# v from 0 0 1 at 0 0 0 up 0 1 0 angle 45\n# v from 0 0 1 at 0 0 0 up 0 1 0 angle 45\n",
       at + ":2: found a second '# v', expected one"},
      {"# l 1 2\n", at + ":1: found the end of the line, expected the light's position"},
  };
  for (const auto& [text, expected] : wrong)
    EXPECT_EQ(error_of(text).substr(0, expected.size()), expected) << error_of(text);
}

// The third surface equals the first, so that the first material is used again.
TEST_F(ObjScene, MaterialsOfAnNffAreNumberedFromOne) {
  const auto path = save_obj("scene", [&](NffTarget& nff) {
    const std::string triangle = "p 3 0 0 0 1 0 0 0 1 0\n";
    read_nff("v from 0 0 3 at 0 0 0 up 0 1 0 angle 45\nf 1 0 0 1 0 0 0 1\n" + triangle +
                 "f 0 1 0 1 0 0 0 1\n" + triangle + "f 1 0 0 1 0 0 0 1\n" + triangle,
             "first.nff", nff);
  });
  const auto names_in = [](const std::string& text, const std::string& statement) {
    std::vector<std::string> names;
    std::istringstream words(text);
    for (std::string word; words >> word;)
      if (word == statement) names.push_back((words >> word, word));
    return names;
  };
  const auto library = base::read_text(folder_.path / "scene.mtl");
  EXPECT_EQ(names_in(library, "newmtl"), (std::vector<std::string>{"surface_1", "surface_2"}));
  EXPECT_EQ(names_in(base::read_text(path), "usemtl"),
            (std::vector<std::string>{"surface_1", "surface_2", "surface_1"}));
}

}  // namespace
}  // namespace renderer::test
