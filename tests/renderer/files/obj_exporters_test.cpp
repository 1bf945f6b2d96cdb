// Tests OBJ files that imitate the habits of various programs. The generator computes from its own
// lists of faces what a reader must find in each file.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>

#include "renderer/files/obj_nff.hpp"
#include "tests/renderer/support.hpp"
#include "tests/support/files.hpp"

namespace renderer::test {
namespace {

// A face in the file, as the reader should return it.
struct KnownFace {
  std::vector<Vec> corners;  // without repeated corners
  Rgb colour;
  bool is_bent = false, has_normals = false;
};

struct Habits {
  const char* program;
  const char* head;
  const char* number;  // printf format of a coordinate
  const char* line_end = "\n";
  const char* blank = " ";  // between a statement and its values
  const char* face_end = "";
  std::vector<std::string> materials{};  // names
  enum class Corners { v, v_vt, v_vn, all, wings } corners = Corners::all;
  bool is_relative = false, has_colours = false, has_byte_order_mark = false, continues = false;
  bool faces_first = false, is_scan = false, ends_as_dos = false;
};

const std::vector<Habits>& habits() {
  using C = Habits::Corners;
  static const std::vector<Habits> ALL = {
      {.program = "Blender",
       .head = "# Blender v2.93.4 OBJ File: ''\n# www.blender.org\no Cube\n",
       .number = "%.6f",
       .materials = {"Material", "Material.001", "None_tex.png"}},
      {.program = "Maya",
       .head =
           "# This file uses centimeters as units for non-parametric coordinates.\n\ng default\n",
       .number = "%f",
       .materials = {"initialShadingGroup", "scene:lambert2SG"}},
      {.program = "Rhino",
       .head = "# Rhino\n\n",
       .number = "%.15g",
       .line_end = "\r\n",
       .materials = {"Layer 01", "Custom #3", "red metal"},
       .corners = C::v_vn,
       .continues = true},
      {.program = "Wings3D",
       .head = "# Exported from Wings 3D 2.2.4\no cube1\n",
       .number = "%.8f",
       .materials = {"default", "_hole_"},
       .corners = C::wings},
      {.program = "3ds Max",
       .head = "# 3ds Max Wavefront OBJ Exporter v0.97b - (c)2007 guruware\n",
       .number = "%.4f",
       .line_end = "\r\n",
       .blank = "  ",
       .face_end = " ",
       .materials = {"Material #25", "Material #26", "wire_214229166"},
       .is_relative = true,
       .ends_as_dos = true},
      {.program = "a scanner",
       .head = "# scanned\n",
       .number = "%.7e",
       .line_end = "\r",
       .blank = "\t",
       .corners = C::v,
       .has_colours = true,
       .has_byte_order_mark = true,
       .is_scan = true},
      {.program = "a converter",
       .head = "",
       .number = "%g",
       .materials = {"\xC3\xBC mat"},
       .corners = C::v_vt,
       .faces_first = true}};
  return ALL;
}

// Writes an OBJ file and lists the faces in it.
class Exporter {
 public:
  Exporter(std::uint64_t seed, std::string stem)
      : random_{seed}, habits_(habits()[seed % habits().size()]), stem_(std::move(stem)) {}

  void write() {
    if (habits_.has_byte_order_mark) obj += "\xEF\xBB\xBF";
    obj += habits_.head;
    write_materials();
    for (int group = 1 + random_.below(4); group > 0; --group) write_group();
    obj += "# end";
    for (std::string* text : {&obj, &mtl}) end_lines(*text);
    if (habits_.ends_as_dos) obj += '\x1A';
  }

  const Habits& program() const { return habits_; }
  std::string obj, mtl;
  std::vector<KnownFace> faces;
  std::map<std::string, int> left_out;
  int grey = 0;

 private:
  std::string print(double value) const {
    char text[40];
    std::snprintf(text, sizeof text, habits_.number, value);
    return text;
  }
  double round(double value) const { return std::strtod(print(value).c_str(), nullptr); }

  void end_lines(std::string& text) const {
    std::string ended;
    for (const char c : text) ended += c == '\n' ? habits_.line_end : std::string(1, c);
    text = ended;
  }

