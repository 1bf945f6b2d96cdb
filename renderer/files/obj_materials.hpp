#pragma once
// Materials of an OBJ file, from its libraries.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/files/obj.hpp"
#include "renderer/files/obj_items.hpp"

namespace renderer {

class ObjMaterials {
 public:
  /// Reads the libraries of the OBJ file `name` and adds their materials to `target`. Of several
  /// materials with the same name it keeps the first.
  ObjMaterials(const std::string& name, const std::vector<ObjItems::Libraries>& libraries,
               ObjTarget& target, LeftOut& left_out);

  /// Finds a material's index from the rest of a usemtl line.
  std::optional<std::size_t> find(std::string_view text) const;
  /// Returns the index of the light grey material, which it adds at the first call.
  std::size_t find_grey();
  const PictureMap& map(std::size_t material) const { return maps_[material]; }
  /// Lists up to ten names, for errors.
  std::string describe() const;

  std::size_t missing() const { return missing_; }
  /// Message about the first missing library.
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
