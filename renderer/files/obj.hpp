#pragma once
// Wavefront's OBJ with its MTL files, for scenes and rooms: flat faces and their materials.
//
// The reader uses v, vt, vn, f, usemtl and mtllib, skips p, l, g, o and s, and rejects other
// statements. NFF statements without an OBJ equivalent stand in comments that begin a line, so that
// other readers skip them. renderer/files/nff.hpp describes their syntax and how it differs from
// prose:
//
//   # v from X Y Z at X Y Z up X Y Z angle DEGREES [hither D] [resolution W H]
//   # b R G B
//   # l X Y Z [R G B]
//   # light rect ...                # light sphere ...
//
// In an MTL file it uses newmtl, Kd, Ks, Ke, Ns, d, Tr, Ni, illum and map_Kd and skips the rest. A
// comment `# surface R G B KD` at the start of a line factors a Kd that a program multiplied. It is
// valid if R G B times KD equals the Kd before it.
//
// This is a reader of our own because tinyobjloader 2.0.0 reads "nan" as 0. It also skips unknown
// statements without a message or a line number.

#include "renderer/files/statements.hpp"

namespace renderer {

/// A material of an MTL file; defaults are black and opaque.
struct MtlMaterial {
  std::string name{};
  Rgb diffuse{}, specular{}, emission{};  ///< Kd, Ks, Ke
  double shine = 0;                       ///< Ns, Phong's exponent
  double transparency = 0;                ///< 1 - d; or Tr, if d is absent or agrees
  double ior = 1;                         ///< Ni
  int illum = 2;                          ///< 3 and above have reflected rays
  std::string picture{};                  ///< map_Kd, a path beside the MTL file; may be empty
  Rgb colour{1, 1, 1};                    ///< diffuse = kd * colour
  double kd = 0;
  bool operator==(const MtlMaterial&) const = default;

  /// Sets `diffuse` and its factors.
  void set_diffuse(const Rgb& of, double factor) {
    colour = of, kd = factor, diffuse = factor * of;
  }
  /// Stores black as white with a factor of 0.
  void set_diffuse(const Rgb& rgb) {
    rgb == Rgb{} ? set_diffuse({1, 1, 1}, 0) : set_diffuse(rgb, 1);
  }
};
inline constexpr int ILLUM_REFLECTS = 3;

/// Receiver of an OBJ file: it gets the statements in the file's order, with paths relative to the
/// working directory. A BadInput that it throws is reported with the statement's line.
class ObjTarget {
 public:
  virtual ~ObjTarget() = default;
  virtual void add_library(const std::string&) {}
  /// Its name differs from all earlier ones.
  virtual void add_material(const MtlMaterial& material) = 0;
  /// Material of the next faces: its index in the order of add_material().
  virtual void use_material(std::size_t material) = 0;
  /// One normal and one coordinate for each corner, or none.
  virtual void add_face(std::vector<Vec> corners, std::vector<Vec> normals,
                        std::vector<Corner> coordinates) = 0;
  virtual void set_view(const View&) {}
  virtual void set_background(const Rgb&) {}
  /// The light has no colour yet.
  virtual void add_light(const Light&, const std::optional<Rgb>&) {}
  /// Reports a skipped kind, in the plural: "points", "lines", "colours of corners".
  virtual void leave_out(const std::string&) {}

  int line = 0;  ///< of the current statement
};

/// Sends `target` a text's statements; further files are beside `name`. BadInput "name:line: ...".
void read_obj(std::string_view text, const std::string& name, ObjTarget& target);

/// Default view of an OBJ, from outside along the diagonal from the bounds' greatest corner. The
/// bounds just fit into the picture. Up is y, or z if the bounds are a line in y.
View look_from_outside(const Bounds& bounds);

}  // namespace renderer