  // Some programs do not name the MTL file; others name a file that does not exist.
  void write_materials() {
    for (const auto& name : habits_.materials) {
      const Rgb colour{0.001 * random_.below(1000), 0.001 * random_.below(1000), 0.5};
      mtl += fmt::format("newmtl {}\n\tNs 96.078431\nKa 1.0 1.0 1.0\nKd {} {} 0.5 # diffuse\n",
                         name, colour.r, colour.g);
      mtl += fmt::format("Ks 0.5 0.5 0.5\nd 1.0\nillum 2\n\n");
      colours_[name] = colour;
    }
    has_library_ = !habits_.materials.empty() && random_.below(5) > 0;
    if (has_library_) {
      left_out["highlights without mirror reflection"] +=
          static_cast<int>(habits_.materials.size());
      obj += fmt::format("mtllib{}{}.mtl\n", habits_.blank, stem_);
    } else if (random_.below(2) == 0) {
      obj += "mtllib gone.mtl\n";
      is_library_missing_ = true;
    }
  }

  void write_group() {
    obj += fmt::format("g group {}\ns off\n", random_.below(9));
    use_material();
    std::string vertices, statements;
    std::string& first = habits_.faces_first ? statements : vertices;
    for (int i = 3 + random_.below(8); i > 0; --i)
      write_something(habits_.is_relative ? statements : vertices, statements);
    obj += first + (habits_.faces_first ? vertices : statements);
  }

  void use_material() {
    colour_.reset();
    const int choice = random_.below(8);
    if (habits_.is_scan || choice == 0) return write_unknown_material();
    const auto& names = habits_.materials;
    const auto& name = names[static_cast<std::size_t>(random_.below(std::ssize(names)))];
    obj += fmt::format("usemtl {}\n", name);
    if (has_library_) colour_ = colours_[name];
  }

  void write_unknown_material() {
    constexpr const char* NAMES[] = {" None", "", " (null)", " Mat", " red", " Material #2"};
    obj += fmt::format("usemtl{}\n", NAMES[random_.below(6)]);
  }

  void write_something(std::string& vertices, std::string& statements) {
    switch (random_.below(10)) {
      case 0:
        return write_bad_face(vertices, statements);
      case 1:
        return write_other(statements);
      case 2:
        return write_bent(vertices, statements);
      case 3:
        return write_repeated(vertices, statements);
      default:
        return write_flat(vertices, statements);
    }
  }

  // Returns corners of a star around the origin in a random coordinate plane, so that the face is
  // exactly flat.
  std::vector<Vec> make_flat() {
    const int axis = random_.below(3), count = 3 + random_.below(5);
    const double height = round(random_.range(-5, 5)), middle = random_.range(-5, 5);
    std::vector<Vec> corners;
    for (int i = 0; i < count; ++i) {
      const double angle = 6.283185307179586 * i / count, r = random_.range(0.4, 1);
      const double u = round(middle + r * std::cos(angle)), v = round(r * std::sin(angle));
      corners.push_back(axis == 0   ? Vec{height, u, v}
                        : axis == 1 ? Vec{v, height, u}
                                    : Vec{u, v, height});
    }
    return corners;
  }

  void write_flat(std::string& vertices, std::string& statements) {
    const auto corners = make_flat();
    write_face(vertices, statements, corners, corners, false);
  }

  // Moves every second corner off the plane of the face.
  void write_bent(std::string& vertices, std::string& statements) {
    auto corners = make_flat();
    while (corners.size() < 4) corners = make_flat();
    const Vec lift{round(0.2), round(0.25), round(0.3)};
    for (std::size_t i = 0; i < corners.size(); i += 2) {
      const Vec p = corners[i] + lift;
      corners[i] = {round(p.x), round(p.y), round(p.z)};
    }
    write_face(vertices, statements, corners, corners, true);
  }

  // Writes one corner twice, as programs do that write triangles as quadrilaterals.
  void write_repeated(std::string& vertices, std::string& statements) {
    const auto corners = make_flat();
    auto repeated = corners;
    const auto at = static_cast<std::size_t>(random_.below(std::ssize(corners)));
    repeated.insert(repeated.begin() + std::ptrdiff_t(at), corners[at]);
    write_face(vertices, statements, repeated, corners, false);
  }

  void write_vertex(std::string& to, const Vec& p, const std::string& x) {
    to += fmt::format("v{}{} {} {}", habits_.blank, x, print(p.y), print(p.z));
    if (habits_.has_colours) {
      to += " 0.5 0.25 1";
      ++left_out["colours of vertices"];
    }
    to += "\n";
    ++vertices_;
  }

