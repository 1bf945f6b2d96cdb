// Tests the OBJ and MTL readers, statement by statement, with files such as other programs write.
#include <gtest/gtest.h>

#include <fstream>

#include "base/text.hpp"
#include "renderer/files/obj_nff.hpp"
#include "renderer/image/image.hpp"
#include "tests/renderer/support.hpp"
#include "tests/support/files.hpp"

namespace renderer::test {
namespace {

// A target that describes each polygon by its colour and its corners, as in "0.8,0.8,0.8: 0,0,0
// 1,0,0 0,1,0". Appends "n" if the polygon has normals, and "t" with the first corner's texture
// coordinates if it has a picture.
struct ToldFaces : NffTarget {
  std::vector<std::string> faces;
  std::string surface;
  std::vector<Corner> coordinates;
  bool has_picture = false;

  void set_view(const View&) override {}
  void add_light(const Light&, const std::optional<Rgb>&) override {}
  void set_surface(const Surface& s) override {
    surface =
        fmt::format("{:g},{:g},{:g}", s.kd * s.colour.r, s.kd * s.colour.g, s.kd * s.colour.b);
    if (s.ks > 0) surface += fmt::format(" ks {:g}", s.ks);
    if (s.t > 0) surface += fmt::format(" t {:g} ior {:g}", s.t, s.ior);
    has_picture = s.texture != NO_TEXTURE;
  }
  std::uint32_t add_texture(const std::string&, const Mapping&) override { return 0; }
  void set_coordinates(std::vector<Corner> c) override { coordinates = std::move(c); }
  void add_sphere(const Vec&, double) override {}
  void add_cone(const Vec&, double, const Vec&, double) override {}
  void add_polygon(std::vector<Vec> corners, std::vector<Vec> normals) override {
    std::string face = surface + ":";
    for (const auto& [x, y, z] : corners) face += fmt::format(" {:g},{:g},{:g}", x, y, z);
    if (!normals.empty()) face += " n";
    if (has_picture) face += fmt::format(" t {:g},{:g}", coordinates[0].u, coordinates[0].v);
    faces.push_back(face);
  }
};

struct ObjReading : testing::Test {
  void save(const std::string& name, const std::string& text) {
    std::ofstream(folder.path / name, std::ios::binary) << text;
  }

  // Reads a text. Removes the folder from the file names in remarks.
  void read(const std::string& text) {
    target = {};
    left_out = {};
    const auto path = (folder.path / "a.obj").string();
    read_scene(text, path, target, &left_out);
    remarks.clear();
    for (auto remark : left_out.describe_remarks()) {
      for (auto at = remark.find(folder.path); at != remark.npos; at = remark.find(folder.path))
        remark.erase(at, folder.path.string().size() + 1);
      remarks.push_back(remark);
    }
  }

  // The colour of the only face in the text.
  std::string colour_of(const std::string& text) {
    read(text);
    EXPECT_EQ(target.faces.size(), 1u) << text;
    return target.surface;
  }

