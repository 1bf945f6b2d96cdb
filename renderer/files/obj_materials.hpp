#pragma once
// The materials of an OBJ file, read from its libraries.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/files/obj.hpp"
#include "renderer/files/obj_items.hpp"

namespace renderer {

class ObjMaterials {
 public:
  /// Reads the libraries of the OBJ file `name` and adds their materials to `target`. If several
  /// materials have the same name, only the first is kept.
  ObjMaterials(const std::string& name, const std::vector<ObjItems::Libraries>& libraries,
               ObjTarget& target, LeftOut& left_out);

  /// Returns the index of the material that a usemtl statement names; none if it is unknown. `text`
  /// is the rest of the statement's line.
  std::optional<std::size_t> find(std::string_view text) const;
  /// Returns the index of the light grey material. The first call adds this material to the target.
  std::size_t find_grey();
  const PictureMap& map(std::size_t material) const { return maps_[material]; }
  /// Lists up to ten names of materials, for error messages.
  std::string describe() const;

  std::size_t missing() const { return missing_; }
  /// Message about the first library that does not exist; "" if all exist.
  const std::string& missing_remark() const { return missing_remark_; }

 private:
  void read_libraries(const std::string& name, const ObjItems::Libraries& libraries);
  void read_library(const std::string& path);
  void add(const MtlEntry& entry);
  void note_missing(const std::string& remark);

  ObjTarget& target_;
  LeftOut& left_out_;
  std::vector<std::string> libraries_;  // paths of the libraries
  std::map<std::string, std::size_t, std::less<>> indices_;
  std::vector<MtlMaterial> materials_;
  std::vector<PictureMap> maps_;
  std::optional<std::size_t> grey_;
  std::size_t missing_ = 0;
  std::string missing_remark_;
};

}  // namespace renderer
