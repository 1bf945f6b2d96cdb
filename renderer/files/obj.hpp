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

/// A material of an MTL file. By default it is black and opaque.
struct MtlMaterial {
  std::string name{};
  Rgb diffuse{}, specular{}, emission{};  ///< Kd, Ks, Ke
  double shine = 0;                       ///< Ns, Phong exponent
  double transparency = 0;                ///< 1 - d; or Tr, if d is absent or agrees with it
  double ior = 1;                         ///< Ni, index of refraction
  int illum = 2;                          ///< illumination model; 3 and above have reflected rays
  std::string picture{};  ///< map_Kd, path of a texture relative to the MTL file; may be empty
  Rgb colour{1, 1, 1};    ///< colour whose product with kd is `diffuse`
  double kd = 0;
  bool operator==(const MtlMaterial&) const = default;

  /// Sets `diffuse` to the product of a colour and a factor, which are kept too.
  void set_diffuse(const Rgb& of, double factor) {
    colour = of, kd = factor, diffuse = factor * of;
  }
  /// Sets `diffuse` with a factor of 1. Black is stored as white with a factor of 0.
  void set_diffuse(const Rgb& rgb) {
    rgb == Rgb{} ? set_diffuse({1, 1, 1}, 0) : set_diffuse(rgb, 1);
  }
};
inline constexpr int ILLUM_REFLECTS = 3;

/// Receiver of the statements of an OBJ file, in the order of the file. Paths are relative to the
/// working directory. If it throws BadInput, the message gets the line of the statement.
class ObjTarget {
 public:
  virtual ~ObjTarget() = default;
  virtual void add_library(const std::string&) {}
  /// Adds a material, whose name is unique.
  virtual void add_material(const MtlMaterial& material) = 0;
  /// Selects the material of the next faces by its index in the order of add_material().
  virtual void use_material(std::size_t material) = 0;
  /// Adds a face with one normal and one texture coordinate for each corner, or with none of
  /// either.
  virtual void add_face(std::vector<Vec> corners, std::vector<Vec> normals,
                        std::vector<Corner> coordinates) = 0;
  virtual void set_view(const View&) {}
  virtual void set_background(const Rgb&) {}
  /// Adds a light that has no colour yet.
  virtual void add_light(const Light&, const std::optional<Rgb>&) {}
  /// Reports a skipped kind of element, in the plural: "points", "lines", "colours of corners".
  virtual void leave_out(const std::string&) {}

  int line = 0;  ///< line of the current statement
};

/// Sends the statements of a text to `target`. Paths of MTL files are relative to the folder of
/// `name`. Throws BadInput "name:line: ...".
void read_obj(std::string_view text, const std::string& name, ObjTarget& target);

/// Default view of an OBJ: from the diagonal of its bounds, beyond their greatest corner. The
/// bounds just fit into the picture. Up is y, or z if the bounds are almost a line along y.
View look_from_outside(const Bounds& bounds);

}  // namespace renderer
