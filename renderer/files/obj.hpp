#pragma once
// Wavefront's OBJ with its MTL files, for scenes and rooms: flat faces and their materials.
//
// The reader uses v, vt, vn, f, usemtl and mtllib in any order: faces may precede their vertices,
// and usemtl its library. Names of statements have any case, a backslash joins lines, and names of
// materials and files may have blanks and '#'. It skips groups, smoothing and display attributes.
// It leaves out and counts points, lines, curves, unknown statements, and whatever it cannot read;
// an unreadable vertex keeps its number, and faces that use it are left out.
//
// NFF statements without an OBJ equivalent stand in comments that begin a line, so that other
// readers skip them. renderer/files/nff.hpp describes their syntax, and which comments are prose:
//
//   # v from X Y Z at X Y Z up X Y Z angle DEGREES [hither D] [resolution W H]
//   # b R G B
//   # l X Y Z [R G B]
//   # light rect ...                # light sphere ...
//
// This is a reader of our own because tinyobjloader 2.0.0 reads "nan" as 0. That library also skips
// unknown statements without a message or a line number.

#include "renderer/files/mtl.hpp"
#include "renderer/files/text/left_out.hpp"
#include "renderer/files/text/statements.hpp"

namespace renderer {

/// Receiver of an OBJ file. The libraries and their materials come first, with paths relative to
/// the working directory, then the other statements in the order of the file. If add_face() throws
/// BadInput, the reader leaves out the face and counts it. If another function throws BadInput, the
/// reader adds the line of the statement and passes it on.
class ObjTarget {
 public:
  virtual ~ObjTarget() = default;
  virtual void add_library(const std::string&) {}
  /// Adds a material, whose name is unique.
  virtual void add_material(const MtlMaterial& material) = 0;
  /// Selects the material of the next faces by its index in the order of add_material(). The
  /// reader calls it before the first face.
  virtual void use_material(std::size_t material) = 0;
  /// Adds a face with one normal and one texture coordinate for each corner, or with none of
  /// either. Neighbouring corners differ.
  virtual void add_face(std::vector<Vec> corners, std::vector<Vec> normals,
                        std::vector<Corner> coordinates) = 0;
  virtual void set_view(const View&) {}
  virtual void set_background(const Rgb&) {}
  /// Adds a light with a colour, or with a default intensity if there is no colour.
  virtual void add_light(const Light&, const std::optional<Rgb>&) {}

  int line = 0;  ///< line of the current statement
};

/// Sends the statements of a text to `target`. Paths of MTL files are relative to the folder of
/// `name`. Faces without a known material are light grey. Throws BadInput "name:line: ..." for a
/// wrong statement in a comment, and for UTF-16. If no face can be read, it throws BadInput for the
/// first statement that cannot be read.
void read_obj(std::string_view text, const std::string& name, ObjTarget& target, LeftOut& left_out);

/// A face with one normal and one texture coordinate for each corner, or with none of either.
struct ObjFace {
  std::vector<Vec> corners, normals;
  std::vector<Corner> coordinates;
};

/// Cuts a face into triangles, as triangulate() does. Leaves out each triangle whose height is at
/// most 2e-6 of its longest edge. Throws BadInput if none remains.
std::vector<ObjFace> cut_into_triangles(const ObjFace& face);

/// Default view of an OBJ: along the diagonal of its bounding box, from beyond its greatest corner.
/// The box just fits into the picture. Up is y, or z if the box is almost a line along y.
View look_from_outside(const Bounds& bounds);

}  // namespace renderer
