#pragma once
// Wavefront's OBJ with its MTL files, for scenes and rooms: flat faces and their materials.
//
// In an OBJ v, vt, vn, f, usemtl and mtllib count; p, l, g, o and s are passed over, others are
// errors. What OBJ has no word for is said as NFF says it, in comments that begin a line, so that
// other readers pass over it (renderer/files/nff.hpp has what follows each, and what makes it
// prose):
//
//   # v from X Y Z at X Y Z up X Y Z angle DEGREES [hither D] [resolution W H]
//   # b R G B
//   # l X Y Z [R G B]
//   # light rect ...                # light sphere ...
//
// In an MTL newmtl, Kd, Ks, Ke, Ns, d, Tr, Ni, illum and map_Kd count; others are passed over. A
// comment that begins a line, `# surface R G B KD`, has the factors of a Kd that a program
// multiplied: it counts as long as their product is the Kd before it.
//
// A reader of our own: tinyobjloader 2.0.0 reads "nan" as 0 and passes over what it does not know,
// without a word and without a line.

#include "renderer/files/statements.hpp"

namespace renderer {

/// A material of an MTL file: black and opaque where the file says nothing.
struct MtlMaterial {
  std::string name{};
  Rgb diffuse{}, specular{}, emission{};  ///< Kd, Ks, Ke
  double shine = 0;                       ///< Ns, Phong's exponent
  double transparency = 0;                ///< 1 - d; or Tr, where that agrees or is alone
  double ior = 1;                         ///< Ni
  int illum = 2;                          ///< 3 and above ask for rays that are reflected
  std::string picture{};                  ///< map_Kd, a path beside the MTL file; or none
  Rgb colour{1, 1, 1};                    ///< diffuse = kd * colour
  double kd = 0;
  bool operator==(const MtlMaterial&) const = default;

  /// Sets diffuse and its factors.
  void set_diffuse(const Rgb& of, double factor) {
    colour = of, kd = factor, diffuse = factor * of;
  }
  /// Black is kept as white of which nothing is reflected.
  void set_diffuse(const Rgb& rgb) {
    rgb == Rgb{} ? set_diffuse({1, 1, 1}, 0) : set_diffuse(rgb, 1);
  }
};
inline constexpr int ILLUM_REFLECTS = 3;

/// What is made of an OBJ: it is told the file's statements, in the file's order, with paths as
/// they are found from here. A BadInput that it throws is reported with the statement's line.
class ObjTarget {
 public:
  virtual ~ObjTarget() = default;
  virtual void add_library(const std::string&) {}
  /// One that has another name than all before.
  virtual void add_material(const MtlMaterial& material) = 0;
  /// Of the faces to come: its number, in the order that they were added.
  virtual void use_material(std::size_t material) = 0;
  /// As many normals and coordinates as corners, or none of them.
  virtual void add_face(std::vector<Vec> corners, std::vector<Vec> normals,
                        std::vector<Corner> coordinates) = 0;
  virtual void set_view(const View&) {}
  virtual void set_background(const Rgb&) {}
  /// Without its colour.
  virtual void add_light(const Light&, const std::optional<Rgb>&) {}
  /// Something of this kind, a plural, is passed over: "points", "lines", "colours of corners".
  virtual void leave_out(const std::string&) {}

  int line = 0;  ///< of the statement that is told
};

/// Tells `target` a text; further files are looked for beside `name`. BadInput "name:line: ...".
void read_obj(std::string_view text, const std::string& name, ObjTarget& target);

/// The view of an OBJ that says none: from outside, along the diagonal of the bounds from their
/// greatest corner, which just fit into the picture; up is y, or z where the bounds are a line in
/// y.
View look_from_outside(const Bounds& bounds);

}  // namespace renderer
