#pragma once
// Reader of Wavefront OBJ files and their MTL files, for scenes and rooms. It reads flat faces and
// their materials.
//
// The reader uses v, vt, vn, f, usemtl and mtllib. Their order is free: a face may precede its
// vertices, and usemtl may precede its library. Upper and lower case are the same in statements, a
// backslash joins lines, and names of materials and files may contain blanks and '#'. The reader
// skips groups, smoothing and display attributes. It ignores, but counts, points, lines, curves,
// unknown statements, and everything that it cannot read. An unreadable vertex keeps its number,
// and faces that use it are left out.
//
// Statements that OBJ lacks are NFF statements in comments that begin a line, so that other readers
// skip them. renderer/files/nff.hpp describes their syntax, and which comments are prose:
//
//   # v from X Y Z at X Y Z up X Y Z angle DEGREES [hither D] [resolution W H]
//   # b R G B
//   # l X Y Z [R G B]
//   # light rect ...                # light sphere ...
//
// tinyobjloader 2.0.0 is not used, because it reads "nan" as 0 and skips unknown statements without
// a message or a line number.

#include "renderer/files/mtl.hpp"
#include "renderer/files/text/left_out.hpp"
#include "renderer/files/text/statements.hpp"

namespace renderer {

/// Interface that receives the content of an OBJ file. The materials of all libraries come first,
/// then the other statements in the order of the file. Paths of pictures are relative to the
/// working directory. If add_face() throws BadInput, the reader leaves out the face and counts it.
/// If another function throws BadInput, the reader puts the line of the statement before the
/// message.
class ObjTarget {
 public:
  virtual ~ObjTarget() = default;
  virtual void add_library(const std::string&) {}
  /// Adds a material. Its name differs from the names of earlier materials.
  virtual void add_material(const MtlMaterial& material) = 0;
  /// Selects the material of the next faces. `material` is an index from 0 in the order of the
  /// calls of add_material(). The reader calls this function before the first face.
  virtual void use_material(std::size_t material) = 0;
  /// Adds a face. `normals` and `coordinates` (texture coordinates) have one entry for each corner,
  /// or are empty. Neighbouring corners are at different points.
  virtual void add_face(std::vector<Vec> corners, std::vector<Vec> normals,
                        std::vector<Corner> coordinates) = 0;
  virtual void set_view(const View&) {}
  virtual void set_background(const Rgb&) {}
  /// Adds a light. A light without a colour gets the default intensity.
  virtual void add_light(const Light&, const std::optional<Rgb>&) {}

  int line = 0;  ///< line of the current statement, counted from 1
};

/// Calls the functions of `target` for the statements of an OBJ text. Paths of MTL files are
/// relative to the folder of the file `name`. Faces without a known material are light grey.
/// `left_out` counts ignored parts. Throws BadInput "name:line: ..." for a wrong statement in a
/// comment, and for UTF-16. If no face is readable, throws BadInput for the first unreadable
/// statement.
void read_obj(std::string_view text, const std::string& name, ObjTarget& target, LeftOut& left_out);

/// A face. `normals` and texture coordinates have one entry for each corner, or are empty.
struct ObjFace {
  std::vector<Vec> corners, normals;
  std::vector<Corner> coordinates;
};

/// Splits a face into triangles as triangulate() does. Omits each triangle whose height is at most
/// 2e-6 of its longest edge. Throws BadInput if no triangle remains.
std::vector<ObjFace> cut_into_triangles(const ObjFace& face);

/// The default view of an OBJ file: along the diagonal of its bounding box, from a point beyond the
/// corner with the greatest coordinates. The box just fits into the picture. The y axis points up,
/// or the z axis if the box is almost a line along y.
View look_from_outside(const Bounds& bounds);

}  // namespace renderer