  void write_face(std::string& vertices, std::string& statements, const std::vector<Vec>& written,
                  const std::vector<Vec>& known, bool is_bent) {
    for (const Vec& p : written) write_vertex(vertices, p, print(p.x));
    const auto kind = habits_.corners;
    const bool has_vt = kind == Habits::Corners::all || kind == Habits::Corners::v_vt;
    bool has_vn = kind == Habits::Corners::all || kind == Habits::Corners::v_vn;
    if (has_vt)
      for (std::size_t i = 0; i < written.size(); ++i, ++coordinates_)
        vertices += fmt::format("vt{}{} 0.5{}\n", habits_.blank, print(0.1), i % 2 ? " 0" : "");
    const bool is_zero = has_vn && random_.below(6) == 0;
    if (has_vn)
      vertices += fmt::format("vn{}{} 0 0\n", habits_.blank, is_zero ? "0" : print(1)), ++normals_;
    statements += describe_face(written.size(), has_vt, has_vn);
    if (is_zero) ++left_out["normals of faces"], has_vn = false;
    faces.push_back({known, colour_.value_or(Rgb{0.8, 0.8, 0.8}), is_bent, has_vn});
    if (!colour_) ++grey;
  }

  // Describes a face whose corners are the vertices written last.
  std::string describe_face(std::size_t count, bool has_vt, bool has_vn) {
    const auto number = [&](std::size_t back, std::size_t all) {
      return habits_.is_relative ? fmt::format("-{}", back) : fmt::format("{}", all + 1 - back);
    };
    std::string face = "f";
    for (std::size_t i = 0; i < count; ++i) {
      const auto back = count - i;
      face += habits_.continues && i == 2 ? " \\\n " : " ";
      face += number(back, vertices_);
      if (has_vt) face += "/" + number(back, coordinates_);
      if (has_vn) face += (has_vt ? "/" : "//") + number(1, normals_);
      if (habits_.corners == Habits::Corners::wings) face += "//";
    }
    return face + habits_.face_end + (random_.below(6) == 0 ? " # a face\n" : "\n");
  }

  void write_bad_face(std::string& vertices, std::string& statements) {
    const auto corners = make_flat();
    const int what = random_.below(6);
    ++left_out["faces"];
    constexpr const char* BAD[] = {"nan", "1.#QNAN", "inf"};
    for (std::size_t i = 0; i < 3; ++i) {
      const bool is_bad = what == 0 && i == 1;
      write_vertex(vertices, corners[what == 1 ? 0 : i],
                   is_bad ? BAD[random_.below(3)] : print(corners[what == 1 ? 0 : i].x));
    }
    if (what == 0) ++left_out["vertices"];
    if (what == 0 && habits_.has_colours) --left_out["colours of vertices"];
    const auto v = vertices_;
    statements += what <= 1   ? fmt::format("f {} {} {}\n", v - 2, v - 1, v)
                  : what == 2 ? fmt::format("f {} {}\n", v - 1, v)
                  : what == 3 ? fmt::format("f {} {} {}\n", v - 1, v - 1, v)
                  : what == 4 ? fmt::format("f {} {} 99999999999999999999\n", v - 1, v)
                              : fmt::format("f 0 {} {}\n", v - 1, v);
  }

  void write_other(std::string& statements) {
    constexpr std::pair<const char*, const char*> OTHERS[] = {
        {"l 1 2 3\n", "lines"},
        {"p 1\n", "points"},
        {"cstype bspline\ndeg 3\ncurv 0.0 1.0 1 2 3 4\nparm u 0 0 1 1\nend\n",
         "curves and curved surfaces"},
        {"lod 3\n", "levels of detail"},
        {"lod 0\nbevel off\nusemap off\nshadow\\\n", "unknown statements"},
        {"# C:\\models\\\n\n   \n", ""}};
    const auto& [text, kind] = OTHERS[random_.below(6)];
    statements += text;
    if (*kind) ++left_out[kind];
  }

  Random random_;
  const Habits& habits_;
  std::string stem_;
  std::map<std::string, Rgb> colours_;
  std::optional<Rgb> colour_;  // colour of the current material; none if unknown
  bool has_library_ = false, is_library_missing_ = false;
  std::size_t vertices_ = 0, coordinates_ = 0, normals_ = 0;

