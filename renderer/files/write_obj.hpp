#pragma once
// Writes OBJ and MTL files from which read_obj restores all numbers bit for bit.

#include <map>
#include <string>

#include "renderer/files/obj.hpp"

namespace renderer {

class ObjText : public ObjTarget {
 public:
  /// `library` is the name of the MTL file. It is in `folder`, beside the OBJ file. Picture paths
  /// are relative to `folder`. The member functions throw BadInput for invalid faces, and for names
  /// that contain blanks or '#'.
  ObjText(std::string folder, std::string library);

  std::string text() const;
  std::string library() const { return library_; }

  void add_material(const MtlMaterial& material) override;
  void use_material(std::size_t material) override;
  void add_face(std::vector<Vec> corners, std::vector<Vec> normals,
                std::vector<Corner> coordinates) override;
  void set_view(const View& view) override;
  void set_background(const Rgb& colour) override;
  void add_light(const Light& light, const std::optional<Rgb>& colour) override;

 private:
  // Returns the number of a point, normal or texture coordinate, counted from 1. Writes its
  // statement if it is new.
  std::size_t number_of(const std::string& statement, std::map<std::string, std::size_t>& known);

  std::string folder_, library_name_, head_, body_, library_;
  std::vector<std::string> names_;  // names of the materials
  // Number of each vertex, normal and texture coordinate, by the text of its statement.
  std::map<std::string, std::size_t> points_, normals_, coordinates_;
};

}  // namespace renderer
