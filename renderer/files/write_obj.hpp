#pragma once
// Writes OBJ with an MTL file that `read_obj` restores bit for bit.

#include <map>
#include <string>

#include "renderer/files/obj.hpp"

namespace renderer {

class ObjText : public ObjTarget {
 public:
  /// `library` names the MTL file beside the OBJ in `folder`; picture paths are relative to
  /// `folder`. The other functions throw BadInput for names with blanks or # and for invalid faces.
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
  // The number of a point, normal or coordinate; writes its statement if it is new.
  std::size_t number_of(const std::string& statement, std::map<std::string, std::size_t>& known);

  std::string folder_, library_name_, head_, body_, library_;
  std::vector<std::string> names_;                                     // of materials
  std::map<std::string, std::size_t> points_, normals_, coordinates_;  // by their statements
};

}  // namespace renderer