 public:
  bool is_library_missing() const { return is_library_missing_; }
};

// A polygon that the reader found.
struct FoundFace {
  std::vector<Vec> corners;
  Rgb colour;
  bool has_normals;
};

struct FoundFaces : NffTarget {
  std::vector<FoundFace> faces;
  Rgb colour;

  void set_view(const View&) override {}
  void add_light(const Light&, const std::optional<Rgb>&) override {}
  void set_surface(const Surface& s) override { colour = s.kd * s.colour; }
  void add_sphere(const Vec&, double) override {}
  void add_polygon(std::vector<Vec> corners, std::vector<Vec> normals) override {
    faces.push_back({std::move(corners), colour, !normals.empty()});
  }
  void add_cone(const Vec&, double, const Vec&, double) override {}
};

// Twice the area multiplied by the normal, summed over the corners around the origin.
Vec sum_area(const std::vector<Vec>& corners) {
  Vec sum;
  for (std::size_t i = 0; i < corners.size(); ++i)
    sum += cross(corners[i], corners[(i + 1) % corners.size()]);
  return sum;
}

// Compares a face with the first faces in `found`, and returns how many of these are its parts. A
// bent face is found as triangles between its corners. The outer border of these triangles is the
// border of the face, so that the areas must be equal.
std::size_t compare(const KnownFace& known, std::span<const FoundFace> found) {
  const auto count = known.is_bent ? known.corners.size() - 2 : 1;
  if (found.size() < count) {
    ADD_FAILURE() << "a face is missing";
    return found.size();
  }
  Vec area;
  for (const auto& part : found.first(count)) {
    EXPECT_EQ(part.colour, known.colour);
    EXPECT_EQ(part.has_normals, known.has_normals);
    for (const Vec& corner : part.corners)
      EXPECT_NE(std::ranges::find(known.corners, corner), known.corners.end());
    area += sum_area(part.corners);
  }
  if (!known.is_bent) {
    EXPECT_EQ(found[0].corners, known.corners);
  }
  EXPECT_LT(length(area - sum_area(known.corners)), 1e-9);
  return count;
}

std::string describe(const std::map<std::string, int>& counts) {
  LeftOut left_out;
  for (const auto& [kind, count] : counts) left_out.add(kind, "", static_cast<std::size_t>(count));
  return left_out.describe();
}

TEST(ObjExporters, AFileIsReadCompletelyOrItsLossesAreCounted) {
  const ::test::TemporaryFolder folder;
  std::map<std::string, std::size_t> read;
  for (std::uint64_t seed = 1; seed <= 210; ++seed) {
    Exporter exporter(seed, fmt::format("model {}", seed));
    exporter.write();
    SCOPED_TRACE(fmt::format("seed {}, {}:\n{}", seed, exporter.program().program, exporter.obj));
    std::ofstream(folder.path / fmt::format("model {}.mtl", seed), std::ios::binary)
        << exporter.mtl;
    const auto name = (folder.path / "model.obj").string();
    FoundFaces found;
    LeftOut left_out;
    if (exporter.faces.empty()) continue;
    read_scene(exporter.obj, name, found, &left_out);

    std::span<const FoundFace> rest = found.faces;
    for (const auto& known : exporter.faces) rest = rest.subspan(compare(known, rest));
    EXPECT_TRUE(rest.empty()) << "more faces than there are";
    if (exporter.is_library_missing() && exporter.grey == 0) exporter.left_out["libraries"] = 1;
    EXPECT_EQ(left_out.describe(), describe(exporter.left_out));
    const auto remarks = left_out.describe_remarks();
    const auto grey = fmt::format("faces in light grey ({})", exporter.grey);
    EXPECT_EQ(std::ranges::count_if(remarks, [&](const auto& r) { return r.ends_with(grey); }),
              exporter.grey > 0);
    EXPECT_LE(remarks.size(), 10u);
    for (const auto& remark : remarks) EXPECT_TRUE(remark.starts_with(name + ":")) << remark;
    read[exporter.program().program] += exporter.faces.size();
  }
  EXPECT_EQ(read.size(), habits().size());
  for (const auto& [program, faces] : read) EXPECT_GT(faces, 100u) << program;
}

}  // namespace
}  // namespace renderer::test