  ::test::TemporaryFolder folder;
  ToldFaces target;
  LeftOut left_out;
  std::vector<std::string> remarks;
};

const std::string POINTS = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n", FACE = "f 1 2 3\n";
const std::string GREY = "0.8,0.8,0.8: 0,0,0 1,0,0 0,1,0", RED = "1,0,0: 0,0,0 1,0,0 0,1,0";

TEST_F(ObjReading, WritingsOfOneTriangle) {
  save("red.mtl", "newmtl red\nKd 1 0 0\n");
  const std::string red = "mtllib red.mtl\nusemtl red\n";
  const std::string texts[] = {
      red + POINTS + FACE,
      red + FACE + POINTS,                                // face before its vertices
      "usemtl red\n" + POINTS + FACE + "mtllib red.mtl",  // material before its library
      "\xEF\xBB\xBF" + red + POINTS + FACE,
      red + POINTS + FACE + "\x1A",
      red + POINTS + "f 1 2 \\\n3\n",
      red + POINTS + "f 1\\  \n2\\\n 3",
      red + POINTS + "f -4 -3 -2\nv 7 7 7",
      red + POINTS + "f 1// 2// 3//",
      red + POINTS + "f 1/ 2/ 3/",
      red + POINTS + "fo 1 2 3",
      red + POINTS + "\tf\t1  2\t3 \t# it ends here",
      red + POINTS + "f 1 1 2 3 3",  // repeated corners
      red + POINTS + "f 1 2 3 1",
      "MTLLIB red.mtl\nUseMtl red\n" + POINTS + "F 1 2 3",
      red + "v 0.0D+00 0 0\nv 1.0d0 0e-400 0E-400\nv +0 1. .0\n" + FACE,
      red + "v 0 0 0 1\nv 1 0 0 1.0\nv 0 1 0\n" + FACE,
      // A backslash in a comment does not continue the line.
      red + "# C:\\models\\\n" + POINTS + FACE,
      red + "o C:\\models\\\n" + POINTS + FACE,
      red + "g one two \\\n  three\n" + POINTS + FACE,
      red + POINTS + "s 1\nmg 1 0.5\nlod 0\nbevel off\nc_interp on\nusemap off\n" + FACE,
  };
  for (const auto& text : texts) {
    for (const char* line_end : {"\n", "\r\n", "\r"}) {
      std::string ended;
      for (const char c : text) ended += c == '\n' ? line_end : std::string(1, c);
      SCOPED_TRACE(base::blank_controls(ended));
      read(ended);
      EXPECT_EQ(target.faces, std::vector{RED});
      EXPECT_EQ(left_out.describe_all("a.obj"), std::vector<std::string>{});
    }
  }
}

TEST_F(ObjReading, OneBadFaceNeverRejectsAFile) {
  const std::string unnamed =
      "a.obj:5: found 'f', expected 'usemtl' before it; faces in light grey (1)";
  const std::string number =
      ", expected the number of a readable vertex (v): 1 to 4, or -1 to -4 counted back from this "
      "line; left out faces (1)";
  const std::pair<std::string, std::string> cases[] = {
      {"f 1 2 5", "found '5'" + number},
      {"f 1 2 0", "found '0'" + number},
      {"f 1 2 -5", "found '-5'" + number},
      {"f 1 2 99999999999999999999", "found '99999999999999999999'" + number},
      {"f 1 2 3;", "found '3;'" + number},
      {"f 1 2 1.5", "found '1.5'" + number},
      {"f 1 2 3/1/1/1", "found '3/1/1/1'" + number},
      {"f 1 2", "found 2 different corners, expected 3 or more; left out faces (1)"},
      {"f", "found 0 different corners, expected 3 or more; left out faces (1)"},
      {"f 1 2 2 1", "found 2 different corners, expected 3 or more; left out faces (1)"},
      {"f 1 2 3 2",
       "found a polygon with area 0, expected vertices that are not collinear; left out faces (1)"},
      {"f 1 2 4 3 // 1", "found '//'" + number},
      {"v 1,5 0 0",
       "found '1,5', expected a vertex (a number up to 1e+15 in magnitude); left out "
       "vertices (1)"},
      {"v 0 0 1.#INF",
       "found '1.#INF', expected a vertex (a number up to 1e+15 in magnitude); left "
       "out vertices (1)"},
      {"v 0 1",
       "found the end of the line, expected a vertex (a number up to 1e+15 in magnitude); "
       "left out vertices (1)"},
      {"vt nan 0",
       "found 'nan', expected a texture coordinate (a number from -1e+06 to 1e+06); "
       "left out texture coordinates (1)"},
      {"vn 0 0",
       "found the end of the line, expected a normal (a number up to 1e+15 in magnitude); "
       "left out normals (1)"},
      {"vertex 1",
       "found 'vertex', expected a statement: v, vt, vn, f, g, o, s, usemtl, mtllib or "
       "another of OBJ; left out unknown statements (1)"}};
  for (const auto& [line, remark] : cases) {
    SCOPED_TRACE(line);
    read(POINTS + FACE + line + "\n");
    EXPECT_EQ(target.faces, std::vector{GREY});
    const auto at = "a.obj:6: " + remark;
    EXPECT_EQ(remarks.size(), 2u);
    EXPECT_NE(std::ranges::find(remarks, at), remarks.end()) << remarks.back();
    EXPECT_NE(std::ranges::find(remarks, unnamed), remarks.end());
  }
}

// An unreadable vertex keeps its number, and only the faces that use it are lost.
TEST_F(ObjReading, ABadVertexTakesOnlyItsFaces) {
  read("v 0 0 0\nv 1 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\nf -4 -3 -1\nf -4 -2 -1\n");
  EXPECT_EQ(target.faces, (std::vector{GREY, GREY}));
  EXPECT_EQ(left_out.describe(), "faces (2), vertices (1)");
}

TEST_F(ObjReading, NormalsAndCoordinatesAreWholeOrLeftOut) {
  const std::string lists = POINTS + "vt 0 0\nvt 1\nvt nan 0\nvn 0 0 1\nvn 0 0 0\nvn 1 x 0\n";
  const std::pair<std::string, std::string> cases[] = {
      {"f 1//1 2//1 3//1", ""},
      {"f 1/1/1 2/2/1 3/1/1", ""},
      {"f 1//1 2//1 3", "normals of faces (1)"},
      {"f 1//1 2//1 3//2", "normals of faces (1)"},
      {"f 1//1 2//1 3//3", "normals of faces (1)"},
      {"f 1//1 2//1 3//4", "normals of faces (1)"},
      {"f 1/1 2/2 3", "texture coordinates of faces (1)"},
      {"f 1/1 2/2 3/3", "texture coordinates of faces (1)"},
      {"f 1/1/1 2/2/1 3/x/2", "normals of faces (1), texture coordinates of faces (1)"}};
  for (const auto& [face, expected] : cases) {
    SCOPED_TRACE(face);
    read(lists + face);
    const bool has_normals = face.find("/1 3/1/1") != face.npos || face.ends_with("3//1");
    EXPECT_EQ(target.faces, std::vector{GREY + (has_normals ? " n" : "")});
    const std::string bad = "normals (1), ", bad_too = "texture coordinates (1)";
    const auto split = expected.find("texture");
    const auto of_normals = expected.substr(0, std::min(split, expected.size()));
    const auto all = left_out.describe();
    EXPECT_NE(all.find("normals (1)"), all.npos);
    EXPECT_NE(all.find("texture coordinates (1)"), all.npos);
    EXPECT_EQ(all.find("normals of faces (1)") != all.npos, of_normals.find("normals") != all.npos);
    EXPECT_EQ(all.find("texture coordinates of faces (1)") != all.npos, split != expected.npos);
  }
}

TEST_F(ObjReading, NamesAreTheRestOfTheLine) {
  save("my red.mtl",
       "newmtl red\nKd 1 0 0\nnewmtl red metal\nKd 0 1 0\nnewmtl Material#25 \nKd 0 0 1\n"
       "newmtl #7\nKd 0 0 0.5\nnewmtl  \"q t\" # quoted\nKd 0 0 0.25\n");
  const std::pair<std::string, std::string> cases[] = {{"red", "1,0,0"},
                                                       {"red # the first", "1,0,0"},
                                                       {"red\t", "1,0,0"},
                                                       {"red metal", "0,1,0"},
                                                       {"red  plastic", "0.8,0.8,0.8"},
                                                       {"Material#25", "0,0,1"},
                                                       {"Material#26", "0.8,0.8,0.8"},
                                                       {"Material", "0.8,0.8,0.8"},
                                                       {"red #7", "0.8,0.8,0.8"},
                                                       {"#7", "0,0,0.5"},
                                                       {"\"q t\"", "0,0,0.25"},
                                                       {"", "0.8,0.8,0.8"},
                                                       {"RED", "0.8,0.8,0.8"}};
  const char* libraries[] = {"my red.mtl", "\"my red.mtl\"", ".\\my red.mtl # here",
                             "gone.mtl my red.mtl"};
  for (const char* library : libraries)
    for (const auto& [name, colour] : cases) {
      SCOPED_TRACE(name);
      const auto text = fmt::format("mtllib {}\nusemtl {}\n{}{}", library, name, POINTS, FACE);
      EXPECT_EQ(colour_of(text), colour);
      EXPECT_EQ(remarks.size(), colour == "0.8,0.8,0.8" || library == libraries[3]) << remarks[0];
    }
}

TEST_F(ObjReading, AFaceWithoutAKnownMaterialIsLightGreyWithOneWarning) {
  save("b.mtl", "newmtl red\nKd 1 0 0\n");
  const std::pair<std::string, std::string> cases[] = {
      {"", "a.obj:5: found 'f', expected 'usemtl' before it"},
      {"mtllib gone.mtl\n", "a.obj:1: found 'gone.mtl', expected the name of an existing file"},
      {"mtllib\n", "a.obj:1: found 'mtllib' without a name, expected a file"},
      {"usemtl None\n", "a.obj:1: found the material 'None', expected one of the libraries: none"},
      {"mtllib gone.mtl\nusemtl None\n",
       "a.obj:1: found 'gone.mtl', expected the name of an existing file"},
      {"mtllib b.mtl\nusemtl blue\n",
       "a.obj:2: found the material 'blue', expected one of the libraries: 'red'"},
      {"mtllib b.mtl\nusemtl\n",
       "a.obj:2: found the material '', expected one of the libraries: 'red'"}};
  for (const auto& [head, remark] : cases) {
    SCOPED_TRACE(head);
    read(head + POINTS + FACE + FACE);
    EXPECT_EQ(target.faces, (std::vector{GREY, GREY}));
    EXPECT_EQ(remarks, std::vector{remark + "; faces in light grey (2)"});
  }
  read("mtllib gone.mtl b.mtl\nusemtl red\n" + POINTS + FACE + "usemtl\n" + FACE + "usemtl red\n" +
       FACE);
  EXPECT_EQ(target.faces, (std::vector{RED, GREY, RED}));
}

TEST_F(ObjReading, OfTwoMaterialsWithOneNameTheFirstCounts) {
  save("b.mtl", "newmtl red\nKd 1 0 0\nnewmtl red\nKd 1 0 0\n");
  save("c.mtl", "newmtl red\nKd 0.5 0 0\n");
  EXPECT_EQ(colour_of("mtllib b.mtl\nmtllib b.mtl c.mtl\nusemtl red\n" + POINTS + FACE), "1,0,0");
  EXPECT_EQ(remarks, std::vector<std::string>{"c.mtl:1: found a second material 'red', expected "
                                              "another name; left out materials (1)"});
}

TEST_F(ObjReading, ValuesOfMaterials) {
  const std::pair<std::string, std::string> cases[] = {
      {"Kd 0.5 0.25 0\n", "0.5,0.25,0"},
      {"Kd 0.5\n", "0.5,0.5,0.5"},
      {"kd\t1 0 0 # red\n", "1,0,0"},
      {"Kd 1.0D+00 0 0\n", "1,0,0"},
      {"Kd spectral red.rfl 1\n", "0.8,0.8,0.8"},
      {"Kd xyz 1 0 0\n", "0.8,0.8,0.8"},
      {"Kd -1 0 0\n", "0.8,0.8,0.8"},
      {"Kd 0 0 0\n", "0,0,0"},
      {"", "0.8,0.8,0.8"},
      {"Ke 1 1 1\n", "0,0,0"},
      {"Ks 1 1 1\nillum 3\n", "0,0,0 ks 1"},
      {"Kd 1 0 0\nKs 1 1 1\nillum 2\nNs 30\n", "1,0,0"},
      {"Kd 1 0 0\nd 0.75\nNi 1.5\n", "1,0,0 t 0.25 ior 1.5"},
      {"Kd 1 0 0\nd -halo 0.75\nNi 0\n", "1,0,0 t 0.25 ior 1"},
      {"Kd 1 0 0\nTr 0.25\n", "1,0,0 t 0.25 ior 1"},
      {"Kd 1 0 0\nd 0.75\nTr 0.25\n", "1,0,0 t 0.25 ior 1"},
      {"Kd 1 0 0\nd 1\nTr 1\n", "1,0,0"},
      {"Kd 1 0 0\nillum 2\nTr 1.0\n", "1,0,0"},
      {"Kd 1 0 0\nillum 4\nTr 1.0\n", "1,0,0 t 1 ior 1"},
      {"Kd 1 0 0\nillum 11\nNs 1e99\nTr 2\nd nan\nKs x\nKe -1\n", "1,0,0"},
      {"Kd 1 0 0\nbump a.png\nmap_Bump -bm 1 a.png\nnorm a.png\nPr 0.5\nKa 1 1 1\n", "1,0,0"}};
  for (const auto& [values, colour] : cases) {
    save("b.mtl", "newmtl m\n" + values);
    EXPECT_EQ(colour_of("mtllib b.mtl\nusemtl m\n" + POINTS + FACE), colour) << values;
  }
  EXPECT_EQ(left_out.describe(), "pictures for properties other than colour (3)");
}

// Reflections have no colour in the renderer.
TEST_F(ObjReading, MirrorsOfAnyColourAreNamed) {
  const std::pair<std::string, std::string> cases[] = {{"1 1 1", ""},
                                                       {"1 0.5 0.5", "colours of mirrors (1)"},
                                                       {"0.5 0.5 1", "colours of mirrors (1)"},
                                                       {"1 0.5 0.2", "colours of mirrors (1)"}};
  for (const auto& [specular, expected] : cases) {
    SCOPED_TRACE(specular);
    save("b.mtl", "newmtl m\nillum 3\nKs " + specular + "\n");
    read("mtllib b.mtl\nusemtl m\n" + POINTS + FACE);
    EXPECT_EQ(left_out.describe(), expected);
  }
}

TEST_F(ObjReading, PicturesAreTheRestOfTheLineAfterTheirOptions) {
  for (const char* name : {"a.png", "my wood.png", "wood#2.png"})
    save_png((folder.path / name).string(), 1, 1, std::vector<std::uint8_t>{255, 0, 0});
  save("photo.png", "\xFF\xD8\xFF");
  const std::pair<std::string, std::string> cases[] = {
      {"a.png", " t 0.5,0.25"},
      {"my wood.png # oak", " t 0.5,0.25"},
      {".\\wood#2.png", " t 0.5,0.25"},
      {"-s 2 4 1 -o 1 a.png", " t 2,1"},
      {"-blendu on -clamp off -o 0.25 0.5 0 my wood.png", " t 0.75,0.75"},
      {"photo.png", ""},
      {"gone.png", ""},
      {"-bm", ""}};
  for (const auto& [words, expected] : cases) {
    SCOPED_TRACE(words);
    save("b.mtl", "newmtl m\nmap_Kd " + words + "\n");
    read("mtllib b.mtl\nusemtl m\nvt 0.5 0.25\n" + POINTS + "f 1/1 2/1 3/1\n" + FACE);
    const std::string colour = expected.empty() ? "0.8,0.8,0.8" : "1,1,1";
    const auto face = colour + GREY.substr(GREY.find(':'));
    EXPECT_EQ(target.faces, (std::vector{face + expected, face}));
    EXPECT_EQ(remarks.empty(), !expected.empty());
  }
}

// The triangles of a bent face must have the border of the face.
TEST_F(ObjReading, BentFacesAreTriangles) {
  const std::string bent = "v 0 0 0\nv 1 0 1\nv 1 1 0\nv 0 1 1\n";
  read(bent + "f 1 2 3 4\n");
  EXPECT_EQ(target.faces, (std::vector<std::string>{"0.8,0.8,0.8: 0,0,0 1,0,1 1,1,0",
                                                    "0.8,0.8,0.8: 1,1,0 0,1,1 0,0,0"}));
  read(POINTS + "f 1 2 4 3\nv 1 1 1e-3\nf 1 2 5 3");
  EXPECT_EQ(target.faces.size(), 3u);
  read("v 0 0 0\nv 1 0 0\nv 1 1 1e-7\nv 0 1 0\nf 1 2 3 4");
  EXPECT_EQ(target.faces.size(), 1u) << "rounded";
}

}  // namespace
}  // namespace renderer::test
